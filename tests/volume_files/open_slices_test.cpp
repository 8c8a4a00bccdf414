// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/open_slices.h"

#include <gmock/gmock.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/stopwatch.h"
#include "mesamis/volume_files/write_volume.h"
#include "support/dicom_bytes.h"
#include "support/picture_bytes.h"
#include "support/read_scan.h"
#include "support/throws.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

void expect_same_head(const VolumeFile& head, const VolumeFile& whole) {
  EXPECT_EQ(head.volume.size, whole.volume.size);
  EXPECT_EQ(head.volume.spacing, whole.volume.spacing);
  EXPECT_EQ(head.volume.origin, whole.volume.origin);
  EXPECT_EQ(head.volume.direction, whole.volume.direction);
  EXPECT_EQ(head.volume.modality, whole.volume.modality);
  EXPECT_EQ(head.format, whole.format);
  EXPECT_EQ(head.warnings, whole.warnings);
  EXPECT_THAT(head.volume.samples, IsEmpty());
  ASSERT_EQ(head.files.size(), whole.files.size());
  for (std::size_t n = 0; n < head.files.size(); ++n) {
    EXPECT_EQ(head.files[n].path, whole.files[n].path);
  }
}

/// Every slab of a scan, from the last to the first, has the bits of the whole volume.
void expect_slabs_of_whole(const fs::path& path, const ReadOptions& options = {}) {
  SCOPED_TRACE(path);
  const VolumeFile whole = read_volume(path, options);
  const auto slices = open_slices(path, options);
  expect_same_head(slices->head(), whole);
  const Index n = slices->grid().size[2];
  EXPECT_EQ(n, whole.volume.size[2]);
  const VolumeSlices expected(whole.volume);
  for (Index first = n - 1; first >= 0; --first) {
    for (Index count = 1; count <= n - first; ++count) {
      EXPECT_TRUE(same_bits(slices->read(first, count), expected.read(first, count)))
          << count << " from " << first << " on";
    }
  }
}

void expect_slabs(const TempFolder& folder, const std::string& name, const std::string& bytes) {
  write_bytes(folder / name, bytes);
  expect_slabs_of_whole(folder / name);
}

/// Why the slices of a file cannot be read one at a time: one line.
std::string refusal(const fs::path& path, const ReadOptions& options = {}) {
  try {
    (void)open_slices(path, options);
  } catch (const InputError& error) {
    const std::string line = error.what();
    EXPECT_THAT(line, StartsWith(path.string()));
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    return line.substr(path.string().size());
  }
  return "";
}

std::string refusal(const TempFolder& folder, const std::string& name, const std::string& bytes) {
  write_bytes(folder / name, bytes);
  return refusal(folder / name);
}

/// A NIfTI-2 header of the same grid and samples as NiftiBytes: what the reader needs of it.
std::string nifti_2_header(std::int64_t offset) {
  std::string h(static_cast<std::size_t>(offset), '\0');
  const auto put = [&h](std::size_t at, auto value) {
    h.replace(at, sizeof(value), bytes_of(value, true));
  };
  put(0, std::int32_t{540});
  h.replace(4, 8, std::string("n+2\0\r\n\x1a\n", 8));
  put(12, std::int16_t{4});
  const std::vector<std::int64_t> dim{3, 4, 3, 5, 1, 1, 1, 1};
  for (std::size_t n = 0; n < 8; ++n) put(16 + 8 * n, dim[n]);
  for (std::size_t n = 0; n < 8; ++n) put(104 + 8 * n, 0.75);
  put(168, offset);
  put(176, 0.1), put(184, -1024.0);
  put(500, std::int32_t{2});
  return h;
}

TEST(OpenSlices, NiftiInBothVersionsAndByteOrders) {
  const TempFolder folder;
  for (const bool big_endian : {false, true}) {
    NiftiBytes nifti;
    nifti.big_endian = big_endian;
    nifti.slope = 0.1F, nifti.intercept = -1024;  // not exact: the rounding must agree, too
    const std::string data = bytes_of_all(kRamp, big_endian);
    expect_slabs(folder, "a.nii", nifti.header() + data);
    nifti.vox_offset = 400;
    expect_slabs(folder, "b.nii", nifti.header() + std::string(48, 'x') + data + "more");
    nifti.sform_code = 0;  // a warning
    expect_slabs(folder, "c.nii", nifti.header() + std::string(48, 'x') + data);
  }
  expect_slabs(folder, "d.nii", nifti_2_header(560) + bytes_of_all(kRamp, true));
}

