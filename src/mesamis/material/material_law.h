// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/material/density.h"

/// Young's modulus of bone as a function of its density: the laws of the literature.
namespace mesamis {

/// One range of densities of a law: E = offset + coefficient * rho^exponent.
struct LawPiece {
  double up_to;        ///< g/cm^3; the piece holds up to this density, included
  double coefficient;  ///< MPa per (g/cm^3)^exponent
  double exponent;     ///< no unit
  double offset = 0;   ///< MPa
};

/// A law with what is needed to use it well. docs/materials.md says what of it was checked.
struct MaterialLaw {
  std::string name;
  DensityKind density = DensityKind::kApparent;  ///< that the law takes
  std::vector<LawPiece> pieces;                  ///< at least one, in increasing order of up_to
  /// g/cm^3: the densities of the specimens; none where we do not know them.
  std::optional<std::array<double, 2>> valid{};
  double poisson = 0.3;    ///< no unit; the usual choice beside the law, not part of it
  std::string citation{};  ///< authors, title, journal, year
  std::string doi{};       ///< empty where we are not sure of it
};

/// The modulus at a density, MPa.
/// @param density  g/cm^3, of the kind that the law takes; below 0 it counts as 0.
double modulus_at(const MaterialLaw& law, double density) noexcept;

/// The laws that have a name. O(1): the table is made once.
const std::vector<MaterialLaw>& material_laws();

/// Finds the law of a name.
/// @throws InputError  naming the names there are.
MaterialLaw find_material_law(std::string_view name);

/// Reads a law: a name of material_laws(), or a power law "E=c*rho^p" or "E=c*rho^p+d" of the
/// user's own, whose density is rho or rho_app (apparent), rho_ash or rho_qct.
/// @param text  c and d in MPa for densities in g/cm^3; c > 0, p > 0, d >= 0; no blanks.
/// @return a law of the user's own has the text as its name, and no citation.
/// @throws InputError  naming the names there are and the form of a power law.
MaterialLaw parse_material_law(std::string_view text);

}  // namespace mesamis
