// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/fem/grid_space.h"
#include "mesamis/fem/mesh_space.h"
#include "mesamis/fem/solve.h"
#include "mesamis/image/spline_image.h"
#include "mesamis/image/volume.h"
#include "mesamis/mesh/locate.h"

/// Transfer of fields to a mesh: of the image by projection or averaging, of u and v by
/// interpolation.
namespace mesamis::detail::fem {

/// How the image is projected.
struct ProjectionOptions {
  double point_scale = 1;  ///< mm per unit of the mesh's coordinates
  SolveOptions solver;
};

/// The projection, and how its system was solved.
struct ProjectedImage {
  std::vector<double> values;  ///< one per node
  SolveReport solve;           ///< of the mass matrix
};

/// Computes Q_h, the L2 projection of the image onto the P1 functions of a mesh.
///
/// The image is the cubic spline through the voxel values. The quadrature uses every
/// voxel: a cell is sampled on a lattice of one or two points per voxel and direction, so that a
/// large cell averages all its voxels, which removes noise; a cell too small for that is sampled at
/// 14 points of its own. The linear fit of a cell's samples gives its exact load
/// |K|/20 (1 + delta_ij): linear images are reproduced exactly.
///
/// @param image  grey values.
/// @param space  on a mesh whose coordinates run along the grid's axes.
/// @return one grey value per node. At edges it over- and undershoots, as projections do.
///
/// O(voxels + cells) and one solve with the consistent mass matrix. The same bits for any number of
/// threads.
ProjectedImage project_image(const SplineImage& image, const MeshSpace& space,
                             const ProjectionOptions& options = {});

/// Averages the image onto a (coarser) grid over the same box: each node is the mean of the voxels
/// under its trilinear hat function, so that every voxel counts. On the voxels' own grid it is the
/// identity.
/// @param grid  n nodes, no more than voxels along each axis.
/// @return n values in the unit of the samples.
///
/// O(voxels), in parallel.
std::vector<float> project_image(const VolumeView& image, const KuhnGrid& grid);

/// Means of an image over the cells of a mesh, and over the surroundings of its nodes.
struct ImageMeans {
  std::vector<double> cells;  ///< over each cell
  std::vector<double> nodes;  ///< weighted by the node's hat function, over the cells of the mesh
};

/// Averages the image over the cells of a mesh and around its nodes: materials are chosen from
/// these values. The quadrature is that of project_image(); the nodes' values are the L2 projection
/// with the lumped mass, which does not overshoot at edges. A cell's value is exact for linear
/// images.
///
/// @param image  native units.
/// @param mesh   in the world frame, mm, within the image's box (values beyond are those on it);
///               every point belongs to a cell.
/// @return native units. The same bits for any number of threads.
ImageMeans average_image(const VolumeView& image, const TetMesh& mesh);

/// Evaluates P1 functions of a mesh at points.
/// @param from    cells of positive volume; beyond them, see locate().
/// @param fields  for each field one value per node of `from`, any unit.
/// @param points  in the mesh's own coordinates; fast where neighbours in the list are near.
/// @param extent  whether `from` fills a box.
/// @return for each field one value per point, in the unit of the field.
/// @throws InputError  as cell_neighbors(), for `from`.
///
/// O(cells), and O(points) in practice: each search walks from the cell of the point before.
std::vector<std::vector<double>> interpolate_fields(const TetMesh& from,
                                                    std::span<const std::span<const double>> fields,
                                                    std::span<const Vec3> points,
                                                    MeshExtent extent = MeshExtent::kBox);

/// Evaluates P1 functions of a Kuhn grid at points.
/// @param fields  for each field one value per node of `from`, any unit.
/// @param points  in the grid's own axes; clamped to its box.
/// @return for each field one value per point, in the unit of the field.
std::vector<std::vector<double>> interpolate_fields(const KuhnGrid& from,
                                                    std::span<const std::span<const float>> fields,
                                                    std::span<const Vec3> points);

}  // namespace mesamis::detail::fem
