// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "mesamis/chunk_files/chunked_scan.h"
#include "mesamis/shape_files/surface_files.h"

#if __has_include(<vtkVersion.h>) || __has_include(<gdcmReader.h>) || __has_include(<itkImage.h>)
#error "VTK, GDCM and ITK are the library's own affair"
#endif

int main() {
  mesamis::TriMesh tetrahedron;
  tetrahedron.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  mesamis::write_surface("tetrahedron.stl", tetrahedron);
  const mesamis::TriMesh back = mesamis::read_surface("tetrahedron.stl");
  if (mesamis::is_zarr("tetrahedron.stl") || mesamis::is_hdf5("tetrahedron.stl"))
    return EXIT_FAILURE;
  return back.points.size() == 4 && back.triangles.size() == 4 ? EXIT_SUCCESS : EXIT_FAILURE;
}
