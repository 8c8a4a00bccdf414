// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::slabs {

/// Overlaps in the thinnest slab: those of both borders, and as much between them.
inline constexpr Index kOverlapsInSlab = 4;

/// How a scan is cut into slabs: blocks of slices, one of which a task works on.
struct SlabPlan {
  VoxelGrid whole;          ///< of the scan
  double unit_mm = 1;       ///< the length unit of the meshes, mm
  double overlap = 0;       ///< how far a slab looks over its borders, length units
  std::vector<Index> cuts;  ///< slab s owns the slices cuts[s] to cuts[s + 1] - 1

  /// The number of slabs.
  Index count() const noexcept { return static_cast<Index>(cuts.size()) - 1; }
  /// The box of the voxel centres, length units, in the grid's own axes.
  Box box() const noexcept { return {{0, 0, 0}, (1 / unit_mm) * whole.box().extent()}; }
  /// The height of a slice.
  /// @return in units of unit_mm.
  double height_of_slice(Index k) const noexcept { return k * whole.spacing.z / unit_mm; }
  /// The slice at or below a height; the first or the last for one outside.
  /// @param height  in units of unit_mm.
  std::size_t slice_at(double height) const noexcept;
  /// The height where slab s begins; that of count() is where the last one ends.
  /// @return in units of unit_mm.
  double height(Index s) const noexcept {
    return s == 0         ? 0
           : s == count() ? box().hi.z
                          : height_of_slice(cuts[static_cast<std::size_t>(s)]);
  }
  /// How many slices are at least so thick.
  /// @param length  in units of unit_mm.
  Index slices_in(double length) const noexcept;
  /// @return in units of unit_mm.
  double thickness(Index s) const noexcept { return height(s + 1) - height(s); }
  /// The thickness of the thinnest slab.
  /// @return in units of unit_mm.
  double thinnest() const noexcept;
  /// How thick slabs are at least, but for a slice at the end of the scan.
  /// @return in units of unit_mm.
  double least_thickness() const noexcept { return kOverlapsInSlab * overlap; }
};

/// How many parts of at most so many voxels a scan has, at least 1.
Index parts_of(const VoxelGrid& whole, std::size_t voxels) noexcept;

/// What a plan depends on beside the scan's grid.
struct SlabOptions {
  double unit_mm = 1;
  double beta = 2;  ///< of the functional: its root is the length that influences reach
  /// Default: as many as are twice as thick as they must be, so that borders add a fourth to the
  /// work; thinner ones where these have more than 2^28 voxels; one of a scan that is too thin.
  std::optional<Index> slabs{};
  bool bounded = true;  ///< no slab has more than twice the mean number of slices
  /// Length units. The work so near to a cut is done again, by the slab below.
  double again = 0;
};

/// Cuts a scan so that all slabs have about the same work.
/// @param work  of each slice, any unit, >= 0.
/// @throws InputError  if the slabs asked for are thinner than four overlaps.
SlabPlan plan_slabs(const VoxelGrid& whole, std::span<const double> work,
                    const SlabOptions& options);

}  // namespace mesamis::detail::slabs
