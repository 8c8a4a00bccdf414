// SPDX-License-Identifier: Apache-2.0
// Compiled where the surfaces to compare with are left out.
#include "mesamis/base/error.h"
#include "mesamis/baseline/vtk_isosurface.h"

namespace mesamis::detail::baseline {

bool have_vtk() { return false; }

TriMesh vtk_isosurface(const Volume&, double, const IsosurfaceOptions&) {
  throw InputError("isosurface: not in this program, which was built without VTK");
}

}  // namespace mesamis::detail::baseline