TEST(OpenSlices, EveryTypeOfNumber) {
  const TempFolder folder;
  const auto check = [&folder](auto number, const std::string& type) {
    using Number = decltype(number);
    const std::string header =
        "NRRD0004\ntype: " + type + "\ndimension: 3\nsizes: 4 3 5\nencoding: raw\nendian: big\n\n";
    expect_slabs(folder, "a.nrrd",
                 header + bytes_of_all(ramp<Number>(60, std::is_signed_v<Number> ? -40 : 0), true));
  };
  check(std::int8_t{}, "int8"), check(std::uint8_t{}, "uint8");
  check(std::int16_t{}, "int16"), check(std::uint16_t{}, "uint16");
  check(std::int32_t{}, "int32"), check(std::uint32_t{}, "uint32");
  check(std::int64_t{}, "int64"), check(std::uint64_t{}, "uint64");
  check(float{}, "float"), check(double{}, "double");
}

TEST(OpenSlices, NrrdAttachedAndDetached) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp), raw = "encoding: raw\nendian: little\n";
  expect_slabs(folder, "a.nrrd", nrrd_bytes(raw, data));
  expect_slabs(folder, "b.nrrd", nrrd_bytes(raw + "line skip: 1\nbyte skip: 3\n", "1\nabc" + data));
  expect_slabs(folder, "c.nrrd", nrrd_bytes(raw + "byte skip: -1\n", "anything" + data));
  write_bytes(folder / "data.raw", data);
  expect_slabs(folder, "d.nhdr", nrrd_bytes(raw + "data file: data.raw\n", ""));
  write_bytes(folder / "big.raw", "head" + bytes_of_all(kRamp, true));
  expect_slabs(folder, "e.nhdr",
               nrrd_bytes("encoding: raw\nendian: big\ndata file: big.raw\nbyte skip: 4\n", ""));
  write_nrrd(folder / "f.nrrd", read_volume(folder / "a.nrrd").volume);
  expect_slabs_of_whole(folder / "f.nrrd");
}

TEST(OpenSlices, MetaImageLocalAndDetached) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp);
  expect_slabs(folder, "a.mha", meta_bytes("BinaryData = True\n") + data);
  expect_slabs(folder, "b.mha",
               meta_bytes("BinaryDataByteOrderMSB = True\n") + bytes_of_all(kRamp, true));
  write_bytes(folder / "my data.raw", "head" + data);
  expect_slabs(folder, "c.mhd", meta_bytes("HeaderSize = 4\n", "my data.raw"));
  expect_slabs(folder, "d.mhd", meta_bytes("HeaderSize = -1\n", "my data.raw"));
}

TEST(OpenSlices, RawFilesAndPlainProjects) {
  const TempFolder folder;
  write_bytes(folder / "a.raw", "header!" + bytes_of_all(kRamp, true));
  const ReadOptions options{.raw = parse_raw_layout("4,3,5,int16be,7")};
  expect_slabs_of_whole(folder / "a.raw", options);
  expect_slabs(folder, "a.inv3", inv3_bytes(4, 3, 5, bytes_of_all(kRamp)));
}

std::vector<TiffPage> five_pages() {
  std::vector<TiffPage> pages(5);
  for (std::size_t k = 0; k < 5; ++k) {
    pages[k].pixels = bytes_of_all(ramp<std::int16_t>(12, -40 + 12 * static_cast<int>(k)));
  }
  pages[0].description = "ImageJ=1.53\nunit=mm\nspacing=2.5\n";
  return pages;
}

