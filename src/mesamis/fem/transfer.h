// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/fem/grid_space.h"
#include "mesamis/fem/mesh_space.h"
#include "mesamis/fem/solve.h"
#include "mesamis/image/volume.h"

/// Bringing fields to a mesh: the image by projection or averaging, u and v by interpolation.
namespace mesamis {

/// Q_h, the L2 projection of the image onto the P1 functions of a mesh.
///
/// The image is the piecewise linear interpolant of the voxel values. The quadrature sees every
/// voxel: a cell is sampled on a lattice of one to four points per voxel and direction, so that a
/// large cell averages all its voxels (that is where noise is removed), and a cell too small for
/// that on a fixed lattice of its own. From the samples comes the cell's own best linear fit,
/// and from it the exact load |K|/20 (1 + delta_ij): linear images are reproduced exactly.
///
/// @param image         the samples are what is projected: grey values, not native ones.
/// @param point_scale   mm per unit of the mesh's coordinates, which run along the grid's axes.
/// @return one grey value per node. At edges it over- and undershoots, as projections do.
std::vector<double> project_image(const Volume& image, const MeshSpace& space, double point_scale,
                                  const SolveOptions& options = {}, SolveReport* report = nullptr);

/// The image on a (coarser) grid over the same box: each node averages the voxels under its
/// trilinear hat, so that every voxel is seen; with the voxels' own grid it is the identity.
std::vector<double> project_image(const Volume& image, const KuhnGrid& grid);

/// Means of an image over the cells of a mesh, and over the surroundings of its nodes.
struct ImageMeans {
  std::vector<double> cells;  ///< over each cell
  std::vector<double> nodes;  ///< weighted by the node's hat function, over the cells of the mesh
};

/// The image as the scan has it on a mesh: what a material is chosen from. Integrated as
/// project_image does; the nodes' values are the L2 projection with the lumped mass, which does not
/// overshoot at edges. A cell's value is exact for linear images.
///
/// @param image  native units.
/// @param mesh   in the world frame, mm, within the image's box (values beyond are those on it);
///               every point used.
/// @return native units. The same bits for any number of threads.
ImageMeans average_image(const Volume& image, const TetMesh& mesh);

/// Values of a P1 function of `from` at other points.
/// @param fields  one vector of nodal values per field.
/// @return for each field one value per point.
std::vector<std::vector<double>> interpolate_fields(const TetMesh& from,
                                                    std::span<const std::span<const double>> fields,
                                                    std::span<const Vec3> points);

/// The same from a Kuhn grid.
std::vector<std::vector<double>> interpolate_fields(const KuhnGrid& from,
                                                    std::span<const std::span<const double>> fields,
                                                    std::span<const Vec3> points);

}  // namespace mesamis
