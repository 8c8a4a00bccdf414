// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/preview.h"

#include "mesamis/surface/extract_cubes.h"

namespace mesamis::detail::method {

TriMesh preview_surface(const Pass& pass) {
  const Parameters& p = pass.run.parameters;
  const GridPass found = minimise_on_grid(pass);
  const KuhnGrid& grid = found.grid;
  return extract_cubes({grid.size, grid.spacing, found.minimum.u}, p.grey.to_grey(p.level));
}

}  // namespace mesamis::detail::method
