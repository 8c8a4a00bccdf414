// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/fit/surface_moves.h"
#include "mesamis/method/printable.h"
#include "mesamis/slabs/surface_piece.h"
#include "mesamis/slabs/tasks.h"
#include "mesamis/surface/select_parts.h"

/// The tasks that find the surface in the last mesh, after finish(): the mesh and the surface
/// before decimation need not be in one memory.
///
/// Each step is done in two: slabs on their own, away from their borders; then what is near each
/// border between two slabs. Whoever moves or removes points leaves the rim of its piece as it is,
/// so that the pieces fit. What two tasks change at one time lies on two sides of a plane, so that
/// it cannot come to meet.
///
/// In their order: extract_slab(); follow_slab(), follow_border(); list_parts(), cross_rays();
/// decimate_slab(), decimate_border(); measure_slab(), find_grey(). Between them learn_...() reads
/// what all slabs have left.
namespace mesamis::detail::slabs {

/// The heights between which something lies, length units.
struct HeightRange {
  double low = 0, high = 0;  ///< low > high: there is nothing
};

/// What is known of the parts of the whole surface.
struct SurfaceParts {
  std::vector<SurfaceComponents::Size> sizes;  ///< the largest absolute volume first
  std::vector<Vec3> feet;                      ///< a point of each, world frame, mm
  std::vector<std::vector<Index>> of_slab;     ///< [slab][component of its surface]
  std::vector<HeightRange> core, border;       ///< of the slabs' surfaces, and of those between
  double mean_error = 0;                       ///< expected of the surface's shape, mm
  double shift = 0;                            ///< of any point, rounded to single precision, mm
};

/// What the tasks on the surface know.
struct SurfaceRun {
  const MeshRun& mesh;
  int last;              ///< the number of the last mesh
  bool follows = false;  ///< whether the surface is to follow the image: after learn_follows()
  SurfaceParts parts{};  ///< after learn_parts()
  PartChoice choice{};   ///< after learn_choice()
  /// The tolerance of decimation is set by the caller, after learn_parts().
  Parameters parameters;

  SurfaceRun(const MeshRun& of, int mesh_number)
      : mesh(of), last(mesh_number), parameters(of.input.parameters) {}
  Index count() const { return mesh.count(); }
};

/// Extracts the surface in the cells of slab s.
SlabWork extract_slab(const SurfaceRun& run, Index s);
void learn_follows(SurfaceRun& run);
/// Moves the points of slab s towards the image, but for those near its borders.
SlabWork follow_slab(const SurfaceRun& run, Index s);
/// Moves those near the border between the slabs s and s + 1.
SlabWork follow_border(const SurfaceRun& run, Index s);
/// Finds the components of the surface of slab s.
SlabWork list_parts(const SurfaceRun& run, Index s);
void learn_parts(SurfaceRun& run);
/// Counts what the rays of all components cross in slab s.
SlabWork cross_rays(const SurfaceRun& run, Index s);
void learn_choice(SurfaceRun& run, const PartSelection& selection);
/// Decimates what stays of slab s, but for what is near its borders.
SlabWork decimate_slab(const SurfaceRun& run, Index s);
/// Decimates what is near the border between the slabs s and s + 1.
SlabWork decimate_border(const SurfaceRun& run, Index s);
/// Measures how far the surface of slab s is from what it was before decimation.
SlabWork measure_slab(const SurfaceRun& run, Index s);

/// Finds the grey values below the points that slab s delivers, see surface_grey().
SlabWork find_grey(const SurfaceRun& run, Index s);
/// Those of the whole surface, after find_grey().
/// @param surface  decimated_surface(), of which some points may be missing or moved.
std::vector<double> grey_of(const SurfaceRun& run, const TriMesh& surface);

/// Whether the slabs decimate the surface: not to a number of triangles, which needs all of it at
/// once, and not where single precision is coarser than the tolerance.
bool decimates_in_slabs(const SurfaceRun& run);

/// The surface before decimation, all of its parts; world frame, mm. In a left-handed grid its
/// triangles face inward.
TriMesh followed_surface(const SurfaceRun& run);
/// The surface of the parts that stay, decimated; world frame, mm, in single precision. In a
/// left-handed grid its triangles face inward.
TriMesh decimated_surface(const SurfaceRun& run);
/// What was done to it.
PrintableReport printable_report(const SurfaceRun& run);

}  // namespace mesamis::detail::slabs
