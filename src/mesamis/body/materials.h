// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesamis/body/material_bins.h"
#include "mesamis/body/material_law.h"
#include "mesamis/image/volume.h"
#include "mesamis/mesh/finite_elements.h"
#include "mesamis/mesh/tet_mesh.h"

/// Materials for a finite element model from a calibrated scan, in one call.
namespace mesamis::detail::body {

/// What was used, and how much rests on bounds. Shares are of the mesh's volume, 0 to 1.
struct MaterialReport {
  std::string law, citation, doi;  ///< doi is empty where it is not known
  DensityKind density = DensityKind::kApparent;
  Calibration calibration{};   ///< native values to that density
  double share_below_min = 0;  ///< see ElementModuli
  double share_above_max = 0;
  std::optional<double> share_outside_law{};  ///< none where the law states no range
  double share_of_modulus_min = 0;
};

/// The materials of a mesh.
struct Materials {
  std::vector<double> modulus;  ///< MPa, one per cell, before the bins
  std::vector<double> density;  ///< g/cm^3, one per cell, of the kind that the report names
  MaterialBins bins;
  MaterialReport report;
};

/// Gives each cell of a mesh a modulus, see element_moduli(), and a bin, see bin_materials().
///
/// @param mesh    m >= 1 cells of positive volume, coordinates in LPS mm, within the volume.
/// @param volume  at least 2 voxels along each axis; native units.
/// @throws InputError  if the law or the calibration is missing, and as element_moduli() and
///                     bin_materials().
///
/// O(samples), see element_moduli(). The same bits for any number of threads.
Materials assign_materials(const TetMesh& mesh, const VolumeView& volume,
                           const MaterialOptions& options);

/// The bins as materials of a finite element model, named MAT_001, MAT_002, ... from the stiffest
/// on; more digits from 1000 bins on. What a solver takes as mass is the apparent density.
/// @param options  by which the materials were assigned: how the apparent density, in g/cm^3,
///                 follows from that of the law.
/// @return one per bin; material_of_cell of FiniteElements is bins.of_cell.
std::vector<FiniteElements::Elastic> elastic_materials(const Materials& materials,
                                                       const MaterialOptions& options);

}  // namespace mesamis::detail::body