TEST(OpenSlices, PagesOfATiff) {
  const TempFolder folder;
  expect_slabs(folder, "a.tif", tiff_bytes(five_pages()));
  const std::string whole = tiff_bytes(five_pages());
  EXPECT_THAT(refusal(folder, "b.tif", whole.substr(0, whole.size() / 2)), HasSubstr("cut off"));
  // The pixels of the last page alone lie behind the end.
  std::string moved = whole;
  const auto at = moved.rfind(bytes_of(std::uint16_t{273}) + bytes_of(std::uint16_t{4}));
  moved.replace(at + 8, 4, bytes_of(static_cast<std::uint32_t>(whole.size() - 20)));
  EXPECT_THAT(refusal(folder, "c.tif", moved), HasSubstr("page 4 is broken or cut off"));
}

TEST(OpenSlices, PagesOfATiffThatAreCompressedOrThumbnails) {
  const TempFolder folder;
  auto pages = five_pages();
  for (TiffPage& page : pages) {
    page.pixels = packed(page.pixels, 15);
    page.compression = 8;  // deflate
  }
  TiffPage thumbnail = pages[0];
  thumbnail.thumbnail = true;
  pages.insert(pages.begin() + 2, thumbnail);
  expect_slabs(folder, "a.tif", tiff_bytes(pages));
  EXPECT_EQ(open_slices(folder / "a.tif")->grid().size[2], 5);
  pages[4].pixels[5] ^= 0x55;
  write_bytes(folder / "b.tif", tiff_bytes(pages));
  const auto slices = open_slices(folder / "b.tif");
  EXPECT_EQ(slices->read(2, 1)[0], -16);
  EXPECT_REFUSED((void)slices->read(2, 2), HasSubstr("b.tif: page 4 is broken"));
}

TEST(OpenSlices, AFolderOfPicturesOpensOnlyTheFilesAskedFor) {
  const TempFolder folder;
  BmpBytes bmp{.palette = grey_palette(), .pixels = std::string("\4\5\6\0\1\2\3\0", 8)};
  auto pages = five_pages();
  pages[0].description.clear();
  for (std::size_t k = 0; k < 5; ++k) {
    const std::string n = std::to_string(8 + k);
    write_bytes(folder / ("tif/" + n + ".tif"), tiff_bytes({pages[k]}));
    write_bytes(folder / ("png/" + n + ".png"),
                png_bytes(2, 2, std::string(4, static_cast<char>(k))));
    bmp.pixels[0] = static_cast<char>(k);
    write_bytes(folder / ("bmp/" + n + ".bmp"), bmp.bytes());
  }
  for (const char* kind : {"tif", "png", "bmp"}) expect_slabs_of_whole(folder / kind);
  expect_slabs_of_whole(folder / "png" / "9.png");
  const auto slices = open_slices(folder / "png");
  write_bytes(folder / "png/10.png", "no picture any more");
  EXPECT_EQ(slices->read(0, 2)[4], 1);
  EXPECT_EQ(slices->read(3, 2)[4], 4);
  EXPECT_REFUSED((void)slices->read(1, 2), HasSubstr("10.png"));
  EXPECT_THAT(refusal(folder / "png"), HasSubstr("10.png"));
  const std::string tiff = read_bytes(folder / "tif/10.tif");
  std::string moved = tiff;
  moved.replace(moved.rfind(bytes_of(std::uint16_t{273}) + bytes_of(std::uint16_t{4})) + 8, 4,
                bytes_of(static_cast<std::uint32_t>(tiff.size() - 20)));
  write_bytes(folder / "tif/10.tif", moved);
  EXPECT_THAT(refusal(folder / "tif"), AllOf(HasSubstr("10.tif"), HasSubstr("cut off")));
}

TEST(OpenSlices, TakeTheSpacingAndTellTheGrid) {
  const TempFolder folder;
  write_bytes(folder / "a.nii", NiftiBytes{}.header() + bytes_of_all(kRamp));
  ReadOptions options{.spacing = Vec3{0.1, 0.2, 0.3}};
  expect_slabs_of_whole(folder / "a.nii", options);
  int calls = 0;
  options.on_grid = [&calls](const VoxelGrid& grid) {
    EXPECT_EQ(grid.spacing, (Vec3{0.1, 0.2, 0.3}));
    ++calls;
  };
  (void)open_slices(folder / "a.nii", options)->read(1, 2);
  EXPECT_EQ(calls, 1);
  EXPECT_THAT(refusal(folder / "a.nii", {.spacing = Vec3{1, 0, 1}}), HasSubstr("positive spacing"));
}

