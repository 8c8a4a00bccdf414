// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesamis/surface/smooth_memberships.h"

namespace mesamis::detail::surface {

/// By how much a node's own material wins at least.
inline constexpr float kLeastLead = 0.02F;

/// Counts the eighths of voxels that each material has: a voxel for each node, half of it where the
/// whole grid ends.
/// @param grid      its nodes and number of materials count.
/// @param material  of each node.
///
/// O(nodes).
std::vector<std::int64_t> voxel_eighths(const GridMemberships& grid,
                                        std::span<const Index> material);

/// The same for the labels of a whole grid, up to the greatest that there is.
std::vector<std::int64_t> label_eighths(const LabelGrid& labels);

/// The volumes of so many eighths of voxels.
/// @return mm^3.
std::vector<double> volumes_of(std::span<const std::int64_t> eighths, const Vec3& spacing);

/// The boundary between two materials in a layer of cells.
struct InterfaceVolume {
  std::array<Index, 2> sides{};  ///< materials, the second kNoIndex at the box
  double flux = 0;               ///< what it adds to the volume of the first, mm^3
  double slope = 0;  ///< that volume's change with the difference of the constants, mm^3
};

/// The boundaries in a layer of cells, by increasing sides.
using LayerVolumes = std::vector<InterfaceVolume>;

/// Measures the boundaries in the cells above each slice but the last.
///
/// O(nodes), in threads. The same bits for any number of them, and whichever slices come together.
std::vector<LayerVolumes> measure_layers(const GridMemberships& grid);

/// Sets each membership to its base and the constant of its material; but the node's own material
/// stays ahead by kLeastLead.
/// @param base  as many as there are values.
void add_constants(std::span<const float> base, std::span<const double> constants,
                   GridMemberships& grid);

/// The constants, one for each material, with which each has the volume wanted: Newton's method.
class VolumeMatch {
 public:
  /// @param wanted  of each material, mm^3, > 0.
  VolumeMatch(std::vector<double> wanted, const SmoothOptions& options);

  /// One for each material.
  const std::vector<double>& constants() const { return constants_; }
  /// How well the volumes match; `parts` is not set.
  const SmoothReport& report() const { return report_; }
  /// Changes the constants by one step.
  /// @param layers  of the whole grid with the constants as they are, from its first slice on.
  /// @return false  if the volumes match, or after the last round: the constants stay.
  bool improve(std::span<const LayerVolumes> layers);

 private:
  std::vector<double> wanted_, constants_;
  SmoothOptions options_;
  SmoothReport report_;
};

/// Adds a constant to the memberships of each material, so that it has the volume wanted.
/// Everywhere the node's own material stays ahead by kLeastLead.
/// @param wanted  of each material, mm^3, > 0.
/// @return its rounds, volume_error and converged.
///
/// O(nodes) per round.
SmoothReport match_volumes(GridMemberships& memberships, std::vector<double> wanted,
                           const SmoothOptions& options);

}  // namespace mesamis::detail::surface
