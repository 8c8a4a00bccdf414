// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/body/make_body.h"
#include "mesamis/image/volume.h"
#include "mesamis/report/label_output.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::report {

/// Objects of a scan filled with elements.
struct FilledObjects {
  MeshedBody body;             ///< in the axes of the scan's grid, mm; its skins are moved out
  std::vector<TriMesh> skins;  ///< of each object, world frame (LPS), mm, turned outward; empty
                               ///< unless BodyOptions::skins
};

/// The element size that is aimed at: the one asked for, or three voxels.
/// @return mm.
double element_size(const BodyOptions& options, const VoxelGrid& grid);

/// Fills objects with elements in the axes of a scan's grid: where an object ends at the border of
/// the scan its face is flat.
/// @param objects  1 to 255, world frame (LPS), mm; closed.
/// @param grid     of the scan.
/// @param options  see element_size().
/// @throws InputError  as make_body(), or if a skin is asked for and no element is left of an
///                     object.
/// @throws Cancelled   if progress says stop.
///
/// Time and memory as make_body(). The same bits for any number of threads.
FilledObjects fill_objects(std::span<const FoundObject> objects, const VoxelGrid& grid,
                           const BodyOptions& options);

}  // namespace mesamis::detail::report
