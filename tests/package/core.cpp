// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "mesamis/mesh/tet_mesh.h"

#if __has_include(<Eigen/Core>)
#error "Eigen is the library's own affair"
#endif

int main() {
  const mesamis::Box box{{0, 0, 0}, {1, 2, 3}};
  const mesamis::TetMesh mesh = mesamis::box_mesh(box, {2, 3, 4});
  return mesamis::find_flaw(mesh, box).empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}
