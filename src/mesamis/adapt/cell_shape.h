// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"

/// The size, shape and orientation of a tetrahedron, and its aspect ratios.
namespace mesamis::detail::adapt {

/// Volume of the regular tetrahedron inscribed in the unit sphere, |K^| = 8 sqrt(3) / 27.
inline constexpr double kReferenceVolume = 0.5132002392796673;

/// A cell as the image of the reference tetrahedron under an affine map with the matrix M_K.
struct CellShape {
  std::array<double, 3> lambda;  ///< semi-axes of the ellipsoid, lambda_1 >= lambda_2 >= lambda_3
                                 ///< > 0, mesh unit
  Sym3 stretch_squared;          ///< M_K M_K^T = sum lambda_i^2 r_i r_i^T, mesh unit squared
  double diameter;               ///< h_K, longest edge, mesh unit
};

/// Measures the shape of one cell. Source: paper, sec. 3, the singular value decomposition of M_K.
/// @param points  the vertices of a cell of positive volume, in the unit of the mesh.
/// @return lengths in the unit of the mesh.
///
/// O(1), one eigenvalue decomposition.
CellShape cell_shape(const std::array<Vec3, 4>& points);

/// Computes the three aspect ratios (6): s_i = (lambda_i^2 / (lambda_j lambda_k))^(2/3).
/// @return s1 >= s2 >= s3 > 0 with s1 s2 s3 = 1, no unit; all 1 for a regular tetrahedron.
std::array<double, 3> aspect_ratios(const CellShape& shape);

/// Computes the aspect ratios of all cells.
/// @param mesh  m cells of positive volume.
/// @return m values of s1, s2, s3; no unit.
///
/// O(m), in parallel; the same bits for any number of threads.
std::vector<std::array<double, 3>> aspect_ratios(const TetMesh& mesh);

/// The aspect ratios of a mesh in short.
struct AspectSummary {
  std::array<double, 3> max{};   ///< largest s1, s2, s3 of any cell
  std::array<double, 3> mean{};  ///< means of s1, s2, s3 over the cells
};

/// Computes the maxima and means of aspect_ratios().
/// @param mesh  m cells of positive volume.
/// @return no unit; zeros for m = 0.
///
/// O(m), in parallel, nothing kept per cell. Sums are added in blocks of kBlock cells: the same
/// bits for any number of threads.
AspectSummary summarize_aspects(const TetMesh& mesh);

}  // namespace mesamis::detail::adapt
