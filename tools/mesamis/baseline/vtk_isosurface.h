// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/baseline/isosurface.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::baseline {

/// Whether VTK was there when the program was built.
bool have_vtk();

/// isosurface() by VTK's filters.
/// @param options  that are valid.
/// @throws InputError  as isosurface(), or if there is no VTK.
TriMesh vtk_isosurface(const Volume& volume, double level, const IsosurfaceOptions& options);

}  // namespace mesamis::detail::baseline
