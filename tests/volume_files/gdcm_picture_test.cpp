// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/gdcm_picture.h"

#include <gdcmJPEG2000Codec.h>
#include <gdcmJPEGLSCodec.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>
#include <gmock/gmock.h>

#include <thread>

#include "support/bytes_span.h"
#include "support/scan_bytes.h"

namespace mesamis {
namespace {

constexpr const char* kJpegLs = "1.2.840.10008.1.2.4.80";
constexpr const char* kJpeg2000 = "1.2.840.10008.1.2.4.90";

DicomPixels small_pixels() {
  DicomPixels pixels;
  pixels.columns = 16;
  pixels.rows = 8;
  return pixels;
}

const std::string kWords = bytes_of_all(ramp<std::uint16_t>(128, 1000));

void set_lossless(gdcm::JPEGLSCodec& codec) { codec.SetLossless(true); }
void set_lossless(gdcm::JPEG2000Codec& codec) { codec.SetReversible(true); }

/// The samples coded without loss.
template <class Codec>
std::string coded() {
  Codec codec;
  set_lossless(codec);
  codec.SetNumberOfDimensions(2);
  codec.SetDimensions({16, 8, 1});
  codec.SetPixelFormat(gdcm::PixelFormat(1, 16, 16, 15, 0));
  codec.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  gdcm::DataElement in, out;
  in.SetByteValue(kWords.data(), static_cast<std::uint32_t>(kWords.size()));
  if (!codec.Code(in, out)) return "";
  const gdcm::ByteValue* value = out.GetSequenceOfFragments()->GetFragment(0).GetByteValue();
  return {value->GetPointer(), value->GetLength()};
}

std::string decoded(const std::string& picture, const char* syntax) {
  const auto words = decode_by_gdcm(bytes_in(picture), syntax, small_pixels());
  return words ? std::string(words->begin(), words->end()) : "none";
}

TEST(GdcmPicture, LosslessCodingsComeBackExactly) {
  EXPECT_EQ(decoded(coded<gdcm::JPEGLSCodec>(), kJpegLs), kWords);
  EXPECT_EQ(decoded(coded<gdcm::JPEG2000Codec>(), kJpeg2000), kWords);
}

TEST(GdcmPicture, BrokenDataGiveNoneAndNothingIsPrinted) {
  testing::internal::CaptureStderr();
  for (const auto& [picture, syntax] : {std::pair{coded<gdcm::JPEGLSCodec>(), kJpegLs},
                                        std::pair{coded<gdcm::JPEG2000Codec>(), kJpeg2000}}) {
    EXPECT_EQ(decoded("not a picture", syntax), "none");
    decoded(picture.substr(0, picture.size() / 2), syntax);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(GdcmPicture, TheTraceOfTheProgramIsAsItWas) {
  const bool warning = gdcm::Trace::GetWarningFlag(), error = gdcm::Trace::GetErrorFlag();
  for (const bool flag : {true, false}) {
    gdcm::Trace::SetWarning(flag);
    gdcm::Trace::SetError(!flag);
    std::vector<std::thread> threads;
    for (int n = 0; n < 4; ++n) {
      threads.emplace_back([] {
        for (int round = 0; round < 50; ++round) {
          decode_by_gdcm(bytes_in("not a picture"), kJpegLs, small_pixels());
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(gdcm::Trace::GetWarningFlag(), flag);
    EXPECT_EQ(gdcm::Trace::GetErrorFlag(), !flag);
  }
  gdcm::Trace::SetWarning(warning);
  gdcm::Trace::SetError(error);
}

}  // namespace
}  // namespace mesamis