TEST(OpenSlices, WhatIsCompressedOrTextIsRefused) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp), little = "endian: little\n";
  const std::string nifti = NiftiBytes{}.header() + data;
  EXPECT_EQ(refusal(folder, "x.nii.gz", packed(nifti)),
            ": expected uncompressed voxels, which can be read a slice at a time, found gzip; "
            "unpack it, or run without --slabs");
  EXPECT_THAT(refusal(folder, "x.nii", packed(nifti)), HasSubstr("found gzip"));
  expect_slabs(folder, "plain.nii.gz", nifti);  // its name alone says so
  EXPECT_THAT(refusal(folder, "x.nrrd", nrrd_bytes("encoding: gzip\n" + little, packed(data))),
              HasSubstr("found gzip"));
  EXPECT_THAT(refusal(folder, "y.nrrd", nrrd_bytes("encoding: ascii\n", "1 2 3")),
              HasSubstr("found numbers in text"));
  EXPECT_THAT(refusal(folder, "x.mha", meta_bytes("CompressedData = True\n") + packed(data, 15)),
              HasSubstr("zlib"));
  EXPECT_THAT(refusal(folder, "x.inv3", packed(inv3_bytes(4, 3, 5, data))), HasSubstr("gzip"));
}

TEST(OpenSlices, DicomAndWhatIsNoScanAreRefused) {
  const TempFolder folder;
  for (int k = 0; k < 3; ++k) {
    SliceBytes slice;
    slice.position = {0, 0, 2.0 * k};
    write_bytes(folder / ("series/" + std::to_string(k)), slice.bytes());
  }
  EXPECT_THAT(refusal(folder / "series"), HasSubstr("found DICOM"));
  EXPECT_THAT(refusal(folder / "series/1"), HasSubstr("found DICOM"));
  fs::create_directory(folder / "empty");
  EXPECT_THAT(refusal(folder / "empty"), HasSubstr("found none"));
  EXPECT_THAT(refusal(folder, "a.txt", "text"), HasSubstr("found none"));
  EXPECT_THAT(refusal(folder / "absent"), HasSubstr("no such file"));
}

TEST(OpenSlices, AFileOfAnotherLengthIsRefusedWhenItIsOpened) {
  const TempFolder folder;
  const std::string data = bytes_of_all(kRamp), less = data.substr(1);
  const std::string raw = "encoding: raw\nendian: little\n";
  const auto is_short =
      AllOf(HasSubstr("expected 120 bytes for 4 x 3 x 5 samples"), HasSubstr("found 119"));
  EXPECT_THAT(refusal(folder, "a.nii", NiftiBytes{}.header() + less), is_short);
  EXPECT_THAT(refusal(folder, "b.nii", NiftiBytes{}.header().substr(0, 350)),
              HasSubstr("expected 120 bytes"));
  EXPECT_THAT(refusal(folder, "a.nrrd", nrrd_bytes(raw, less)), is_short);
  EXPECT_THAT(refusal(folder, "b.nrrd", nrrd_bytes(raw + "byte skip: -1\n", less)), is_short);
  EXPECT_THAT(refusal(folder, "c.nrrd", nrrd_bytes(raw + "byte skip: 9223372036854775807\n", data)),
              HasSubstr("found 0"));
  EXPECT_THAT(refusal(folder, "a.mha", meta_bytes("") + less), is_short);
  write_bytes(folder / "less.raw", less);
  write_bytes(folder / "more.raw", data + "x");
  EXPECT_THAT(refusal(folder, "d.nhdr", nrrd_bytes(raw + "data file: less.raw\n", "")), is_short);
  EXPECT_THAT(refusal(folder, "e.nhdr", nrrd_bytes(raw + "data file: more.raw\n", "")),
              HasSubstr("go on"));
  EXPECT_THAT(refusal(folder, "b.mhd", meta_bytes("", "more.raw")), HasSubstr("go on"));
  EXPECT_THAT(refusal(folder / "less.raw", {.raw = parse_raw_layout("4,3,5,int16")}),
              HasSubstr("found 119"));
}

