// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/body/body_options.h"
#include "mesamis/body/material_law.h"

namespace mesamis {

/// The requested body. Members without a value follow from the scan and the run.
struct BodyWishes {
  /// Sizes, gradation, walls, mid-side nodes; tolerance and limit of elements are ignored.
  BodyOptions elements;
  std::optional<double> tolerance{};  ///< of the skin, mm, > 0; none: see complete_request()
  std::optional<MaterialOptions> material{};  ///< none: elements without materials
  std::optional<double> rim{};  ///< of the objects, mm, >= 0; none: as deep as the scan is blurred
  std::vector<FaceQuery> sets{};  ///< in the world frame (LPS), mm
};

/// Permitted ranges: growth of sizes (no unit), Poisson's ratio (no unit), elements through a wall.
inline constexpr std::array<double, 2> kGradations{0.05, 5}, kPoissonRatios{-0.99, 0.499};
inline constexpr std::array<int, 2> kWallElements{0, 10};

/// Describes the error of a least size above the element size, without the name of the setting;
/// empty if the sizes agree or one of them is open.
/// @param options  sizes in mm.
std::string wrong_least_size(const BodyOptions& options);

/// Checks numbers: sizes, depths and gaps are finite, in mm and MPa, >= 0 (sizes of 0 are left
/// open), the tolerance is above 0, gradation, elements through a wall and Poisson's ratio lie in
/// their ranges above, and the least size is not above the element size.
/// @throws InputError  naming the number, what was expected and found.
void require_valid(const BodyWishes& wishes);

}  // namespace mesamis
