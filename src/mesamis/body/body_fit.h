// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "mesamis/remesh/body.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::body {

/// How a body lies in the surfaces that it was made from.
struct BodyFit {
  /// The greatest distance of a point of an object's skin from its surface, and the other way
  /// round, mm; infinite where an object has no element.
  double skin_to_surface = 0, surface_to_skin = 0;
  double volume_ratio = 1;                 ///< of the elements to what the surfaces hold
  std::int64_t elements_of_skin_only = 0;  ///< with all four corners on the boundary of the body
};

/// Compares a body with its surfaces.
/// @param body       m elements.
/// @param surfaces   closed; object k of the body was made from surface k - 1; mm.
/// @param tolerance  mm, > 0: distances are found to a hundredth of it.
/// @throws InputError  as cell_neighbors() and max_distance().
///
/// O(m log d), see cell_neighbors(), and twice max_distance() per object. The same bits for any
/// number of threads.
BodyFit measure_fit(const BodyMesh& body, std::span<const TriMesh> surfaces, double tolerance);

}  // namespace mesamis::detail::body
