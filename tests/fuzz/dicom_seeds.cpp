// SPDX-License-Identifier: Apache-2.0
#include <gdcmJPEG2000Codec.h>
#include <gdcmJPEGLSCodec.h>
#include <gdcmSequenceOfFragments.h>

#include "fuzz_seeds.h"
#include "support/dicom_bytes.h"
#include "support/jpeg_bytes.h"
#include "support/seg_bytes.h"

namespace mesamis {
namespace {

/// A slice of 8 x 8 unsigned pixels whose compressed picture is one fragment.
std::string compressed_slice(const std::string& syntax, int bits, std::string picture) {
  if (picture.size() % 2) picture += '\0';
  DicomWriter meta, set;
  meta.text(0x00020010, "UI", syntax);
  set.text(0x00080060, "CS", "CT");
  set.text(0x0020000e, "UI", "1.2.3");
  set.decimals(0x00200032, {0, 0, 0});
  set.decimals(0x00200037, {1, 0, 0, 0, 1, 0});
  set.number(0x00280002, 1);
  set.text(0x00280004, "CS", "MONOCHROME2");
  set.number(0x00280010, 8), set.number(0x00280011, 8);
  set.decimals(0x00280030, {1.25, 0.5});
  set.number(0x00280100, bits > 8 ? 16 : 8), set.number(0x00280101, bits);
  set.number(0x00280102, bits - 1), set.number(0x00280103, 0);
  const std::string item("\xfe\xff\x00\xe0", 4), end("\xfe\xff\xdd\xe0\0\0\0\0", 8);
  return std::string(128, '\0') + "DICM" + meta.bytes() + set.bytes() +
         std::string("\xe0\x7f\x10\0OB\0\0\xff\xff\xff\xff", 12) + item + std::string(4, '\0') +
         item + bytes_of(static_cast<std::uint32_t>(picture.size())) + picture + end;
}

void set_lossless(gdcm::JPEGLSCodec& codec) { codec.SetLossless(true); }
void set_lossless(gdcm::JPEG2000Codec& codec) { codec.SetReversible(true); }

template <class Codec>
std::string coded(const std::string& samples) {
  Codec codec;
  set_lossless(codec);
  codec.SetNumberOfDimensions(2);
  codec.SetDimensions({8, 8, 1});
  codec.SetPixelFormat(gdcm::PixelFormat(1, 16, 16, 15, 0));
  codec.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  gdcm::DataElement in, out;
  in.SetByteValue(samples.data(), static_cast<std::uint32_t>(samples.size()));
  if (!codec.Code(in, out)) return "";
  const gdcm::ByteValue* value = out.GetSequenceOfFragments()->GetFragment(0).GetByteValue();
  return {value->GetPointer(), value->GetLength()};
}

void write_compressed(const SeedFolder& seeds) {
  const std::string jpeg = "1.2.840.10008.1.2.4.";
  const auto samples = ramp<std::uint16_t>(64, 1000);
  const std::string words = bytes_of_all(samples);
  const auto add = [&seeds](const char* name, const std::string& syntax, int bits,
                            const std::string& picture) {
    seeds.add("dicom", name, compressed_slice(syntax, bits, picture));
  };
  add("jpeg_baseline", jpeg + "50", 8, flat_jpeg(8, 100));
  add("jpeg_extended", jpeg + "51", 12, flat_jpeg(12, 1000));
  add("jpeg_lossless", jpeg + "70", 16, lossless_jpeg(16, 8, samples));
  add("jpeg_lossless_12", jpeg + "57", 12, lossless_jpeg(12, 8, samples));
  add("jpeg_ls", jpeg + "80", 16, coded<gdcm::JPEGLSCodec>(words));
  add("jpeg_2000", jpeg + "90", 16, coded<gdcm::JPEG2000Codec>(words));
  const std::string plane = '\x3f' + words.substr(0, 64);
  add("rle", "1.2.840.10008.1.2.5", 16,
      bytes_of_all(std::vector<std::uint32_t>{2, 64, 129}) + std::string(52, '\0') + plane + plane);
}

}  // namespace

void write_dicom_seeds(const SeedFolder& seeds) {
  const std::pair<const char*, DicomCoding> codings[]{{"explicit", DicomCoding::kExplicit},
                                                      {"implicit", DicomCoding::kImplicit},
                                                      {"bigendian", DicomCoding::kBigEndian},
                                                      {"deflated", DicomCoding::kDeflated},
                                                      {"bare", DicomCoding::kWithoutMeta}};
  for (const auto& [name, coding] : codings) {
    SliceBytes slice;
    slice.coding = coding;
    seeds.add("dicom", name, slice.bytes());
    seeds.add("dicom", std::string("enhanced_") + name,
              enhanced_bytes({0, 2, 1}, coding != DicomCoding::kExplicit, coding));
    SegBytes seg = small_seg();
    seg.coding = coding;
    seg.in_open_sequences = coding == DicomCoding::kImplicit;
    seeds.add("label_dicom", name, seg.bytes());
  }
  write_compressed(seeds);
  SegBytes seg = small_seg();
  seg.type = "FRACTIONAL";
  seg.bits = 8;
  seeds.add("label_dicom", "fractional", seg.bytes());
  seg = small_seg();
  seg.segments[0].cielab = {40000, 33000, 33000};
  seg.slice_spacing = 2;
  seg.number_in_shared = true;
  seeds.add("label_dicom", "colour", seg.bytes());
}

}  // namespace mesamis
