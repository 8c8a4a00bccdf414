// SPDX-License-Identifier: Apache-2.0
// Micro-CT of Scanco Medical: .isq as it is measured, .aim as it is evaluated. Little endian.
#include <array>
#include <bit>
#include <cmath>
#include <string>

#include "mesamis/files/bytes.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/formats.h"

namespace mesamis::detail::volume_files {
namespace {

constexpr std::size_t kBlock = 512;
constexpr double kMmPerUm = 1e-3, kMmPerNm = 1e-6;

/// The first bytes of a file.
class Header {
 public:
  explicit Header(const std::filesystem::path& file) {
    ByteSource source(file, Packing::kPlain);
    size_ = source.read(bytes_.data(), bytes_.size());
  }
  std::size_t size() const { return size_; }
  bool begins(std::string_view text) const {
    return std::string_view(bytes_.data(), size_).starts_with(text);
  }
  /// 0 behind the end of the file.
  template <class Number>
  Number at(std::size_t place) const {
    return place + sizeof(Number) <= size_ ? load<Number>(bytes_.data() + place) : Number{};
  }

 private:
  std::array<char, kBlock> bytes_{};
  std::size_t size_ = 0;
};

void warn_of_values(ScanFile& scan) {
  scan.warnings.emplace_back(
      "the values are those stored, attenuation times a factor of the scanner: no Hounsfield "
      "units");
}

// --- ISQ ----------------------------------------------------------------------------------------

std::array<std::int64_t, 3> three(const Header& header, std::size_t at) {
  return {header.at<std::int32_t>(at), header.at<std::int32_t>(at + 4),
          header.at<std::int32_t>(at + 8)};
}

// --- AIM ----------------------------------------------------------------------------------------

/// The two versions differ in the width of their numbers and in where the description begins.
struct AimLayout {
  std::size_t width = 4, first = 0, before_type = 20;
};

std::int64_t whole(const Header& header, const AimLayout& layout, std::size_t at) {
  return layout.width == 8 ? header.at<std::int64_t>(at) : header.at<std::int32_t>(at);
}

/// A number of VAX: the halves are swapped, and the exponent's bias is larger by two.
double vax_float(const Header& header, std::size_t at) {
  const auto bits = header.at<std::uint32_t>(at);
  return 0.25 * static_cast<double>(std::bit_cast<float>(bits << 16 | bits >> 16));
}

NumberType aim_type(const std::filesystem::path& file, std::int32_t code) {
  switch (code) {
    case 0x00010001:
      return NumberType::kInt8;
    case 0x00160001:
    case 0x000d0001:
      return NumberType::kUint8;
    case 0x00020002:
      return NumberType::kInt16;
    case 0x00170002:
      return NumberType::kUint16;
    case 0x00030004:
      return NumberType::kInt32;
    case 0x001a0004:
      return NumberType::kFloat32;
    default:
      refuse(file, message("expected an AIM of uncompressed numbers, found the type ", code,
                           "; save it uncompressed"));
  }
}

/// Position and size come one after the other, in voxels.
void place_aim(ScanFile& scan, const Header& header, const AimLayout& layout, std::size_t at) {
  constexpr std::size_t kCounts = 21;  // seven triples before the size of a voxel
  std::array<std::int64_t, 3> position{}, size{};
  Vec3 spacing;
  for (std::size_t a = 0; a < 3; ++a) {
    position[a] = whole(header, layout, at + a * layout.width);
    size[a] = whole(header, layout, at + (3 + a) * layout.width);
    const std::size_t element = at + (kCounts + a) * layout.width;
    spacing[static_cast<int>(a)] =
        layout.width == 8 ? kMmPerNm * static_cast<double>(header.at<std::int64_t>(element))
                          : vax_float(header, element);
  }
  set_size(scan, size);
  set_stated_axes(scan, {{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, spacing});
  const Vec3 s = scan.grid.spacing;
  set_origin(scan, {static_cast<double>(position[0]) * s.x, static_cast<double>(position[1]) * s.y,
                    static_cast<double>(position[2]) * s.z});
}

}  // namespace

ScanFile open_isq(const std::filesystem::path& file, const Opening& opening) {
  const Header header(file);
  if (!header.begins("CTDATA-HEADER_V1") || header.size() < kBlock) {
    refuse(file, "expected an ISQ file (CTDATA-HEADER_V1), found something else");
  }
  ScanFile scan = begin_scan(file, "ISQ", opening);
  if (header.at<std::int32_t>(16) != 3) {
    refuse(file, message("expected 16-bit samples (data type 3), found data type ",
                         header.at<std::int32_t>(16)));
  }
  const auto size = three(header, 44), um = three(header, 56);
  set_size(scan, size);
  const auto spacing = [&](std::size_t a) {
    return kMmPerUm * static_cast<double>(um[a]) / static_cast<double>(size[a]);
  };
  set_stated_axes(
      scan, {{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {spacing(0), spacing(1), spacing(2)}});
  const std::int64_t blocks = header.at<std::int32_t>(508);
  if (blocks < 0) refuse(file, message("expected an offset of the samples, found ", blocks));
  scan.source.file = file;
  scan.source.type = NumberType::kInt16;
  scan.source.offset = (static_cast<std::uint64_t>(blocks) + 1) * kBlock;
  warn_of_values(scan);
  return scan;
}

ScanFile open_aim(const std::filesystem::path& file, const Opening& opening) {
  const Header header(file);
  AimLayout layout;
  if (header.begins("AIMDATA_V030")) layout = {8, 16, 12};
  const std::int64_t before = whole(header, layout, layout.first);
  const std::int64_t described = whole(header, layout, layout.first + layout.width);
  const std::int64_t log = whole(header, layout, layout.first + 2 * layout.width);
  const bool is_aim = layout.width == 8 ? before >= 24 && before <= 64 && described >= 200
                                        : before == 20 && described == 140;
  if (!is_aim || described > 1000 || log < 0) {
    refuse(file, "expected an AIM file of version 020 or 030, found something else");
  }
  ScanFile scan = begin_scan(file, "AIM", opening);
  const std::size_t type = layout.first + static_cast<std::size_t>(before) + layout.before_type;
  scan.source.type = aim_type(file, header.at<std::int32_t>(type));
  place_aim(scan, header, layout, type + 4);
  scan.source.file = file;
  scan.source.offset = layout.first + static_cast<std::uint64_t>(before) +
                       static_cast<std::uint64_t>(described) + static_cast<std::uint64_t>(log);
  if (byte_size(scan.source.type) > 1) warn_of_values(scan);
  return scan;
}

}  // namespace mesamis::detail::volume_files
