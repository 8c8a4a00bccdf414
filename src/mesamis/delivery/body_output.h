// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesamis/body/face_sets.h"
#include "mesamis/body/make_body.h"
#include "mesamis/delivery/label_output.h"
#include "mesamis/image/volume.h"
#include "mesamis/material/materials.h"
#include "mesamis/mesh/finite_elements.h"

namespace mesamis {

/// What a body for a solver shall be.
struct BodyRequest {
  BodyOptions elements;                       ///< an element size of 0 becomes three voxels
  std::optional<MaterialOptions> material{};  ///< none: elements without materials
  std::vector<FaceQuery> sets{};              ///< in the world frame (LPS), mm; names differ
};

/// A body as it is written.
struct BodyOutput {
  FiniteElements elements;                   ///< world frame (LPS), mm; a part per object
  MeshedBody facts;                          ///< its elements are moved into the above
  double tolerance = 0;                      ///< that it was made for, mm
  std::optional<MaterialReport> material{};  ///< with materials
};

/// Fills the surfaces of objects with elements, gives them materials from the scan, and finds the
/// sets of faces.
///
/// The body is made in the axes of the scan's grid: where an object ends at the border of the scan
/// its face is flat.
/// @param objects  1 to 255, world frame (LPS), mm; closed.
/// @param volume   the scan, native units.
/// @throws InputError  as make_body(), assign_materials() and find_faces(), or if two sets have the
///                     same name.
/// @throws Cancelled   if progress says stop.
///
/// Time and memory as make_body() and assign_materials(). The same bits for any number of threads.
BodyOutput make_body_output(std::span<const FoundObject> objects, const Volume& volume,
                            const BodyRequest& request);

}  // namespace mesamis
