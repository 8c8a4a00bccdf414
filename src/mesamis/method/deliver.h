// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/method/loop.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/method/passes.h"
#include "mesamis/surface/extract.h"

/// From what a run has found to what it delivers.
namespace mesamis::detail::method {

/// How a solid is extracted from a run's mesh: what is fitted to the image needs no more triangles
/// than tell a sixteenth of a voxel.
SolidOptions solid_options(const RunInput& run);

/// Takes a solid in length units over into a result: it follows the image where that is
/// more exact than the mesh; then it lies in the world frame, where a left-handed grid turns every
/// triangle round. Adds the time.
void deliver_surface(const RunInput& run, TriMesh extracted, Result& result);

/// Extracts the surface of what the loop leaves, and delivers it and the mesh, see deliver_mesh().
/// @param progress  stage "surface".
/// @throws Cancelled  if progress says stop.
void deliver_loop(const RunInput& run, Loop loop, const Progress& progress, Result& result);

/// Turns every triangle of a surface round if the grid is left-handed: in the world it faces
/// inward.
void turn_as_grid(const RunInput& run, TriMesh& surface);

/// Makes a solid printable, and tells its error; the paper's band is delivered as it is.
/// @param result  with a surface; the tolerance is chosen where it is open.
/// @throws Cancelled  if progress says stop.
void finish_surface(const RunInput& run, const Progress& progress, Result& result);

/// Tells the error of a result's surface, which has been made printable.
void tell_error(const RunInput& run, Result& result);

}  // namespace mesamis::detail::method
