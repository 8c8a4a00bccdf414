// SPDX-License-Identifier: Apache-2.0
#include <mesamis/mesamis.h>

#include <cstdlib>

#if __has_include(<vtkVersion.h>) || __has_include(<gdcmReader.h>) || __has_include(<itkImage.h>) || \
    __has_include(<Eigen/Core>)
#error "VTK, GDCM, ITK and Eigen are the library's own affair"
#endif

int main() {
  mesamis::TriMesh tetrahedron;
  tetrahedron.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  mesamis::write_surface("tetrahedron.stl", tetrahedron);
  const mesamis::TriMesh back = mesamis::read_surface("tetrahedron.stl");
  const mesamis::SurfaceCheck check = mesamis::check_surface(back);
  const bool same = mesamis::max_distance(tetrahedron, back, 1e-6) < 1e-5;
  return check.closed() && check.manifold() && same ? EXIT_SUCCESS : EXIT_FAILURE;
}
