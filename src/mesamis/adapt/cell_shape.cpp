// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/cell_shape.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/parallel.h"
#include "mesamis/base/sym3.h"

namespace mesamis::detail::adapt {

CellShape cell_shape(const std::array<Vec3, 4>& points) {
  // M = E E^-1 with E the edges from vertex 0; the reference Gram matrix is 4/3 (I + 1 1'), its
  // inverse 3/4 (I - 1 1' / 4), so M M' = 3/4 (sum e_i e_i' - s s' / 4) with s = sum e_i.
  const Vec3 a = points[1] - points[0], b = points[2] - points[0], c = points[3] - points[0];
  CellShape shape;
  shape.stretch_squared = 0.75 * (outer(a) + outer(b) + outer(c) - 0.25 * outer(a + b + c));
  const SymEigen e = eigen_decompose(shape.stretch_squared);
  for (std::size_t i = 0; i < 3; ++i) shape.lambda[i] = std::sqrt(std::max(e.values[i], 0.0));
  // The product is the volume ratio exactly; the smallest root suffers most from round-off.
  const double volume = six_volume(points[0], points[1], points[2], points[3]) / 6;
  shape.lambda[2] = volume / (kReferenceVolume * shape.lambda[0] * shape.lambda[1]);
  shape.diameter = 0;
  for (const auto& [i, j] : kCellEdges) {
    shape.diameter = std::max(shape.diameter, norm(points[j] - points[i]));
  }
  return shape;
}

std::array<double, 3> aspect_ratios(const CellShape& shape) {
  const auto& [l1, l2, l3] = shape.lambda;
  return {std::pow(l1 * l1 / (l2 * l3), 2.0 / 3), std::pow(l2 * l2 / (l1 * l3), 2.0 / 3),
          std::pow(l3 * l3 / (l1 * l2), 2.0 / 3)};
}

std::vector<std::array<double, 3>> aspect_ratios(const TetMesh& mesh) {
  std::vector<std::array<double, 3>> ratios(mesh.cells.size());
  parallel_for(ratios.size(), [&](std::size_t c) {
    ratios[c] = aspect_ratios(cell_shape(cell_corners(mesh, mesh.cells[c])));
  });
  return ratios;
}

AspectSummary summarize_aspects(const TetMesh& mesh) {
  const std::size_t count = mesh.cells.size();
  // One summary per block, with sums instead of means.
  std::vector<AspectSummary> blocks((count + kBlock - 1) / kBlock);
  parallel_blocks(count, kBlock, [&](std::size_t begin, std::size_t end) {
    AspectSummary& block = blocks[begin / kBlock];
    for (std::size_t c = begin; c < end; ++c) {
      const auto s = aspect_ratios(cell_shape(cell_corners(mesh, mesh.cells[c])));
      for (std::size_t i = 0; i < 3; ++i) {
        block.max[i] = std::max(block.max[i], s[i]);
        block.mean[i] += s[i];
      }
    }
  });
  AspectSummary summary;
  for (const AspectSummary& block : blocks) {
    for (std::size_t i = 0; i < 3; ++i) {
      summary.max[i] = std::max(summary.max[i], block.max[i]);
      summary.mean[i] += block.mean[i] / static_cast<double>(count);
    }
  }
  return summary;
}

}  // namespace mesamis::detail::adapt
