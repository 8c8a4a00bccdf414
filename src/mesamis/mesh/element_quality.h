// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::mesh {

/// The measures of a tetrahedron that solvers are sensitive to.
struct ElementShape {
  double least_angle = 0;      ///< smallest dihedral angle, degrees; 70.5 of a regular one
  double greatest_angle = 0;   ///< largest dihedral angle, degrees
  double scaled_jacobian = 0;  ///< sqrt(2) * 6 V / the greatest product of three edges at a corner;
                               ///< 1 of a regular one, below 0 of one turned inside out
};

/// Measures a tetrahedron.
/// @param corners  of a cell, mm.
ElementShape element_shape(const std::array<Vec3, 4>& corners);

/// The shapes of the elements of a mesh, as reports give them.
struct ElementQuality {
  std::int64_t elements = 0;
  double least_angle = 0, greatest_angle = 0;  ///< over all elements, degrees
  double scaled_jacobian_min = 0;              ///< over all elements, no unit
  double share_above_15_deg = 0;    ///< of the elements whose least angle is above 15 degrees
  double share_jacobian_above = 0;  ///< of the elements whose scaled Jacobian is above 0.2
};

/// Measures all elements of a mesh.
/// @param mesh  m cells with indices in range, mm.
/// @return all zero for a mesh without cells.
///
/// The same bits for any number of threads.
ElementQuality element_quality(const TetMesh& mesh);

}  // namespace mesamis::detail::mesh
