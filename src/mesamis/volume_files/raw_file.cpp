// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/formats.h"

namespace mesamis {
namespace {

constexpr std::array<std::pair<std::string_view, RawType>, 6> kRawTypes{
    {{"uint8", RawType::kUint8},
     {"int16", RawType::kInt16},
     {"uint16", RawType::kUint16},
     {"int32", RawType::kInt32},
     {"float32", RawType::kFloat32},
     {"float64", RawType::kFloat64}}};

constexpr std::array<NumberType, 6> kNumberTypes{NumberType::kUint8,   NumberType::kInt16,
                                                 NumberType::kUint16,  NumberType::kInt32,
                                                 NumberType::kFloat32, NumberType::kFloat64};

std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(',');
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// "int16", "int16le", "int16be".
bool read_type(std::string_view word, RawLayout& layout) {
  layout.big_endian = word.ends_with("be");
  if (word.ends_with("be") || word.ends_with("le")) word.remove_suffix(2);
  for (const auto& [name, type] : kRawTypes) {
    if (word != name) continue;
    layout.type = type;
    return true;
  }
  return false;
}

bool read_count(std::string_view word, std::int64_t least, std::int64_t& count) {
  return parse_number(word, count) && count >= least;
}

bool read_layout(std::string_view text, RawLayout& layout) {
  const auto parts = parts_of(text);
  if (parts.size() != 4 && parts.size() != 5) return false;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!read_count(parts[a], 1, layout.size[a])) return false;
  }
  if (!read_type(parts[3], layout)) return false;
  return parts.size() == 4 || read_count(parts[4], 0, layout.header_bytes);
}

}  // namespace

RawLayout parse_raw_layout(std::string_view text) {
  RawLayout layout;
  if (read_layout(text, layout)) return layout;
  throw InputError(
      "expected NX,NY,NZ,TYPE or NX,NY,NZ,TYPE,HEADERBYTES with TYPE uint8, int16, uint16, int32, "
      "float32 or float64, and be or le behind it for the byte order, found " +
      in_quotes(text));
}

ScanFile detail::volume_files::open_raw(const std::filesystem::path& file,
                                        const RawLayout& layout) {
  ScanFile scan{file, "raw", {}, {}, {}};
  set_size(scan, layout.size);
  set_axes(scan, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}});
  scan.warnings.emplace_back("a raw file gives no spacing: 1 mm assumed");
  scan.source.file = file;
  scan.source.type = kNumberTypes[static_cast<std::size_t>(layout.type)];
  scan.source.big_endian = layout.big_endian;
  scan.source.offset = static_cast<std::uint64_t>(layout.header_bytes);
  // At most 2^40 voxels of 8 bytes, and a header below 2^63: no sum leaves 64 bits.
  const std::uint64_t samples =
      std::uint64_t{scan.grid.voxel_count()} * byte_size(scan.source.type);
  const std::uint64_t expected = scan.source.offset + samples, found = size_of(file);
  if (found != expected) {
    refuse(file, message("expected ", expected, " bytes, ", scan.source.offset, " of header and ",
                         samples, " of ", layout.size[0], " x ", layout.size[1], " x ",
                         layout.size[2], " samples, found ", found));
  }
  return scan;
}

}  // namespace mesamis