TEST(OpenSlices, AFileThatChangedIsRefused) {
  const TempFolder folder;
  const std::string header = NiftiBytes{}.header();
  write_bytes(folder / "a.nii", header + bytes_of_all(kRamp));
  const auto slices = open_slices(folder / "a.nii");
  EXPECT_EQ(slices->read(0, 1)[0], -40);
  write_bytes(folder / "a.nii", header + bytes_of_all(ramp<std::int16_t>(60, 1)) + "more");
  EXPECT_REFUSED((void)slices->read(0, 1), HasSubstr("found it changed"));
  fs::remove(folder / "a.nii");
  EXPECT_REFUSED((void)slices->read(0, 1), HasSubstr("no such file"));
}

TEST(OpenSlices, OtherFoldersSlicesAndMemoryAreLimited) {
  const TempFolder folder;
  write_bytes(folder / "data.raw", bytes_of_all(kRamp));
  const std::string header =
      nrrd_bytes("encoding: raw\nendian: little\ndata file: ../data.raw\n", "");
  write_bytes(folder / "in/a.nhdr", header);
  EXPECT_THAT(refusal(folder / "in/a.nhdr"), HasSubstr("--allow-outside"));
  ReadOptions options;
  options.limits.allow_outside = true;
  expect_slabs_of_whole(folder / "in/a.nhdr", options);
  options.limits.memory_gb = 100e-9;  // two slices of 48 bytes
  const auto slices = open_slices(folder / "in/a.nhdr", options);
  EXPECT_EQ(slices->read(3, 2).size(), 24U);
  EXPECT_REFUSED((void)slices->read(0, 3), HasSubstr("memory"));
  for (const auto& [first, count] : std::vector<std::pair<Index, Index>>{
           {-1, 1}, {0, 0}, {0, 6}, {5, 1}, {2, 2147483647}, {2147483647, 2147483647}}) {
    EXPECT_REFUSED((void)slices->read(first, count), HasSubstr("expected slices within 5"));
  }
}

/// 8 GB of zeros that take no room on the disk, but for one sample.
void write_sparse(const fs::path& file, const std::string& header, std::uint64_t bytes,
                  std::uint64_t place) {
  write_bytes(file, header);
  fs::resize_file(file, header.size() + bytes);
  std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
  out.seekp(static_cast<std::streamoff>(header.size() + place));
  out << "\7";
}

TEST(OpenSlices, OfAHugeFileOnlyTheSlicesAskedForAreRead) {
  const TempFolder folder;
  constexpr std::uint64_t kSlice = 2048ULL * 1024, kAll = kSlice * 4096;
  const std::string sizes = "dimension: 3\nsizes: 2048 1024 4096\ntype: uint8\nencoding: raw\n";
  NiftiBytes nifti;
  nifti.datatype = 2;
  nifti.dim = {3, 2048, 1024, 4096, 1, 1, 1, 1};
  const std::uint64_t place = 4000 * kSlice;
  write_sparse(folder / "a.nii", nifti.header(), kAll, place);
  write_sparse(folder / "a.nrrd", "NRRD0004\n" + sizes + "\n", kAll, place);
  write_sparse(folder / "b.nrrd", "NRRD0004\n" + sizes + "byte skip: -1\n\n", kAll, place);
  write_sparse(folder / "a.mha",
               "NDims = 3\nDimSize = 2048 1024 4096\nElementType = MET_UCHAR\n"
               "ElementDataFile = LOCAL\n",
               kAll, place);
  const double before = peak_mb();
  Stopwatch time;
  for (const char* name : {"a.nii", "a.nrrd", "b.nrrd", "a.mha"}) {
    const auto slices = open_slices(folder / name);
    EXPECT_EQ(slices->grid().size[2], 4096);
    EXPECT_EQ(slices->read(4000, 1)[0], 7) << name;
    EXPECT_EQ(slices->read(4095, 1), std::vector<float>(kSlice)) << name;
  }
  EXPECT_LT(peak_mb() - before, 64);  // a slice has 8 MB as samples
  EXPECT_LT(time.lap(), 10) << "8 GB take longer";
}

}  // namespace
}  // namespace mesamis
