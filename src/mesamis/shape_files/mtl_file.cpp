// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/refuse.h"
#include "mesamis/files/text_scan.h"
#include "mesamis/files/text_writer.h"
#include "mesamis/shape_files/object_formats.h"

namespace mesamis::detail::shape_files {
namespace {

namespace fs = std::filesystem;

/// Three shares of 0 to 1; none where the line has a spectrum or CIE values.
std::optional<Colour> colour_in(const fs::path& file, std::string_view line, std::size_t number) {
  Colour colour{};
  for (std::uint8_t& channel : colour) {
    const std::string_view word = take_word(line);
    if (word == "spectral" || word == "xyz") return std::nullopt;
    double share = 0;
    if (!parse_number(word, share)) {
      refuse(file, message("line ", number, ": expected three numbers after Kd"));
    }
    channel = channel_of(share);
  }
  return colour;
}

}  // namespace

std::string mtl_bytes(std::span<const NamedSurface> objects) {
  const std::vector<std::string> names = safe_names(objects);
  std::string out = "# mesamis\n";
  for (std::size_t i = 0; i < objects.size(); ++i) {
    out += "newmtl " + names[i] + "\nKd";
    for (const std::uint8_t channel : objects[i].colour)
      append_shortest(out += ' ', channel / 255.0);
    out += '\n';
  }
  return out;
}

std::map<std::string, Colour> parse_mtl(const fs::path& file, std::string_view bytes,
                                        MemoryBudget& budget) {
  constexpr std::size_t kNodeBytes = 128;  // of the map, beside the name
  std::map<std::string, Colour> colours;
  std::string name;
  std::size_t number = 1;
  for (std::string_view line; take_line(bytes, line); ++number) {
    const std::string_view keyword = take_word(line);
    if (keyword == "newmtl") name = trimmed(line);
    if (keyword != "Kd") continue;
    if (const auto colour = colour_in(file, line, number)) {
      budget.claim(1, kNodeBytes + name.size(), "materials");
      colours[name] = *colour;
    }
  }
  return colours;
}

}  // namespace mesamis::detail::shape_files
