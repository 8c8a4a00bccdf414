// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/grid_space.h"

#include <algorithm>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/kuhn.h"

namespace mesamis::detail::fem {
namespace {

/// Calls body(i, j, k, n) for every node, the layers k concurrently.
template <class Body>
void for_each_node(const KuhnGrid& grid, Body&& body) {
  parallel_for_each(static_cast<std::size_t>(grid.size[2]), [&](std::size_t layer) {
    const auto k = static_cast<Index>(layer);
    std::size_t n = layer * grid.stride()[2];
    for (Index j = 0; j < grid.size[1]; ++j) {
      for (Index i = 0; i < grid.size[0]; ++i, ++n) body(i, j, k, n);
    }
  });
}

/// diag(d) + K as a 7-point stencil.
class StencilOperator : public SpdOperator {
 public:
  StencilOperator(const KuhnGrid& grid, std::array<std::vector<double>, 3> conductance,
                  std::vector<double> diagonal)
      : grid_(grid), conductance_(std::move(conductance)), diagonal_(std::move(diagonal)) {
    const auto stride = grid_.stride();
    for_each_node(grid_, [&](Index i, Index j, Index k, std::size_t n) {
      const std::array<Index, 3> at{i, j, k};
      for (int a = 0; a < 3; ++a) {
        diagonal_[n] += conductance_[a][n];
        if (at[a] > 0) diagonal_[n] += conductance_[a][n - stride[a]];
      }
    });
  }

  std::size_t size() const override { return diagonal_.size(); }
  const std::vector<double>& diagonal() const override { return diagonal_; }

  void apply(std::span<const double> x, std::span<double> y) const override {
    const auto stride = grid_.stride();
    for_each_node(grid_, [&](Index i, Index j, Index k, std::size_t n) {
      double sum = diagonal_[n] * x[n];
      if (i > 0) sum -= conductance_[0][n - 1] * x[n - 1];
      if (i + 1 < grid_.size[0]) sum -= conductance_[0][n] * x[n + 1];
      if (j > 0) sum -= conductance_[1][n - stride[1]] * x[n - stride[1]];
      if (j + 1 < grid_.size[1]) sum -= conductance_[1][n] * x[n + stride[1]];
      if (k > 0) sum -= conductance_[2][n - stride[2]] * x[n - stride[2]];
      if (k + 1 < grid_.size[2]) sum -= conductance_[2][n] * x[n + stride[2]];
      y[n] = sum;
    });
  }

  std::vector<double> absolute_row_sums() const override {
    std::vector<double> sums(diagonal_);
    const auto stride = grid_.stride();
    for_each_node(grid_, [&](Index i, Index j, Index k, std::size_t n) {
      const std::array<Index, 3> at{i, j, k};
      for (int a = 0; a < 3; ++a) {
        sums[n] += conductance_[a][n];
        if (at[a] > 0) sums[n] += conductance_[a][n - stride[a]];
      }
    });
    return sums;
  }

  std::vector<Index> aggregates() const override {
    std::vector<Index> group(size());
    const Index nx = (grid_.size[0] + 1) / 2, ny = (grid_.size[1] + 1) / 2;
    for_each_node(grid_, [&](Index i, Index j, Index k, std::size_t n) {
      group[n] = ((k / 2) * ny + j / 2) * nx + i / 2;
    });
    return group;
  }

  SparseMatrix coarsen(std::span<const Index> aggregate, Index count) const override {
    std::vector<Triplet> triplets;
    std::vector<double> own(static_cast<std::size_t>(count), 0);
    const auto stride = grid_.stride();
    for (std::size_t n = 0; n < size(); ++n) own[aggregate[n]] += diagonal_[n];
    for (int a = 0; a < 3; ++a) {
      for (std::size_t n = 0; n + stride[a] < size(); ++n) {
        const Index row = aggregate[n], column = aggregate[n + stride[a]];
        const double value = -conductance_[a][n];
        if (value == 0) continue;  // also where n is the last of its line
        if (row == column) {
          own[row] += 2 * value;
        } else {
          triplets.push_back({row, column, value});
          triplets.push_back({column, row, value});
        }
      }
    }
    for (Index g = 0; g < count; ++g) triplets.push_back({g, g, own[g]});
    return from_triplets(count, std::move(triplets));
  }

 private:
  KuhnGrid grid_;
  std::array<std::vector<double>, 3> conductance_;  // of the edge from n to its next node
  std::vector<double> diagonal_;
};

/// Sum over the (up to six) cells around the edge n -> n + stride[a] of scale * mean(w) + offset.
///
/// In the brick that has the edge at local offset (db, dc) across it, the cells with the edge
/// are the Kuhn paths that walk the axes with offset 1 before a and the others after it.
class EdgeCoefficient {
 public:
  EdgeCoefficient(const KuhnGrid& grid, std::span<const double> w, double scale, double offset)
      : grid_(grid), w_(w), scale_(scale), offset_(offset) {}

