// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "mesamis/base/types.h"

namespace mesamis {

/// A scan: one sample per voxel centre of a regular grid, and where the grid lies in the world.
///
/// World frame: LPS (x to the patient's left, y to the back, z to the head), in mm.
/// World position of voxel (i, j, k): origin + direction * (i sx, j sy, k sz).
struct Volume {
  std::array<Index, 3> size{0, 0, 0};  ///< voxels along i, j, k
  Vec3 spacing{1, 1, 1};               ///< mm between voxel centres, positive
  Vec3 origin{0, 0, 0};                ///< LPS position of voxel (0, 0, 0), mm
  Mat3 direction;                      ///< orthonormal; column k is the LPS direction of axis k.
                                       ///< Its determinant may be -1: a left-handed grid
  std::string modality;                ///< "CT", "MR", ... as the file says; empty: unknown
  std::vector<float> samples;          ///< native units (HU, counts); i runs fastest, then j, k

  std::size_t voxel_count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  std::size_t offset(Index i, Index j, Index k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(i);
  }
  float at(Index i, Index j, Index k) const { return samples[offset(i, j, k)]; }

  /// The box spanned by the voxel centres, in the grid's own axes: [0, (n-1) s] per direction.
  Box box() const {
    return {{0, 0, 0},
            {(size[0] - 1) * spacing.x, (size[1] - 1) * spacing.y, (size[2] - 1) * spacing.z}};
  }
  /// The geometric mean of the spacing, mm.
  double voxel_size() const { return std::cbrt(spacing.x * spacing.y * spacing.z); }
  /// The shortest side of a voxel, mm.
  double shortest_side() const { return std::min({spacing.x, spacing.y, spacing.z}); }
  /// From the grid's own axes (mm) to the world (LPS, mm).
  Vec3 to_world(const Vec3& p) const { return origin + direction * p; }
  /// From the world (LPS, mm) to the grid's own axes (mm).
  Vec3 to_grid(const Vec3& p) const { return transpose(direction) * (p - origin); }
};

/// Checks what every method relies on: at least 2 voxels per direction, as many samples as
/// voxels, positive finite spacing, finite origin, orthonormal direction (to 1e-6), finite samples
/// that are not all equal. A reader may hand on a volume that fails here (one slice of a file
/// with a third axis, an unknown sample): this is the gate before any method.
/// @throws InputError  with the first thing that is wrong.
void require_usable(const Volume& volume);

/// Half-open voxel ranges [begin, end) per direction; an end of -1 means the volume's.
struct CropRange {
  std::array<Index, 3> begin{0, 0, 0};
  std::array<Index, 3> end{-1, -1, -1};
  friend bool operator==(const CropRange&, const CropRange&) = default;
};

/// How many voxels of the volume the range keeps.
/// @throws InputError  if the volume has fewer than 2 voxels along an axis, or the range leaves it
///                     or keeps fewer.
std::array<Index, 3> cropped_size(const Volume& volume, const CropRange& range);

/// The part of the volume inside the range; its world position is kept.
/// @throws InputError  as cropped_size().
Volume crop(const Volume& volume, const CropRange& range);

/// Keeps every stride-th voxel, starting with the first.
/// @throws InputError  if a stride is below 1 or leaves fewer than 2 voxels in a direction.
Volume subsample(const Volume& volume, const std::array<Index, 3>& stride);

/// Values on a regular grid as a continuous function: linear on each of the six Kuhn tetrahedra of
/// a grid cell, equal to the values at the nodes. It is the piecewise linear function of a mesh
/// made by kuhn_cell on the grid, found without the mesh: from the cell's lowest corner walk along
/// the axes, the largest fraction first, and weigh the four corners met.
/// @param values   one per node; i runs fastest, then j, k.
/// @param size     nodes along i, j, k; at least 2 each.
/// @param spacing  between nodes.
/// @param p        in the grid's own axes, in the spacing's unit; clamped to the box.
template <class Number>
double interpolate(std::span<const Number> values, const std::array<Index, 3>& size,
                   const Vec3& spacing, const Vec3& p) {
  assert(std::min({size[0], size[1], size[2]}) >= 2);
  const auto stride_j = static_cast<std::ptrdiff_t>(size[0]);
  std::array<std::ptrdiff_t, 3> stride{1, stride_j, stride_j * size[1]};
  std::array<double, 3> fraction;
  std::ptrdiff_t corner = 0;
  for (int a = 0; a < 3; ++a) {
    const Index last = size[static_cast<std::size_t>(a)] - 1;
    double t = p[a] / spacing[a];
    t = t > 0 ? std::min<double>(t, last) : 0;  // NaN goes to 0
    const Index cell = std::min(static_cast<Index>(t), last - 1);
    fraction[static_cast<std::size_t>(a)] = t - cell;
    corner += stride[static_cast<std::size_t>(a)] * cell;
  }
  const auto order = [&fraction, &stride](std::size_t a, std::size_t b) {
    const bool swap = fraction[a] < fraction[b];
    const double fa = fraction[a], fb = fraction[b];
    const std::ptrdiff_t sa = stride[a], sb = stride[b];
    fraction[a] = swap ? fb : fa, fraction[b] = swap ? fa : fb;
    stride[a] = swap ? sb : sa, stride[b] = swap ? sa : sb;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  const Number* f = values.data() + corner;
  const double f0 = f[0];
  const double f1 = f[stride[0]];
  const double f2 = f[stride[0] + stride[1]];
  const double f3 = f[stride[0] + stride[1] + stride[2]];
  return f0 + fraction[0] * (f1 - f0) + fraction[1] * (f2 - f1) + fraction[2] * (f3 - f2);
}

/// The image as a continuous function.
/// @param p  in the grid's own axes, mm; clamped to the box.
inline double interpolate(const Volume& volume, const Vec3& p) {
  return interpolate(std::span<const float>(volume.samples), volume.size, volume.spacing, p);
}

}  // namespace mesamis
