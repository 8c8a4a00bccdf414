// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/surface_change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/fem/mesh_space.h"

namespace mesamis::detail::method {
namespace {

/// Of one cell: the area of its level sets, and the distance that they have moved.
struct CellChange {
  double area = 0, distance = 0;
};

/// The mean of |before - level| where the cell's edges cross {now = level}; 0 where none does.
double mean_difference(const std::array<double, 4>& before, const std::array<double, 4>& now,
                       double level) {
  double sum = 0;
  int crossings = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) {
      if ((now[a] > level) == (now[b] > level)) continue;
      const double t = (level - now[a]) / (now[b] - now[a]);
      sum += std::abs((1 - t) * before[a] + t * before[b] - level);
      ++crossings;
    }
  }
  return crossings == 0 ? 0 : sum / crossings;
}

std::array<double, 4> at_corners(const Cell& cell, std::span<const double> field) {
  std::array<double, 4> values;
  for (std::size_t i = 0; i < 4; ++i) values[i] = field[static_cast<std::size_t>(cell[i])];
  return values;
}

}  // namespace

double level_set_change(const TetMesh& mesh, std::span<const double> before,
                        std::span<const double> now, const LevelSetOptions& options) {
  std::vector<CellChange> changes(mesh.cells.size());
  parallel_for(changes.size(), [&](std::size_t c) {
    const Cell& cell = mesh.cells[c];
    const auto values = at_corners(cell, now);
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    if (*least > options.level || *greatest <= options.level) return;
    const CellGeometry geometry = cell_geometry(mesh, static_cast<Index>(c));
    const double slope = norm(cell_gradient(geometry, cell, now));
    const double difference = mean_difference(at_corners(cell, before), values, options.level);
    changes[c] = {slope * geometry.volume / (*greatest - *least),
                  std::min(difference / slope, options.most)};
  });
  double area = 0, moved = 0;
  for (const CellChange& change : changes) {
    area += change.area;
    moved += change.area * change.distance;
  }
  if (area > 0) return moved / area;
  const auto [least, greatest] = std::minmax_element(before.begin(), before.end());
  const bool was_there = !before.empty() && *least <= options.level && *greatest > options.level;
  return was_there ? options.most : 0;
}

}  // namespace mesamis::detail::method
