// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "mesamis/base/types.h"
#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::image {

/// An image between its voxels, linear along each axis; constant beyond the outermost voxel centres.
class Trilinear {
 public:
  /// @param volume  at least 2 voxels along each axis; must live as long as this.
  explicit Trilinear(const VolumeView& volume)
      : samples_(volume.samples.data()),
        size_(volume.size),
        step_y_(volume.size[0]),
        step_z_(step_y_ * volume.size[1]) {}

  /// @param p  in voxels along the axes of the grid, finite.
  /// @return in the unit of the samples.
  double at(const Vec3& p) const {
    double fx, fy, fz;
    const float* s = samples_ + place(p.x, size_[0], fx) + step_y_ * place(p.y, size_[1], fy) +
                     step_z_ * place(p.z, size_[2], fz);
    return mix(mix(row(s, fx), row(s + step_y_, fx), fy),
               mix(row(s + step_z_, fx), row(s + step_y_ + step_z_, fx), fy), fz);
  }

 private:
  static std::ptrdiff_t place(double x, Index size, double& fraction) {
    const double inside = std::clamp<double>(x, 0, size - 1);
    const Index cell = std::min(static_cast<Index>(inside), size - 2);
    fraction = inside - cell;
    return cell;
  }
  static double mix(double a, double b, double fraction) { return a + fraction * (b - a); }
  static double row(const float* s, double fraction) { return mix(s[0], s[1], fraction); }

  const float* samples_;
  std::array<Index, 3> size_;
  std::ptrdiff_t step_y_, step_z_;
};

}  // namespace mesamis::detail::image
