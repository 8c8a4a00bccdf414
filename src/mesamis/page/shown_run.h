// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "mesamis/page/mesh_cut.h"
#include "mesamis/page/run_page.h"
#include "mesamis/page/slice_view.h"

namespace mesamis::detail::page {

/// What of a run is drawn. It refers to what the RunPage refers to.
struct ShownRun {
  std::vector<ShownSurface> surfaces;
  std::optional<ShownMesh> mesh;
  VoxelGrid grid;                 ///< of the scan, or around mesh and surfaces
  Window window{0, 255};          ///< of the slices, native units
  std::vector<SliceView> slices;  ///< axial, coronal, sagittal; none without a scan

  bool is_empty() const { return surfaces.empty() && !mesh && slices.empty(); }
};

/// Checks what is to be shown and cuts the slices.
/// @throws InputError  as run_page(). O(voxels + triangles log(triangles)).
ShownRun shown_run(const RunPage& page);

/// The mesh cut along the axial plane that shows most of the surfaces, around them; of a ShownRun
/// with a mesh.
Raster cut_picture(const ShownRun& run, int pixels);

}  // namespace mesamis::detail::page
