// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/label_parts.h"

#include <utility>

#include "mesamis/surface/disjoint_sets.h"
#include "mesamis/surface/grid_field.h"

namespace mesamis::detail::surface {

LabelParts find_label_parts(const LabelGrid& grid) {
  const auto [nx, ny, nz] = grid.size;
  DisjointSets sets(grid.labels.size());
  std::size_t n = 0;
  for (Index k = 0; k < nz; ++k) {
    for (Index j = 0; j < ny; ++j) {
      for (Index i = 0; i < nx; ++i, ++n) {
        for (const auto& [di, dj, dk] : kKuhnSteps) {
          if (i < di || j < dj || k < dk) continue;
          const std::size_t below = n - static_cast<std::size_t>(di + nx * (dj + ny * dk));
          if (grid.labels[below] == grid.labels[n]) sets.unite(below, n);
        }
      }
    }
  }
  DisjointSets::Numbers numbers = sets.numbers();
  LabelParts parts{std::move(numbers.of_item), {}};
  parts.label.resize(static_cast<std::size_t>(numbers.count));
  for (n = 0; n < grid.labels.size(); ++n) parts.label[parts.of_node[n]] = grid.labels[n];
  return parts;
}

}  // namespace mesamis::detail::surface
