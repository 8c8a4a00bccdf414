// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/gdcm_picture.h"

#include <gdcmImage.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>
#include <gdcmTransferSyntax.h>

#include <algorithm>
#include <exception>
#include <mutex>

namespace mesamis::detail::volume_files {
namespace {

gdcm::PixelFormat gdcm_format(const DicomPixels& p) {
  const auto bits = [](int n) { return static_cast<unsigned short>(n); };
  return gdcm::PixelFormat(1, bits(p.bits_allocated), bits(p.bits_stored), bits(p.bits_stored - 1),
                           bits(p.is_signed));
}

/// gdcm::Trace is off while one or more of these live, in any thread.
class SilentTrace {
 public:
  SilentTrace() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (holders_++ > 0) return;
    debug_ = gdcm::Trace::GetDebugFlag();
    warning_ = gdcm::Trace::GetWarningFlag();
    error_ = gdcm::Trace::GetErrorFlag();
    set(false, false, false);
  }
  ~SilentTrace() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (--holders_ == 0) set(debug_, warning_, error_);
  }
  SilentTrace(const SilentTrace&) = delete;
  SilentTrace& operator=(const SilentTrace&) = delete;

 private:
  static void set(bool debug, bool warning, bool error) {
    gdcm::Trace::SetDebug(debug);
    gdcm::Trace::SetWarning(warning);
    gdcm::Trace::SetError(error);
  }

  static inline std::mutex mutex_;
  static inline int holders_ = 0;
  static inline bool debug_ = false, warning_ = false, error_ = false;
};

/// The data element with the pixels as one fragment.
gdcm::DataElement pixel_data(Bytes picture) {
  gdcm::Fragment fragment;
  fragment.SetByteValue(reinterpret_cast<const char*>(picture.data()),
                        static_cast<std::uint32_t>(picture.size()));
  gdcm::SmartPointer<gdcm::SequenceOfFragments> fragments = new gdcm::SequenceOfFragments;
  fragments->AddFragment(fragment);
  gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
  pixels.SetVR(gdcm::VR::OB);
  pixels.SetValue(*fragments);
  return pixels;
}

std::size_t frame_bytes(const DicomPixels& p) {
  return static_cast<std::size_t>(p.rows) * static_cast<std::size_t>(p.columns) *
         static_cast<std::size_t>(p.bits_allocated / 8);
}

}  // namespace

std::optional<std::vector<unsigned char>> decode_by_gdcm(Bytes picture,
                                                         const std::string& transfer_syntax,
                                                         const DicomPixels& p) {
  gdcm::Image image;
  image.SetNumberOfDimensions(2);
  image.SetDimension(0, static_cast<unsigned>(p.columns));
  image.SetDimension(1, static_cast<unsigned>(p.rows));
  image.SetPixelFormat(gdcm_format(p));
  image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image.SetTransferSyntax(gdcm::TransferSyntax::GetTSType(transfer_syntax.c_str()));
  image.SetDataElement(pixel_data(picture));
  std::vector<unsigned char> out(std::max<std::size_t>(image.GetBufferLength(), frame_bytes(p)));
  const SilentTrace silent;
  try {
    const bool decoded = image.GetBuffer(reinterpret_cast<char*>(out.data()));
    if (!decoded || image.GetBufferLength() != frame_bytes(p)) return std::nullopt;
  } catch (const std::exception&) {
    return std::nullopt;
  }
  return out;
}

}  // namespace mesamis::detail::volume_files
