// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/image/volume.h"
#include "mesamis/mesh/metric.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/method/choose.h"
#include "mesamis/method/iteration.h"
#include "mesamis/method/measured_image.h"
#include "mesamis/method/parameters.h"
#include "mesamis/method/printable.h"
#include "mesamis/surface/tri_mesh.h"

/// The whole method: a scan in, a surface and an adapted mesh out.
namespace mesamis::detail::method {

/// What a run delivers. Points are in the world frame (LPS), in mm.
struct Result {
  Parameters parameters;  ///< what the run used, the level of the surface included
  MeasuredImage image;

  TetMesh mesh;                 ///< empty for a preview, as are its fields
  std::vector<double> u, v, f;  ///< nodal: grey values (u, f) and edge indicator
  /// Nodal: what the level of each place exceeds that of the parameters, grey values; empty where
  /// there is one level.
  std::vector<double> level_excess;
  std::vector<Sym3> metric;  ///< that the mesh was made for, at the nodes, 1/mm^2
  MeshFit fit;               ///< how well the mesh fits it
  TriMesh surface;
  /// How far the points of a solid are expected to lie from the truth, mm, see expected_error();
  /// empty for a band.
  std::vector<double> expected_error;
  PrintableReport printable;  ///< which parts of the surface were dropped, how it was decimated

  std::vector<Iteration> iterations;  ///< the last one is the final minimisation
  bool converged = false;             ///< the loop has settled, every solve converged
  struct Seconds {
    double prepare = 0, surface = 0, printable = 0, total = 0;
  } seconds;
  bool stopped = false;  ///< the caller had enough before the loop had settled
};

/// Algorithm 2 (MES AMIS). Minimises on the voxel grid, then on adapted meshes, until the loop has
/// settled (Settings::until); extracts the surface.
///
/// Deviations from the paper: the voxel grid is never stored as cells; the first adapted mesh is
/// refined from a coarse box; after the last adaptation the functional is minimised once more, so
/// that u and v belong to the mesh they are delivered with. docs/method.md lists all of them.
///
/// @param volume    native units; read in place, nothing is kept of it.
/// @param settings  valid, see require_valid(); those of a Settings, where no level is known.
/// @param progress  optional; stages "preparation", "adaptation k of n", "final minimisation",
///                  "surface", "decimation"; of a preview "preview", "surface", "rounding".
/// @param enough    optional; asked before each pass. Stopped before the first one, a run for a
///                  solid delivers its preview, without a mesh; a band needs one adaptation.
///                  Stopped later, it minimises on the last mesh that it has made, and extracts the
///                  surface from it.
/// @return the same bits for any number of threads (see with_threads()); of a run that was stopped,
///         bits that depend on the pass at which it was.
/// @throws InputError  if the volume or a setting cannot be used.
/// @throws Cancelled   if progress says stop.
///
/// Time grows with the number of voxels and with the number of cells times the adaptations; memory
/// is about memory_needed().
Result mes_amis(const VolumeView& volume, const ImageSettings& settings,
                const Progress& progress = {}, const HasEnough& enough = {});

/// Finds grey values for the points of the result's surface: of a band u itself; of a solid, where
/// u is the level everywhere, the maximum within two voxels below it.
/// @param result  of mes_amis().
/// @param voxel   mm, >= 0, see VoxelGrid::voxel_size().
/// @return one grey value per point of the surface: values of u, 0 to 255 but for the overshoot of
///         the projection at edges.
/// @throws InputError  as max_below_surface().
std::vector<double> surface_grey(const Result& result, double voxel);

}  // namespace mesamis::detail::method