  double at(int a, const std::array<Index, 3>& at, std::size_t n) const {
    const auto stride = grid_.stride();
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    const std::size_t sa = stride[a], sb = stride[b], sc = stride[c];
    const bool b_up = at[b] + 1 < grid_.size[b], b_down = at[b] > 0;
    const bool c_up = at[c] + 1 < grid_.size[c], c_down = at[c] > 0;
    const int cells =
        2 * (b_up && c_up) + 2 * (b_down && c_down) + (b_down && c_up) + (b_up && c_down);
    if (w_.empty()) return offset_ * cells;
    double sum = cells * (w_[n] + w_[n + sa]);
    if (b_up && c_up) sum += w_[n + sa + sb] + w_[n + sa + sc] + 2 * w_[n + sa + sb + sc];
    if (b_down && c_down) sum += w_[n - sb] + w_[n - sc] + 2 * w_[n - sb - sc];
    if (b_down && c_up) sum += w_[n - sb] + w_[n + sa + sc];
    if (b_up && c_down) sum += w_[n - sc] + w_[n + sa + sb];
    return scale_ * sum / 4 + offset_ * cells;
  }

 private:
  const KuhnGrid& grid_;
  std::span<const double> w_;
  double scale_, offset_;
};

/// Adds value(brick corner) to the eight corners of every brick of one layer.
template <class AddBrick>
void add_bricks_of_layer(const KuhnGrid& grid, Index k, AddBrick&& add) {
  const auto stride = grid.stride();
  for (Index j = 0; j + 1 < grid.size[1]; ++j) {
    for (Index i = 0; i + 1 < grid.size[0]; ++i) {
      add(static_cast<std::size_t>(k) * stride[2] + static_cast<std::size_t>(j) * stride[1] +
          static_cast<std::size_t>(i));
    }
  }
}

/// Calls add(brick's lowest node) for every brick. Layers of one parity touch disjoint nodes:
/// even ones run concurrently, then odd ones, so that sums have one order.
template <class AddBrick>
void for_each_brick(const KuhnGrid& grid, AddBrick&& add) {
  for (Index parity = 0; parity < 2; ++parity) {
    const Index layers = (grid.size[2] - parity) / 2;
    parallel_for_each(static_cast<std::size_t>(layers), [&](std::size_t layer) {
      add_bricks_of_layer(grid, 2 * static_cast<Index>(layer) + parity, add);
    });
  }
}

}  // namespace

GridSpace::GridSpace(const KuhnGrid& grid) : grid_(grid) {
  if (*std::min_element(grid.size.begin(), grid.size.end()) < 2) {
    throw InputError("grid: at least 2 nodes per direction are needed, found " +
                     std::to_string(grid.size[0]) + " x " + std::to_string(grid.size[1]) + " x " +
                     std::to_string(grid.size[2]));
  }
  lumped_mass_.assign(grid.node_count(), 0);
  const auto stride = grid.stride();
  const double quarter = grid.cell_volume() / 4;
  for_each_brick(grid_, [&](std::size_t corner) {
    // The two ends of the main diagonal belong to six cells, every other corner to two.
    for (std::size_t bits = 0; bits < 8; ++bits) {
      const std::size_t node =
          corner + (bits & 1) * stride[0] + ((bits >> 1) & 1) * stride[1] + (bits >> 2) * stride[2];
      lumped_mass_[node] += quarter * (bits == 0 || bits == 7 ? 6 : 2);
    }
  });
}

std::unique_ptr<SpdOperator> GridSpace::diffusion(std::span<const double> w, double scale,
                                                  double offset,
                                                  std::vector<double> diagonal) const {
  std::array<std::vector<double>, 3> conductance;
  const EdgeCoefficient coefficient(grid_, w, scale, offset);
  for (int a = 0; a < 3; ++a) {
    conductance[a].assign(node_count(), 0);
    const double h = grid_.spacing[a];
    const double weight = grid_.cell_volume() / (h * h);
    for_each_node(grid_, [&](Index i, Index j, Index k, std::size_t n) {
      const std::array<Index, 3> at{i, j, k};
      if (at[a] + 1 < grid_.size[a]) conductance[a][n] = weight * coefficient.at(a, at, n);
    });
  }
  return std::make_unique<StencilOperator>(grid_, std::move(conductance), std::move(diagonal));
}

std::vector<double> GridSpace::gradient_squares(std::span<const double> u) const {
  std::vector<double> squares(node_count(), 0);
  const auto stride = grid_.stride();
  const double quarter = grid_.cell_volume() / 4;
  const std::array<double, 3> per_length{1 / (grid_.spacing.x * grid_.spacing.x),
                                         1 / (grid_.spacing.y * grid_.spacing.y),
                                         1 / (grid_.spacing.z * grid_.spacing.z)};
  for_each_brick(grid_, [&](std::size_t corner) {
    for (const auto& path : kKuhnPaths) {
      std::array<std::size_t, 4> node{corner};
      double square = 0;
      for (std::size_t s = 0; s < 3; ++s) {
        const int axis = path[s];
        node[s + 1] = node[s] + stride[axis];
        const double du = u[node[s + 1]] - u[node[s]];
        square += du * du * per_length[axis];
      }
      for (const std::size_t n : node) squares[n] += quarter * square;
    }
  });
  return squares;
}

}  // namespace mesamis::detail::fem
