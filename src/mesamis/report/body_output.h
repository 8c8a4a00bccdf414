// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/body/face_sets.h"
#include "mesamis/body/make_body.h"
#include "mesamis/body/materials.h"
#include "mesamis/image/volume.h"
#include "mesamis/mesh/finite_elements.h"
#include "mesamis/report/label_output.h"

namespace mesamis::detail::report {

/// What a body for a solver shall be.
struct BodyRequest {
  BodyOptions elements;                       ///< an element size of 0 becomes three voxels
  std::optional<MaterialOptions> material{};  ///< none: elements without materials
  Vec3 rim{};  ///< of the objects in the scan, mm, see with_full_rim(); zero: not filled
  std::vector<FaceQuery> sets{};  ///< in the world frame (LPS), mm; names differ
};

/// A body as it is written.
struct BodyOutput {
  FiniteElements elements;                   ///< world frame (LPS), mm; a part per object
  MeshedBody facts;                          ///< its elements are moved into the above
  double tolerance = 0;                      ///< that it was made for, mm
  std::optional<MaterialReport> material{};  ///< with materials
  Vec3 rim{};                                ///< that was filled before, mm; zero: none
  std::vector<std::string> empty_sets{};     ///< asked for, but no face belongs to them
};

/// What of the promises of a body was missed, on one line: shapes of elements, distances, volume,
/// objects without an element, sets without a face. Empty: nothing.
std::string unmet(const BodyOutput& body);

/// Checks the names of sets, of which solvers do not tell upper case from lower, before any work.
/// @throws InputError  if two differ in case at most, or one is ALL or could be that of a part or a
///                     material: PART_ or MAT_ and a number.
///
/// O(n log n) for n sets.
void require_set_names(std::span<const FaceQuery> sets);

/// Fills the surfaces of objects with elements, gives them materials from the scan, and finds the
/// sets of faces.
///
/// The body is made in the axes of the scan's grid: where an object ends at the border of the scan
/// its face is flat.
/// @param objects  1 to 255, world frame (LPS), mm; closed.
/// @param volume   the scan, native units.
/// @throws InputError  as make_body(), assign_materials() and find_faces() and
///                     require_set_names().
/// @throws Cancelled   if progress says stop.
///
/// Time and memory as make_body() and assign_materials(). The same bits for any number of threads.
BodyOutput make_body_output(std::span<const FoundObject> objects, const VolumeView& volume,
                            const BodyRequest& request);

/// The same of objects that are filled already.
/// @param filled  by fill_objects() with request.elements, for the grid of the volume.
/// @throws InputError  as assign_materials(), find_faces() and require_set_names().
///
/// O(elements) without materials and sets, else as assign_materials() and find_faces().
BodyOutput make_body_output(MeshedBody&& filled, std::span<const FoundObject> objects,
                            const VolumeView& volume, const BodyRequest& request);

}  // namespace mesamis::detail::report
