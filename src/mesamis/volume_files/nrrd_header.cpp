// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/nrrd_header.h"

#include <bit>
#include <limits>
#include <locale>
#include <sstream>
#include <string_view>

namespace mesamis::detail::volume_files {
namespace {

/// A stream that writes numbers so that they read back to the same bits.
std::ostringstream exact_text() {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  return text;
}

std::string tuple(const Vec3& v) {
  std::ostringstream text = exact_text();
  text << '(' << v.x << ',' << v.y << ',' << v.z << ')';
  return text.str();
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    out += c == '\n' ? "\\n" : c == '\\' ? "\\\\" : std::string(1, c);
  }
  return out;
}

}  // namespace

std::string nrrd_header(const VoxelGrid& grid, const NrrdContent& content) {
  const Mat3 axes = transpose(grid.direction);
  const bool list = content.values > 1;
  std::ostringstream text = exact_text();
  text << "NRRD0004\ntype: " << content.type << "\ndimension: " << (list ? 4 : 3)
       << "\nspace: left-posterior-superior\nsizes:";
  if (list) text << ' ' << content.values;
  text << ' ' << grid.size[0] << ' ' << grid.size[1] << ' ' << grid.size[2]
       << "\nspace directions:" << (list ? " none" : "");
  for (int a = 0; a < 3; ++a) {
    text << ' ' << tuple(grid.spacing[a] * axes.rows[static_cast<std::size_t>(a)]);
  }
  text << "\nkinds:" << (list ? " list" : "")
       << " domain domain domain\nspace units: \"mm\" \"mm\" \"mm\"\nspace origin: "
       << tuple(grid.origin)
       << "\nendian: " << (std::endian::native == std::endian::little ? "little" : "big")
       << "\nencoding: " << (content.gzip ? "gzip" : "raw") << "\n";
  for (const auto& [key, value] : content.keys) {
    text << escaped(key) << ":=" << escaped(value) << "\n";
  }
  text << "\n";
  return text.str();
}

}  // namespace mesamis::detail::volume_files
