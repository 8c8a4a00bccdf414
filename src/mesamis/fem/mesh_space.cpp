// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/mesh_space.h"

#include <algorithm>

#include "mesamis/base/each_once.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::fem {
namespace {

/// Neighbouring nodes and the node itself, increasing.
void build_graph(const TetMesh& mesh, const PointCells& around,
                 std::vector<std::int64_t>& row_start, std::vector<Index>& columns) {
  const std::size_t n = mesh.points.size();
  std::vector<std::vector<Index>> rows(n);
  parallel_for(n, [&](std::size_t i) {
    std::vector<Index>& row = rows[i];
    for (const Index c : around.of(static_cast<Index>(i))) {
      row.insert(row.end(), mesh.cells[c].begin(), mesh.cells[c].end());
    }
    sort_once(row);
    row.shrink_to_fit();
  });
  row_start.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    row_start[i + 1] = row_start[i] + static_cast<std::int64_t>(rows[i].size());
  }
  columns.reserve(static_cast<std::size_t>(row_start[n]));
  for (const auto& row : rows) columns.insert(columns.end(), row.begin(), row.end());
}

/// The edges at each corner, in the order of their other ends.
constexpr std::array<std::array<std::size_t, 3>, 4> kEdgesAtCorner{
    {{0, 1, 2}, {0, 3, 4}, {1, 3, 5}, {2, 4, 5}}};

}  // namespace

CellGeometry cell_geometry(const TetMesh& mesh, Index cell) {
  const Cell& k = mesh.cells[static_cast<std::size_t>(cell)];
  const Vec3& p = mesh.points[k[0]];
  const Vec3 a = mesh.points[k[1]] - p, b = mesh.points[k[2]] - p, c = mesh.points[k[3]] - p;
  const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double det = dot(a, bc);
  CellGeometry g;
  g.volume = det / 6;
  g.gradients[1] = (1 / det) * bc;
  g.gradients[2] = (1 / det) * ca;
  g.gradients[3] = (1 / det) * ab;
  g.gradients[0] = -(g.gradients[1] + g.gradients[2] + g.gradients[3]);
  return g;
}

Vec3 cell_gradient(const CellGeometry& geometry, const Cell& cell, std::span<const double> u) {
  // Differences to the first node: a constant has exactly no gradient.
  Vec3 gradient;
  for (int i = 1; i < 4; ++i) gradient += (u[cell[i]] - u[cell[0]]) * geometry.gradients[i];
  return gradient;
}

MeshSpace::MeshSpace(const TetMesh& mesh) : mesh_(mesh), point_cells_(point_cells(mesh)) {
  build_graph(mesh, point_cells_, row_start_, columns_);
  volumes_.resize(mesh.cells.size());
  edge_weights_.resize(mesh.cells.size());
  parallel_for(mesh.cells.size(), [this](std::size_t c) {
    const CellGeometry g = cell_geometry(mesh_, static_cast<Index>(c));
    volumes_[c] = g.volume;
    for (std::size_t e = 0; e < 6; ++e) {
      const auto& [i, j] = kCellEdges[e];
      edge_weights_[c][e] = g.volume * dot(g.gradients[i], g.gradients[j]);
    }
  });
  find_corners();
  lumped_mass_.assign(mesh.points.size(), 0);
  parallel_for(mesh.points.size(), [this](std::size_t i) {
    for (const Index c : point_cells_.of(static_cast<Index>(i))) {
      lumped_mass_[i] += volumes_[c] / 4;
    }
  });
}

void MeshSpace::find_corners() {
  corners_.resize(point_cells_.cells.size());
  parallel_for(mesh_.points.size(), [this](std::size_t i) {
    const auto row = static_cast<Index>(i);
    const Index* begin = columns_.data() + row_start_[i];
    const Index* end = columns_.data() + row_start_[i + 1];
    Corner* corner = corners_.data() + point_cells_.start[i];
    for (const Index c : point_cells_.of(row)) {
      std::size_t others = 0;
      for (int k = 0; k < 4; ++k) {
        const Index other = mesh_.cells[c][k];
        if (other == row) {
          corner->local = k;
        } else {
          corner->places[others++] =
              static_cast<Index>(std::lower_bound(begin, end, other) - begin);
        }
      }
      ++corner;
    }
  });
}

template <class EdgeValue>
SparseMatrix MeshSpace::assemble(EdgeValue&& edge_value, std::vector<double> diagonal,
                                 bool zero_row_sums) const {
  SparseMatrix matrix{row_start_, columns_, std::vector<double>(columns_.size(), 0)};
  parallel_for(diagonal.size(), [&](std::size_t i) {
    const auto row = static_cast<Index>(i);
    const Index* begin = columns_.data() + row_start_[i];
    const Index* end = columns_.data() + row_start_[i + 1];
    double* values = matrix.values.data() + row_start_[i];
    const Corner* corner = corners_.data() + point_cells_.start[i];
    double own = diagonal[i];
    for (const Index c : point_cells_.of(row)) {
      const auto& edges = kEdgesAtCorner[static_cast<std::size_t>(corner->local)];
      for (std::size_t k = 0; k < 3; ++k) {
        const double value = edge_value(c, edges[k]);
        values[corner->places[k]] += value;
        if (zero_row_sums) own -= value;
      }
      ++corner;
    }
    values[std::lower_bound(begin, end, row) - begin] = own;
  });
  return matrix;
}

std::unique_ptr<SpdOperator> MeshSpace::diffusion(std::span<const double> w, double scale,
                                                  double offset,
                                                  std::vector<double> diagonal) const {
  std::vector<double> coefficient(mesh_.cells.size(), offset);
  if (!w.empty()) {
    parallel_for(mesh_.cells.size(), [&](std::size_t c) {
      const Cell& k = mesh_.cells[c];
      coefficient[c] += scale * (w[k[0]] + w[k[1]] + w[k[2]] + w[k[3]]) / 4;
    });
  }
  return std::make_unique<MatrixOperator>(
      assemble([&](Index c, std::size_t e) { return coefficient[c] * edge_weights_[c][e]; },
               std::move(diagonal), true));
}

std::vector<double> MeshSpace::gradient_squares(std::span<const double> u) const {
  // |K| |grad u|^2 = -sum over edges of weight (u_i - u_j)^2, for rows of K sum to zero.
  std::vector<double> energy(mesh_.cells.size());
  parallel_for(mesh_.cells.size(), [&](std::size_t c) {
    const Cell& k = mesh_.cells[c];
    double sum = 0;
    for (std::size_t e = 0; e < 6; ++e) {
      const double du = u[k[kCellEdges[e][0]]] - u[k[kCellEdges[e][1]]];
      sum -= edge_weights_[c][e] * du * du;
    }
    energy[c] = sum;
  });
  std::vector<double> squares(mesh_.points.size(), 0);
  parallel_for(squares.size(), [&](std::size_t i) {
    for (const Index c : point_cells_.of(static_cast<Index>(i))) squares[i] += energy[c] / 4;
  });
  return squares;
}

MatrixOperator MeshSpace::consistent_mass() const {
  std::vector<double> diagonal(lumped_mass_);
  for (double& value : diagonal) value *= 2.0 / 5;  // |K|/10 = 2/5 of |K|/4
  return MatrixOperator(
      assemble([&](Index c, std::size_t) { return volumes_[c] / 20; }, std::move(diagonal), false));
}

}  // namespace mesamis::detail::fem
