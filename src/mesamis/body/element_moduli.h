// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "mesamis/body/material_law.h"
#include "mesamis/image/volume.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"

/// The stiffness of each element of a mesh from the voxels inside.
namespace mesamis::detail::body {

/// How a density is found at a point and a modulus in an element.
struct ElementModuliOptions {
  MaterialLaw law{};
  Calibration calibration{};  ///< to the kind of density that the law takes, see calibration_to()
  double density_min = 0;     ///< g/cm^3; densities below count as this
  double density_max = std::numeric_limits<double>::infinity();  ///< g/cm^3; those above as this
  double modulus_min = 0.01;      ///< MPa, > 0; elements below get this: a solver needs stiffness
  double parts_per_voxel = 0.75;  ///< along the longest edge of an element, > 0
};

/// The stiffness of each element, and how much of it rests on bounds. Shares are of the volume of
/// the mesh, 0 to 1.
struct ElementModuli {
  std::vector<double> modulus;      ///< MPa, one per cell: the mean of E over the cell
  std::vector<double> density;      ///< g/cm^3, one per cell: the mean, bounded at each point
  double share_below_min = 0;       ///< where density_min replaced the density
  double share_above_max = 0;       ///< where density_max did
  double share_outside_law = 0;     ///< where the bounded density is not in law.valid
  double share_of_modulus_min = 0;  ///< of the cells whose modulus was raised to modulus_min
};

/// Averages the modulus over each cell: E of the density at each point, not E of the mean density.
/// Source: Taddei et al., The material mapping strategy influences the accuracy of CT-based finite
/// element models of bones, Med Eng Phys 29, 2007; there the rule has the name Bonemat V3.
///
/// Each cell is cut into n^3 parts of equal volume with four samples each, by which polynomials of
/// degree two are integrated exactly; n is the length of the longest edge in voxels times
/// parts_per_voxel, 2 to 64. The image is interpolated linearly along each axis (trilinear), and is
/// constant beyond the outermost voxel centres.
///
/// @param mesh    m cells of positive volume, coordinates in LPS mm, at most a voxel outside the
///                volume.
/// @param volume  at least 2 voxels along each axis; native units.
/// @throws InputError  if the volume has too few voxels or samples, a cell names a missing point, a
///                     point lies outside the volume, a modulus is not finite, or an option is out
///                     of its range.
///
/// O(samples): at least 32 per cell, 10 per voxel or more in larger ones. In threads; the same bits
/// for any number of them. 40 bytes per cell and 24 per point beside the result.
ElementModuli element_moduli(const TetMesh& mesh, const VolumeView& volume,
                             const ElementModuliOptions& options);

}  // namespace mesamis::detail::body
