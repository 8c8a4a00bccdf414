// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/image/volume.h"
#include "mesamis/mesh/metric.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/printable.h"
#include "mesamis/segment/amis.h"
#include "mesamis/settings.h"
#include "mesamis/surface/tri_mesh.h"

/// The whole method: a scan walks in, a surface and an adapted mesh walk out.
namespace mesamis {

/// One pass of Algorithm 2: minimise on a mesh, estimate, adapt.
struct Iteration {
  std::int64_t tets = 0, nodes = 0;  ///< of the mesh minimised on
  Energy energy;                     ///< after the minimisation
  double energy_change = 0;          ///< Ei: relative, against the pass before; 0 in the first
  double mesh_change = 0;            ///< Em: relative change of the cell count by adapting
  AmisReport amis;
  double estimator = 0;                               ///< zeta, the sum over the cells
  double predicted_tets = 0;                          ///< (11) for tau, before max_tets acts
  std::array<double, 3> aspect_max{}, aspect_mean{};  ///< s1, s2, s3 of (6)
  struct Seconds {
    double project = 0, amis = 0, estimate = 0, remesh = 0, transfer = 0;
  } seconds;
};

struct Result {
  Settings settings;   ///< with every default filled in
  double unit_mm = 1;  ///< the length unit
  GreyMap grey;        ///< native units to grey values, with T
  bool threshold_used = false;
  struct Image {
    double noise_left = 0;  ///< standard deviation after deblurring, native units
    double impulses = 0;    ///< share of the voxels that were replaced
  } restored;
  double level_native = 0;  ///< where the solid surface was taken

  TetMesh mesh;                 ///< world frame LPS, mm
  std::vector<double> u, v, f;  ///< nodal, grey values (u, f) and edge indicator
  std::vector<Sym3> metric;     ///< the last one asked for, at the nodes, world frame
  MeshFit fit;                  ///< how well the mesh fits it
  TriMesh surface;              ///< world frame LPS, mm
  PrintableReport printable;    ///< which parts of the surface went, how it was decimated

  std::vector<Iteration> iterations;  ///< the last one is the final minimisation
  bool converged = false;             ///< mesh and energy settled, every solve converged
  struct Seconds {
    double prepare = 0, surface = 0, printable = 0, total = 0;
  } seconds;
};

/// Algorithm 2 (MES AMIS). Minimises on the voxel grid, then on adapted meshes, until both the
/// number of cells and the energy settle; extracts the surface.
///
/// Deviations from the paper: the voxel grid is never stored as cells; the first adapted mesh is
/// refined from a coarse box; after the last adaptation the functional is minimised once more, so
/// that u and v belong to the mesh they are delivered with.
///
/// @param volume    native values.
/// @param progress  optional; stages "preparation", "adaptation k of n", "final minimisation",
///                  "surface", "decimation".
/// @return the same bits for any number of threads.
/// @throws InputError  if the volume or a setting cannot be used.
/// @throws Cancelled   if progress says stop.
Result mes_amis(const Volume& volume, const Settings& settings, const Progress& progress = {});

/// Grey values at the points of the result's surface: of a band u itself; of a solid, where u is
/// the level everywhere, the greatest one met within two voxels beneath (greatest_beneath()).
/// @param voxel  mm, see Volume::voxel_size().
std::vector<double> surface_grey(const Result& result, double voxel);

}  // namespace mesamis
