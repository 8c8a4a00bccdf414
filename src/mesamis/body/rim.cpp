// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/rim.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/written_number.h"
#include "mesamis/image/trilinear.h"
#include "mesamis/surface/signed_distance.h"

namespace mesamis::detail::body {
namespace {

constexpr double kDeviations = 2;        // of the blur: 2 % are left of the surroundings
constexpr double kVoxelDeviation = 0.5;  // voxels: what a voxel and linear interpolation blur
constexpr double kAtBorder = 1e-3;       // voxels: coordinates of surfaces are in single precision

void require_depth(const Vec3& depth) {
  for (int axis = 0; axis < 3; ++axis) {
    if (depth[axis] >= 0 && std::isfinite(depth[axis])) continue;
    throw InputError("rim: expected depths of at least 0 mm, found " + number_text(depth[axis]));
  }
}

/// The greatest distance, mm, between the surface and a voxel that is changed: the depth, or the
/// diagonal of a voxel, which neighbours of a point inside are not beyond.
double reach_of(const VoxelGrid& grid, const Vec3& depth) {
  return std::max({depth.x, depth.y, depth.z, norm(grid.spacing)});
}

/// The surface with what lies on the border of the scan moved out of reach: there the object goes
/// on, so that the border is no surface of it.
TriMesh without_ends(TriMesh surface, const VoxelGrid& grid, double reach) {
  const Box box = grid.box();
  for (Vec3& point : surface.points) {
    Vec3 p = grid.to_grid(point);
    bool moved = false;
    for (int axis = 0; axis < 3; ++axis) {
      const double near = kAtBorder * grid.spacing[axis];
      const bool low = p[axis]<box.lo[axis] + near, high = p[axis]> box.hi[axis] - near;
      if (low != high) p[axis] += low ? -2 * reach : 2 * reach;
      moved |= low != high;
    }
    if (moved) point = grid.to_world(p);
  }
  return surface;
}

/// Marks the voxels in the boxes around the triangles, widened by the reach.
std::vector<std::uint8_t> voxels_near(const TriMesh& surface, const VoxelGrid& grid, double reach) {
  std::vector<std::uint8_t> marks(grid.voxel_count(), 0);
  for (const Triangle& triangle : surface.triangles) {
    std::array<Index, 3> first{}, last{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      double lo = std::numeric_limits<double>::infinity(), hi = -lo;
      for (const Index n : triangle) {
        const double x = grid.to_grid(surface.points[static_cast<std::size_t>(n)])[a];
        lo = std::min(lo, x);
        hi = std::max(hi, x);
      }
      const double end = grid.size[axis] - 1;
      first[axis] =
          static_cast<Index>(std::ceil(std::clamp((lo - reach) / grid.spacing[a], 0.0, end + 1)));
      last[axis] =
          static_cast<Index>(std::floor(std::clamp((hi + reach) / grid.spacing[a], -1.0, end)));
    }
    for (Index k = first[2]; k <= last[2]; ++k) {
      for (Index j = first[1]; j <= last[1]; ++j) {
        for (Index i = first[0]; i <= last[0]; ++i) marks[grid.offset(i, j, k)] = 1;
      }
    }
  }
  return marks;
}

/// Works on one surface after the other; a voxel follows the one that it is deepest in.
class RimFiller {
 public:
  RimFiller(const VolumeView& volume, const Vec3& depth)
      : volume_(volume),
        image_(volume),
        depth_(depth),
        reach_(reach_of(volume, depth)),
        filled_(copy_volume(volume)),
        distance_(volume.voxel_count(), std::numeric_limits<float>::infinity()) {}

  void fill(const TriMesh& surface) {
    const SignedDistance distance(without_ends(surface, volume_, reach_));
    const std::vector<std::uint8_t> marks = voxels_near(surface, volume_, reach_);
    parallel_for(marks.size(), [&](std::size_t n) {
      if (marks[n] != 0) fill_voxel(n, distance);
    });
  }

  Volume take() { return std::move(filled_); }

 private:
  void fill_voxel(std::size_t n, const SignedDistance& surface) {
    const auto [i, j, k] = volume_.voxel(n);
    const Vec3& s = volume_.spacing;
    const NearestPoint nearest = surface.at(volume_.to_world({i * s.x, j * s.y, k * s.z}));
    const Vec3 normal = transpose(volume_.direction) * nearest.normal;
    const double depth = norm(Vec3{normal.x * depth_.x, normal.y * depth_.y, normal.z * depth_.z});
    const auto signed_to = static_cast<float>(nearest.signed_to);
    if (nearest.signed_to > reach_ || signed_to >= distance_[n]) return;
    distance_[n] = signed_to;
    filled_.samples[n] = volume_.samples[n];  // whatever another surface asked for
    if (nearest.signed_to < -depth) return;
    const Vec3 below = nearest.point - depth * nearest.normal;
    if (surface.at(below).signed_to > 0) return;  // beyond a thin wall
    const Vec3 at = volume_.to_grid(below);
    const double value = image_.at({at.x / s.x, at.y / s.y, at.z / s.z});
    filled_.samples[n] = std::max(volume_.samples[n], static_cast<float>(value));
  }

  const VolumeView& volume_;
  Trilinear image_;
  Vec3 depth_;
  double reach_;
  Volume filled_;
  std::vector<float> distance_;  // mm, from the surface that the voxel follows
};

}  // namespace

Vec3 rim_depth(const VoxelGrid& grid, const std::array<double, 3>& blur) {
  const auto along = [&](int axis) {
    const double sigma = std::hypot(blur[static_cast<std::size_t>(axis)], kVoxelDeviation);
    return kDeviations * sigma * grid.spacing[axis];
  };
  return {along(0), along(1), along(2)};
}

Volume with_full_rim(const VolumeView& volume, std::span<const TriMesh> surfaces,
                     const Vec3& depth) {
  require_depth(depth);
  if (surfaces.empty() || norm(depth) == 0) return copy_volume(volume);
  RimFiller filler(volume, depth);
  for (const TriMesh& surface : surfaces) filler.fill(surface);
  return filler.take();
}

}  // namespace mesamis::detail::body
