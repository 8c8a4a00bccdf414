// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::decimate {

/// A triangle, its box, its plane and those through its sides across it: most distances follow from
/// these without a branch.
class TrianglePlanes {
 public:
  explicit TrianglePlanes(const Corners& t) : corners_(t), box_(bounding_box(t)) {
    const Vec3 area = cross(t[1] - t[0], t[2] - t[0]);
    normal_ = unit_or_zero(area);
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 side = t[(i + 1) % 3] - t[i];
      longest = std::max(longest, dot(side, side));
      outward_[i] = unit_or_zero(cross(side, normal_));
      offset_[i] = dot(outward_[i], t[i]);
    }
    height_ = dot(normal_, t[0]);
    // The planes of needles are lost to rounding.
    is_flat_ = !(dot(area, area) > 1e-8 * longest * longest);
  }

  const Corners& corners() const { return corners_; }
  const Box& box() const { return box_; }
  /// Whether its planes are lost to rounding.
  bool is_flat() const { return is_flat_; }
  /// The direction, of unit length, out of the side from corner i to the next.
  const Vec3& outward(std::size_t i) const { return outward_[i]; }
  /// How far a point lies beyond that side, mm; on the inner side of it: negative.
  double beyond(std::size_t i, const Vec3& p) const { return dot(outward_[i], p) - offset_[i]; }
  /// The nearest point of the plane.
  Vec3 foot_of(const Vec3& p) const { return p - (dot(normal_, p) - height_) * normal_; }

  /// How far a point lies beyond the side that it is farthest beyond, mm; none: negative.
  double beyond(const Vec3& p) const {
    return std::max({beyond(0, p), beyond(1, p), beyond(2, p)});
  }
  /// Whether all of another triangle lies beyond one side by more than a distance, mm.
  bool is_beyond(const Corners& other, double distance) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const double least = std::min(
          {dot(outward_[i], other[0]), dot(outward_[i], other[1]), dot(outward_[i], other[2])});
      if (!is_flat_ && least > offset_[i] + distance) return true;
    }
    return false;
  }
  /// The squared distance of a point, mm^2; infinity where it exceeds the bound given.
  double squared_distance_up_to(double most, const Vec3& p) const {
    if (is_flat_) return squared_distance(p, corners_);
    const double height = dot(normal_, p) - height_, beside = beyond(p);
    if (beside <= 0) return height * height;
    if (height * height + beside * beside > most) return kTooFar;
    return squared_distance(p, corners_);
  }

 private:
  static constexpr double kTooFar = std::numeric_limits<double>::infinity();
  Corners corners_;
  Box box_;
  Vec3 normal_;
  std::array<Vec3, 3> outward_;
  std::array<double, 3> offset_;
  double height_;
  bool is_flat_;
};

}  // namespace mesamis::detail::decimate
