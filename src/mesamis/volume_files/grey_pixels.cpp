// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/grey_pixels.h"

#include <cmath>
#include <utility>

#include "mesamis/files/refuse.h"

namespace mesamis::detail::volume_files {

void warn_of_screen_resolution(double spacing_mm, std::vector<std::string>& warnings) {
  constexpr double kInch = 25.4, kTolerance = 0.05;
  for (const int per_inch : {72, 96}) {
    if (!(std::abs(kInch / spacing_mm - per_inch) < kTolerance)) continue;
    warnings.push_back(message("the resolution of ", per_inch,
                               " pixels per inch is typical of screens: check it (--spacing)"));
  }
  for (const auto& [mm, name] : {std::pair(kInch, "inch"), std::pair(10.0, "centimetre")}) {
    if (!(std::abs(spacing_mm - mm) < 2e-3 * mm)) continue;
    warnings.push_back(message("the resolution of one pixel per ", name,
                               " is typical of files without a measure: check it (--spacing)"));
  }
}

void set_picture_grid(ScanFile& scan, const std::array<std::int64_t, 2>& size,
                      const Vec3& spacing) {
  set_size(scan, {size[0], size[1], 1});
  Vec3 steps = spacing;
  if (!(spacing.x > 0 && spacing.y > 0)) {
    steps = {1, 1, 1};
    scan.warnings.emplace_back("the file gives no resolution: 1 mm assumed along x and y");
  }
  warn_of_screen_resolution(steps.x, scan.warnings);
  scan.warnings.emplace_back("the file gives no distance between slices: 1 mm assumed");
  set_axes(scan, {Vec3{steps.x, 0, 0}, Vec3{0, steps.y, 0}, Vec3{0, 0, 1}});
}

float require_grey(const std::filesystem::path& file, const std::array<unsigned, 3>& color,
                   const std::array<std::int64_t, 2>& pixel) {
  if (color[0] == color[1] && color[1] == color[2]) return static_cast<float>(color[0]);
  refuse(file, message("expected a grey picture, found red ", color[0], ", green ", color[1],
                       ", blue ", color[2], " at pixel ", pixel[0], ", ", pixel[1]));
}

void keep_palette(ScanFile& scan, std::string_view palette, std::size_t stride) {
  for (std::size_t at = 0; at + 3 <= palette.size(); at += stride) {
    const auto share = [&](std::size_t c) { return static_cast<std::uint8_t>(palette[at + c]); };
    scan.palette.push_back({share(0), share(1), share(2)});
  }
  if (scan.palette.empty() || scan.palette.front() == std::array<std::uint8_t, 3>{}) return;
  scan.warnings.emplace_back(
      "labels are the indices of the table of colours: 0 is the background, though it is not "
      "black");
}

}  // namespace mesamis::detail::volume_files
