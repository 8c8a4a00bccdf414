// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/label_files/polygon_area.h"
#include "mesamis/label_files/structure_set.h"

/// Where the contours of a structure set lie: parallel planes, and the grid that they ask for.
namespace mesamis::detail::label_files {

/// A contour in its plane.
struct PlaneContour {
  double slice = 0;                ///< the plane, along k in voxels of the grid
  std::vector<PlanePoint> points;  ///< along i and j in voxels of the grid
  bool exclusive = false;          ///< see Contour
};

/// A grid whose planes k are those of the contours, and the contours on it.
struct ContourGrid {
  VoxelGrid grid;
  std::vector<std::vector<PlaneContour>> contours;  ///< of each region, by ascending slice
  /// Whether the planes are slices of the scan and all contours lie within it.
  bool on_scan = false;
  std::vector<std::string> warnings;
};

/// Finds the planes, and places the contours on a grid.
///
/// The planes are those across the axis of the scan that most of the area lies across, with its
/// pixels and no wider than the scan; without a scan, or where it lies askew, those of the
/// contours, with pixels as long as their edges. The distance of the planes is the least distance
/// of two contours that lie in different ones. There is one more plane at both ends.
/// @param scan  none: not known.
/// @throws InputError  if no contour lies within the scan, or the grid has more than 8192 voxels
///                     per byte of the file.
///
/// O(points + contours), up to a logarithm.
ContourGrid place_contours(const std::filesystem::path& file, const StructureSet& set,
                           const std::optional<VoxelGrid>& scan);

}  // namespace mesamis::detail::label_files
