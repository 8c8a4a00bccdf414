// SPDX-License-Identifier: Apache-2.0
// Grey pictures as JPEG, one slice each. JPEG is lossy: a warning says so.
#include <string>
#include <utility>

#include "mesamis/files/byte_source.h"
#include "mesamis/files/bytes.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/dicom_jpeg.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/grey_pixels.h"

namespace mesamis::detail::volume_files {
namespace {

struct Jpeg {
  std::string bytes;
  PictureHeader header;
  Vec3 spacing;  ///< mm along x and y; zero: not stated

  Bytes picture() const {
    return {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()};
  }
};

/// Dots per inch or centimetre, of a segment JFIF that comes first.
Vec3 resolution_in(std::string_view bytes) {
  constexpr std::size_t kJfif = 6, kUnit = 13, kX = 14, kY = 16;
  if (bytes.size() < kY + 2 || bytes.substr(kJfif, 4) != "JFIF") return {};
  const double mm = bytes[kUnit] == 1 ? 25.4 : bytes[kUnit] == 2 ? 10 : 0;
  const auto x = load<std::uint16_t>(bytes.data() + kX, ByteOrder::kBig);
  const auto y = load<std::uint16_t>(bytes.data() + kY, ByteOrder::kBig);
  return x > 0 && y > 0 ? Vec3{mm / x, mm / y, 0} : Vec3{};
}

Jpeg parse(const std::filesystem::path& file, MemoryBudget& budget) {
  Jpeg jpeg{read_all(file, budget), {}, {}};
  const auto header =
      jpeg.bytes.starts_with("\xff\xd8") ? jpeg_header(jpeg.picture()) : std::nullopt;
  if (!header || header->columns < 1 || header->rows < 1) {
    refuse(file, "expected a JPEG file, found something else or a cut off one");
  }
  if (header->components != 1 || header->bits > 16) {
    refuse(file, message("expected a grey JPEG, found ", header->components, " components of ",
                         header->bits, " bits"));
  }
  constexpr std::uint64_t kMostPixelsPerByte = 4096;
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(header->columns) * static_cast<std::uint64_t>(header->rows);
  if (pixels > kMostPixelsPerByte * jpeg.bytes.size()) {
    refuse(file, message("expected a file that can hold ", header->columns, " x ", header->rows,
                         " pixels, found ", jpeg.bytes.size(), " bytes"));
  }
  if (!has_end_marker(jpeg.picture())) refuse(file, "the JPEG file is cut off");
  jpeg.header = *header;
  jpeg.spacing = resolution_in(jpeg.bytes);
  return jpeg;
}

ScanFile scan_of(const std::filesystem::path& file, const Jpeg& jpeg) {
  ScanFile scan{file, "JPEG", {}, {}, {}};
  set_picture_grid(scan, {jpeg.header.columns, jpeg.header.rows}, jpeg.spacing);
  scan.source.type = jpeg.header.bits > 8 ? NumberType::kUint16 : NumberType::kUint8;
  scan.warnings.emplace_back("JPEG is lossy: edges may be off by some pixels");
  return scan;
}

/// Values between two labels, which the coding makes at their border, are other labels.
void require_no_labels(const std::filesystem::path& file, const Opening& opening) {
  if (!opening.labels) return;
  refuse(file, "expected labels as .png, .tif or .bmp, found JPEG, which is lossy");
}

}  // namespace

ScanFile open_jpeg(const std::filesystem::path& file, const Opening& opening) {
  require_no_labels(file, opening);
  return scan_of(file, parse(file, opening.budget));
}

VolumeFile read_jpeg(const std::filesystem::path& file, const Opening& opening) {
  require_no_labels(file, opening);
  const Jpeg jpeg = parse(file, opening.budget);
  ScanFile scan = scan_of(file, jpeg);
  opening.budget.claim(scan.grid.voxel_count(), sizeof(float) + 2 * sizeof(std::uint16_t),
                       "samples");
  const auto samples = decode_jpeg(jpeg.picture(), jpeg.header);
  if (!samples || !samples->intact) refuse(file, "expected a JPEG file, found broken data");
  VolumeFile out{std::move(scan.grid), scan.format, std::move(scan.warnings)};
  out.volume.samples.assign(samples->values.begin(), samples->values.end());
  return out;
}

}  // namespace mesamis::detail::volume_files
