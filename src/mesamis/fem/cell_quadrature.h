// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/image/spline_image.h"

namespace mesamis::detail::fem {

/// Fits a linear function to the image on a cell.
///
/// Least squares over samples of the image's interpolant: on a lattice of 1 or 2 points per voxel and
/// direction, the coarsest that puts enough of them well spread into the cell; where none does, the
/// L2 projection by a rule of 14 points that is exact up to degree 5. A linear image is reproduced
/// exactly.
///
/// @param points  the cell's vertices in the image's own axes, mm, positively oriented.
/// @return the function's values at the four vertices, in the image's unit.
/// O(voxels in the cell).
std::array<double, 4> fit_image_on_cell(const SplineImage& image,
                                        const std::array<Vec3, 4>& points);

}  // namespace mesamis::detail::fem
