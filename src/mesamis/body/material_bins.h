// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/body/material_law.h"
#include "mesamis/rooms.h"

/// Elements of nearly equal stiffness share a material: solvers take a limited number of them.
namespace mesamis::detail::body {

/// How elements are sorted into bins.
struct MaterialBinOptions {
  double gap = 50;  ///< MPa, >= 0; 0: elements of the same modulus share a bin
  BinModulus modulus = BinModulus::kHighest;
  double poisson = 0.3;  ///< of every bin, no unit, above -1 and below 0.5
};

/// The material of one bin.
struct MaterialBin {
  double modulus = 0;                        ///< MPa, see BinModulus
  double poisson = 0;                        ///< no unit
  double density = 0;                        ///< g/cm^3, mean of its elements, each counted once
  double modulus_low = 0, modulus_high = 0;  ///< MPa: the range of its elements
  Index cells = 0;                           ///< at least 1
};

/// Elements sorted into bins, the stiffest bin first.
struct MaterialBins {
  std::vector<MaterialBin> bins;
  std::vector<Index> of_cell;  ///< per cell its bin, in [0, number of bins)
};

/// Sorts elements into bins by Bonemat's gap rule: by falling modulus, a bin opens at the greatest
/// modulus that is left and takes every element whose modulus is at most `gap` below. So the
/// modulus of no element differs from that of its bin by more than the gap.
/// Source: Taddei, Pancanti, Viceconti, An improved method for the automatic mapping of computed
/// tomography numbers onto finite element models, Med Eng Phys 26, 2004.
///
/// @param modulus  m >= 1 values in MPa, finite, > 0.
/// @param density  m values in g/cm^3, finite.
/// @throws InputError  if the sizes differ, there is no element, a value or an option is out of its
///                     range.
///
/// O(m log m). Ties are broken by index.
MaterialBins bin_materials(std::span<const double> modulus, std::span<const double> density,
                           const MaterialBinOptions& options);

}  // namespace mesamis::detail::body
