// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/method/label_surfaces.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::report {

/// An object whose surface was found.
struct FoundObject {
  const TriMesh& surface;  ///< world frame (LPS), mm; closed
  Segment segment;         ///< the label and layer of its voxels
};

/// The objects of a run on labels, which must live as long.
std::vector<FoundObject> found_objects(const LabelResult& result);

/// One warning per object that was asked for and of which nothing was found. O(objects squared).
/// @param wanted  objects that were asked for.
/// @throws InputError  if no object was found at all.
std::vector<std::string> missing_objects(const LabelResult& result,
                                         std::span<const Segment> wanted);

/// A warning of a map whose voxels mostly have other labels than their neighbours, as in noise: its
/// surfaces take long and show nothing. None of few voxels.
///
/// O(voxels * layers).
std::vector<std::string> noise_warnings(const LabelMap& map);

/// One warning per object whose surface holds less than 0.6 times what the voxels of its label
/// hold, or that much more: as where the label lies partly beyond the scan, the image contradicts
/// it, or thin parts were joined. Labels of less than 27 voxels are left out.
/// @param map  whose segments the objects are.
///
/// O(voxels * layers + triangles).
std::vector<std::string> changed_volumes(const LabelResult& result, const LabelMap& map);

/// Marks the voxels whose centres lie inside of closed surfaces.
///
/// Along each line of voxels the surface is crossed inward and outward; a centre is inside where
/// the crossings before it do not cancel out. Where objects overlap, the later one has the voxel.
/// A centre on a face along a plane of centres, as the border of a scan or of a crop cuts them, is
/// inside of the first such object, unless it is inside of another one; on it means within a
/// thousandth of a voxel and the rounding of single precision.
/// @param grid     of the scan.
/// @param objects  segments with different labels, or layers.
/// @return as many layers as the segments need.
///
/// O(voxels * layers + triangles + crossings of the lines, up to a logarithm). Memory: the labels,
/// and 24 bytes per crossing. The same labels for any number of threads.
LabelMap label_map_of(const VoxelGrid& grid, std::span<const FoundObject> objects);

/// Closed surfaces as labels, and what is to be said of it.
struct SurfaceLabels {
  LabelMap map;
  std::vector<std::string> warnings;  ///< one line each: objects that overlap, or have no voxel
};

/// Marks the voxels inside of surfaces as label_map_of() does, but keeps each object whole: it lies
/// in the first layer where it overlaps no other. Objects that touch do not overlap.
/// @param grid     of the scan; directions of any kind.
/// @param objects  segments with different labels; their layers are not used.
/// @return the map, with a segment per object.
/// @throws InputError  if no voxel centre of the grid lies inside of any object.
///
/// As label_map_of(), and a copy of the labels of one layer.
SurfaceLabels labels_of_surfaces(const VoxelGrid& grid, std::span<const FoundObject> objects);

}  // namespace mesamis::detail::report
