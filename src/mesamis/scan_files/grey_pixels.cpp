// SPDX-License-Identifier: Apache-2.0
#include "mesamis/scan_files/grey_pixels.h"

#include "mesamis/files/refuse.h"

namespace mesamis::detail {

void set_picture_grid(ScanFile& scan, const std::array<std::int64_t, 2>& size,
                      const Vec3& spacing) {
  set_size(scan, {size[0], size[1], 1});
  Vec3 steps = spacing;
  if (!(spacing.x > 0 && spacing.y > 0)) {
    steps = {1, 1, 1};
    scan.warnings.emplace_back("the file gives no resolution: 1 mm taken along x and y");
  }
  scan.warnings.emplace_back("the file gives no distance between slices: 1 mm taken");
  set_axes(scan, {Vec3{steps.x, 0, 0}, Vec3{0, steps.y, 0}, Vec3{0, 0, 1}});
}

float require_grey(const std::filesystem::path& file, const std::array<unsigned, 3>& color,
                   const std::array<std::int64_t, 2>& pixel) {
  if (color[0] == color[1] && color[1] == color[2]) return static_cast<float>(color[0]);
  refuse(file, say("expected a grey picture, found red ", color[0], ", green ", color[1], ", blue ",
                   color[2], " at pixel ", pixel[0], ", ", pixel[1]));
}

}  // namespace mesamis::detail
