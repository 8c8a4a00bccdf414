// SPDX-License-Identifier: Apache-2.0
// FreeSurfer's volumes: a header of 284 bytes, big endian, then the samples; .mgz is the same in
// gzip.
#include <array>
#include <cmath>
#include <string>

#include "mesamis/files/bytes.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/formats.h"

namespace mesamis::detail::volume_files {
namespace {

constexpr std::size_t kHeader = 284;

class MghHeader {
 public:
  explicit MghHeader(const std::filesystem::path& file) {
    ByteSource source(file, Packing::kSniffed);
    const std::size_t got = source.read(bytes_.data(), bytes_.size());
    if (got < kHeader || whole(0) != 1) {
      refuse(file, message("expected an MGH header of ", kHeader, " bytes and version 1, found ",
                           got, " bytes and ", got < 4 ? 0 : whole(0)));
    }
  }
  std::int64_t whole(std::size_t at) const {
    return load<std::int32_t>(bytes_.data() + at, ByteOrder::kBig);
  }
  double real(std::size_t at) const { return load<float>(bytes_.data() + at, ByteOrder::kBig); }
  Vec3 vector(std::size_t at) const { return {real(at), real(at + 4), real(at + 8)}; }
  /// Whether spacing, directions and centre are stated.
  bool is_placed() const { return load<std::int16_t>(bytes_.data() + 28, ByteOrder::kBig) > 0; }

 private:
  std::array<char, kHeader> bytes_{};
};

NumberType sample_type(const std::filesystem::path& file, std::int64_t code) {
  switch (code) {
    case 0:
      return NumberType::kUint8;
    case 1:
      return NumberType::kInt32;
    case 3:
      return NumberType::kFloat32;
    case 4:
      return NumberType::kInt16;
    case 10:
      return NumberType::kUint16;
    default:
      refuse(file, message("expected the MGH type 0, 1, 3, 4 or 10, found ", code));
  }
}

/// The header gives the centre of the volume, half of its size from the first voxel: RAS.
void place(ScanFile& scan, const MghHeader& h) {
  StatedAxes axes{{h.vector(42), h.vector(54), h.vector(66)}, h.vector(30)};
  Vec3 centre = h.vector(78);
  if (!h.is_placed()) {
    scan.warnings.push_back(
        "the header states no place: coronal slices of 1 mm are taken, as FreeSurfer does");
    axes = {{Vec3{-1, 0, 0}, Vec3{0, 0, -1}, Vec3{0, 1, 0}}, {1, 1, 1}};
    centre = {};
  }
  const auto to_lps = [](const Vec3& v) { return Vec3{-v.x, -v.y, v.z}; };
  Vec3 origin = to_lps(centre);
  for (Vec3& direction : axes.direction) direction = to_lps(direction);
  set_stated_axes(scan, axes);
  for (std::size_t a = 0; a < 3; ++a) {
    const double half = scan.grid.size[a] / 2.0 * scan.grid.spacing[static_cast<int>(a)];
    origin = origin - half * axes.direction[a];
  }
  set_origin(scan, origin);
}

}  // namespace

ScanFile open_mgh(const std::filesystem::path& file, const Opening& opening) {
  const MghHeader h(file);
  ScanFile scan = begin_scan(file, "MGH", opening);
  set_size(scan, {h.whole(4), h.whole(8), h.whole(12)});
  set_values(scan, {h.whole(16), 1}, ValueOrder::kVolumesFirst, opening);
  place(scan, h);
  scan.source.file = file;
  scan.source.type = sample_type(file, h.whole(20));
  scan.source.big_endian = true;
  scan.source.packing = Packing::kSniffed;
  scan.source.skip = kHeader;
  return scan;
}

}  // namespace mesamis::detail::volume_files
