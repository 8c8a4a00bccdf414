// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/grid_estimator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesamis/adapt/metric_from_estimate.h"
#include "mesamis/adapt/paired_gradients.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fem/grid_mass.h"
#include "mesamis/mesh/kuhn.h"

namespace mesamis::detail::adapt {
namespace {

constexpr std::size_t kPaths = 6;

/// A cell seen from a brick: the brick's offset and which of its six paths.
struct RelativeCell {
  std::array<Index, 3> brick;
  std::size_t path;
};

/// What all cells of one Kuhn path have in common.
struct PathGeometry {
  CellShape shape;
  std::array<double, 4> face_area;
  std::array<Vec3, 4> normal;
  std::array<RelativeCell, 4> neighbor;
  std::vector<RelativeCell> patch;  // Delta_K, the cell itself included
};

RelativeCell relative_to_center(Index cell) {
  const Index brick = cell / static_cast<Index>(kPaths);
  return {{brick % 3 - 1, brick / 3 % 3 - 1, brick / 9 - 1},
          static_cast<std::size_t>(cell) % kPaths};
}

bool share_a_point(const Cell& a, const Cell& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

/// Read off a box of 3x3x3 bricks: its middle brick sees every kind of neighbour.
std::array<PathGeometry, kPaths> path_geometries(const Vec3& h) {
  const TetMesh mesh = box_mesh({{0, 0, 0}, 3.0 * h}, {3, 3, 3});
  const auto neighbors = cell_neighbors(mesh);
  std::array<PathGeometry, kPaths> result;
  for (std::size_t path = 0; path < kPaths; ++path) {
    const std::size_t c = 13 * kPaths + path;
    PathGeometry& g = result[path];
    const std::array<Vec3, 4> p = cell_corners(mesh, mesh.cells[c]);
    g.shape = cell_shape(p);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& [a, b, d] = kCellFaces[i];
      const Vec3 doubled = cross(p[b] - p[a], p[d] - p[a]);
      g.face_area[i] = norm(doubled) / 2;
      g.normal[i] = (1 / norm(doubled)) * doubled;
      g.neighbor[i] = relative_to_center(neighbors[c][i]);
    }
    for (std::size_t t = 0; t < mesh.cells.size(); ++t) {
      if (share_a_point(mesh.cells[c], mesh.cells[t])) {
        g.patch.push_back(relative_to_center(static_cast<Index>(t)));
      }
    }
  }
  return result;
}

struct Totals {
  EstimateSums sums;
  double predicted_cells = 0;
};

/// Where the cells of a run of layers are added up.
struct Accumulators {
  std::vector<PackedSym3>& metrics;
  Totals totals;
};

class GridEstimator {
 public:
  GridEstimator(const KuhnGrid& grid, const AtParameters& parameters, const GridFields& fields,
                const CellMetricOptions& metric)
      : grid_(grid),
        parameters_(parameters),
        fields_(fields),
        metric_(metric),
        bricks_{grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1},
        cell_volume_(grid.cell_volume()),
        paths_(path_geometries(grid.spacing)) {
    group_patches();
    for (std::size_t path = 0; path < kPaths; ++path) {
      for (std::size_t i = 0; i < 4; ++i) {
        neighbor_steps_[path][i] = step_to(paths_[path].neighbor[i]);
      }
    }
  }

  /// Adds |K| M_K of the layers [begin, end) to their nodes.
  Totals run_layers(Index begin, Index end, std::vector<PackedSym3>& metrics) const {
    constexpr Index kStrip = 16;  // lines of bricks whose gradients are kept at a time
    Accumulators sums{metrics, {}};
    Ring ring;
    for (Index first = 0; first < bricks_[1]; first += kStrip) {
      const Index last = std::min(first + kStrip, bricks_[1]);
      ring.first_line = std::max(first - 1, 0);
      ring.lines = std::min(last + 1, bricks_[1]) - ring.first_line;
      fill_layer(begin - 1, ring);
      fill_layer(begin, ring);
      for (Index k = begin; k < end; ++k) {
        fill_layer(k + 1, ring);
        for (Index j = first; j < last; ++j) {
          for (Index i = 0; i < bricks_[0]; ++i) add_brick({i, j, k}, ring, sums);
        }
      }
    }
    return sums.totals;
  }

 private:
  /// A strip of three consecutive layers of cells; layer k is kept at k modulo 3.
  struct Ring {
    Index first_line = 0, lines = 0;
    std::array<std::vector<PairedGradients>, 3> layers;
    std::array<std::vector<char>, 3> flat;  // bricks, see is_flat()
  };

  /// A cell near another, as a step from the other's brick in the layer below, beside or above.
  struct Step {
    std::size_t layer;
    std::ptrdiff_t step;
  };

  /// Cells that belong to the patches of the same paths, a bit for each.
  struct Group {
    unsigned paths;
    std::vector<Step> steps;
  };

  Step step_to(const RelativeCell& cell) const {
    const auto row = static_cast<std::ptrdiff_t>(bricks_[0]) * cell.brick[1] + cell.brick[0];
    return {static_cast<std::size_t>(cell.brick[2] + 1),
            row * static_cast<std::ptrdiff_t>(kPaths) + static_cast<std::ptrdiff_t>(cell.path)};
  }

  /// The six patches of a brick have most of their cells in common: these are added up once.
  void group_patches() {
    for (Index cell = 0; cell < static_cast<Index>(27 * kPaths); ++cell) {
      const RelativeCell at = relative_to_center(cell);
      unsigned paths = 0;
      for (std::size_t path = 0; path < kPaths; ++path) {
        for (const RelativeCell& other : paths_[path].patch) {
          if (other.brick == at.brick && other.path == at.path) paths |= 1U << path;
        }
      }
      if (paths == 0) continue;
      const auto same = [&](const Group& group) { return group.paths == paths; };
      auto group = std::find_if(groups_.begin(), groups_.end(), same);
      if (group == groups_.end()) group = groups_.insert(groups_.end(), {paths, {}});
      group->steps.push_back(step_to(at));
    }
  }

  static std::size_t slot(Index k) { return static_cast<std::size_t>((k + 3) % 3); }

  /// @param j  a line of bricks, from the ring's first.
  std::size_t place(Index i, Index j, std::size_t path) const {
    return (static_cast<std::size_t>(j) * static_cast<std::size_t>(bricks_[0]) +
            static_cast<std::size_t>(i)) *
               kPaths +
           path;
  }

  const PairedGradients* cells_of(const std::array<Index, 3>& brick, const Ring& ring) const {
    return ring.layers[slot(brick[2])].data() + place(brick[0], brick[1] - ring.first_line, 0);
  }

  bool is_inside(const std::array<Index, 3>& brick) const {
    return brick[0] >= 0 && brick[0] < bricks_[0] && brick[1] >= 0 && brick[1] < bricks_[1] &&
           brick[2] >= 0 && brick[2] < bricks_[2];
  }

  std::array<std::size_t, 4> nodes_of(const std::array<Index, 3>& brick, std::size_t path) const {
    const auto stride = grid_.stride();
    std::array<std::size_t, 4> n{};
    n[0] = static_cast<std::size_t>(brick[0]) + static_cast<std::size_t>(brick[1]) * stride[1] +
           static_cast<std::size_t>(brick[2]) * stride[2];
    for (std::size_t s = 0; s < 3; ++s) n[s + 1] = n[s] + stride[kKuhnPaths[path][s]];
    return n;
  }

  /// Differences along the path's three axis-parallel edges.
  Vec3 gradient(std::span<const float> z, const std::array<std::size_t, 4>& nodes,
                std::size_t path) const {
    Vec3 g;
    for (std::size_t s = 0; s < 3; ++s) {
      const int axis = kKuhnPaths[path][s];
      g[axis] = (double{z[nodes[s + 1]]} - double{z[nodes[s]]}) / grid_.spacing[axis];
    }
    return g;
  }

  void fill_layer(Index k, Ring& ring) const {
    if (k < 0 || k >= bricks_[2]) return;
    std::vector<PairedGradients>& layer = ring.layers[slot(k)];
    layer.resize(place(0, ring.lines, 0));
    std::vector<char>& flat = ring.flat[slot(k)];
    flat.resize(layer.size() / kPaths);
    for (Index line = 0; line < ring.lines; ++line) {
      for (Index i = 0; i < bricks_[0]; ++i) {
        flat[place(i, line, 0) / kPaths] = is_flat({i, ring.first_line + line, k}) ? 1 : 0;
        for (std::size_t path = 0; path < kPaths; ++path) {
          const auto nodes = nodes_of({i, ring.first_line + line, k}, path);
          layer[place(i, line, path)] = {gradient(fields_.u, nodes, path),
                                         gradient(fields_.v, nodes, path)};
        }
      }
    }
  }

  /// Whether u = f is constant on a brick, and v = 1.
  bool is_flat(const std::array<Index, 3>& brick) const {
    const std::size_t corner = nodes_of(brick, 0)[0];
    const auto stride = grid_.stride();
    const float value = fields_.u[corner];
    for (std::size_t bits = 0; bits < 8; ++bits) {
      const std::size_t n =
          corner + (bits & 1) * stride[0] + ((bits >> 1) & 1) * stride[1] + (bits >> 2) * stride[2];
      if (fields_.u[n] != value || fields_.f[n] != value || fields_.v[n] != 1) return false;
    }
    return true;
  }

  /// Whether a brick and all around it are flat: then its cells' residuals and metrics are zero.
  bool is_within_flat(const std::array<Index, 3>& brick, const Ring& ring) const {
    if (!is_surrounded(brick)) return false;
    const std::size_t own = place(brick[0], brick[1] - ring.first_line, 0) / kPaths;
    if (ring.flat[slot(brick[2])][own] == 0) return false;
    for (Index k = -1; k <= 1; ++k) {
      const char* flat = ring.flat[slot(brick[2] + k)].data() + own;
      for (Index j = -1; j <= 1; ++j) {
        const char* line = flat + static_cast<std::ptrdiff_t>(j) * bricks_[0];
        if ((line[-1] & line[0] & line[1]) == 0) return false;
      }
    }
    return true;
  }

  const PairedGradients* find(const std::array<Index, 3>& brick, const RelativeCell& cell,
                              const Ring& ring) const {
    const std::array<Index, 3> at{brick[0] + cell.brick[0], brick[1] + cell.brick[1],
                                  brick[2] + cell.brick[2]};
    if (!is_inside(at)) return nullptr;
    return cells_of(at, ring) + cell.path;
  }

  /// The cells of a brick and of those below and above it.
  using Column = std::array<const PairedGradients*, 3>;

  Column column_of(const std::array<Index, 3>& brick, const Ring& ring) const {
    const auto& [i, j, k] = brick;
    return {cells_of({i, j, k - 1}, ring), cells_of(brick, ring), cells_of({i, j, k + 1}, ring)};
  }

  CellData data_of(const std::array<Index, 3>& brick, std::size_t path, const Ring& ring) const {
    const PathGeometry& g = paths_[path];
    const PairedGradients& own = cells_of(brick, ring)[path];
    const bool surrounded = is_surrounded(brick);
    const Column column = surrounded ? column_of(brick, ring) : Column{};
    std::array<std::size_t, 4> nodes = nodes_of(brick, path);
    CellData data;
    data.volume = cell_volume_;
    data.shape = g.shape;
    data.grad_u = own.u();
    data.grad_v = own.v();
    data.grad_f = gradient(fields_.f, nodes, path);
    if (kuhn_path_is_odd(kKuhnPaths[path])) std::swap(nodes[2], nodes[3]);
    data.face_area = g.face_area;
    for (std::size_t i = 0; i < 4; ++i) {
      data.u[i] = fields_.u[nodes[i]];
      data.v[i] = fields_.v[nodes[i]];
      data.f[i] = fields_.f[nodes[i]];
      const auto& [layer, step] = neighbor_steps_[path][i];
      const PairedGradients* beyond =
          surrounded ? column[layer] + step : find(brick, g.neighbor[i], ring);
      set_jumps(i, g.normal[i], beyond, data);
    }
    return data;
  }

  bool is_surrounded(const std::array<Index, 3>& brick) const {
    for (int a = 0; a < 3; ++a) {
      if (brick[a] < 1 || brick[a] + 1 >= bricks_[a]) return false;
    }
    return true;
  }

  /// What the patches of a brick's six cells add up.
  std::array<PairedSums, kPaths> sum_patches(const std::array<Index, 3>& brick,
                                             const Ring& ring) const {
    std::array<PairedSums, kPaths> sums;
    if (!is_surrounded(brick)) {
      for (std::size_t path = 0; path < kPaths; ++path) {
        for (const RelativeCell& cell : paths_[path].patch) {
          if (const PairedGradients* found = find(brick, cell, ring)) sums[path].add(*found);
        }
      }
      return sums;
    }
    // Nearly all bricks: no bounds to check, and fixed steps through three layers.
    const Column column = column_of(brick, ring);
    for (const Group& group : groups_) {
      PairedSums sum;
      for (const auto& [layer, step] : group.steps) sum.add(column[layer][step]);
      for (std::size_t path = 0; path < kPaths; ++path) {
        if ((group.paths >> path & 1U) != 0) sums[path].add(sum);
      }
    }
    return sums;
  }

  void add_brick(const std::array<Index, 3>& brick, const Ring& ring, Accumulators& into) const {
    if (is_within_flat(brick, ring)) return;
    const std::array<PairedSums, kPaths> sums = sum_patches(brick, ring);
    for (std::size_t path = 0; path < kPaths; ++path) {
      add_cell(brick, path, ring, sums[path], into);
    }
  }

  void add_cell(const std::array<Index, 3>& brick, std::size_t path, const Ring& ring,
                const PairedSums& sums, Accumulators& into) const {
    const CellEstimate e = estimate_cell(data_of(brick, path, ring), parameters_,
                                         recovered_error(sums.of_u(cell_volume_)),
                                         recovered_error(sums.of_v(cell_volume_)));
    const Sym3 m = cell_metric(e.gamma, metric_);
    into.totals.sums.add(e);
    into.totals.predicted_cells +=
        cell_volume_ * std::sqrt(std::max(determinant(m), 0.0)) / kReferenceVolume;
    const Sym3 share = cell_volume_ * m;
    const PackedSym3 packed = pack(share);
    for (const std::size_t n : nodes_of(brick, path)) {
      for (std::size_t c = 0; c < 6; ++c) into.metrics[n][c] += packed[c];
    }
  }

  const KuhnGrid& grid_;
  const AtParameters& parameters_;
  GridFields fields_;
  CellMetricOptions metric_;
  std::array<Index, 3> bricks_;
  double cell_volume_;
  std::array<PathGeometry, kPaths> paths_;
  std::vector<Group> groups_;
  std::array<std::array<Step, 4>, kPaths> neighbor_steps_{};
};

/// Smooths the logarithms of a layer of nodes.
/// @param layers  the layer below, itself and the one above, as they were; null where there is
/// none.
void smooth_layer(const KuhnGrid& grid, const std::array<const PackedSym3*, 3>& layers,
                  PackedSym3* result) {
  const auto [nx, ny, nz] = grid.size;
  const auto [below, here, above] = layers;
  const auto width = static_cast<std::size_t>(nx);
  std::size_t n = 0;
  for (Index j = 0; j < ny; ++j) {
    for (Index i = 0; i < nx; ++i, ++n) {
      PackedSym3 sum{};
      float weights = 0;
      const auto add = [&](const PackedSym3& log, float weight) {
        for (std::size_t c = 0; c < 6; ++c) sum[c] += weight * log[c];
        weights += weight;
      };
      add(here[n], 2);
      if (i > 0) add(here[n - 1], 1);
      if (i + 1 < nx) add(here[n + 1], 1);
      if (j > 0) add(here[n - width], 1);
      if (j + 1 < ny) add(here[n + width], 1);
      if (below != nullptr) add(below[n], 1);
      if (above != nullptr) add(above[n], 1);
      for (std::size_t c = 0; c < 6; ++c) result[n][c] = sum[c] / weights;
    }
  }
}

void require_sizes(const KuhnGrid& grid, const GridFields& fields) {
  for (const auto& field : {fields.u, fields.v, fields.f}) {
    if (field.size() != grid.node_count()) {
      throw InputError("grid estimate: " + std::to_string(field.size()) + " values for " +
                       std::to_string(grid.node_count()) + " nodes");
    }
  }
}

}  // namespace

GridEstimate estimate_on_grid(const KuhnGrid& grid, const AtParameters& parameters,
                              const GridFields& fields, CellMetricOptions metric) {
  require_sizes(grid, fields);
  metric.cell_count = grid.cell_count();
  GridEstimate result;
  result.node_metrics.assign(grid.node_count(), PackedSym3{});
  const GridEstimator estimator(grid, parameters, fields, metric);
  // Slabs of one parity touch disjoint nodes: even ones run concurrently, then odd ones, so that
  // every node has one order of summation.
  constexpr Index kSlab = 8;
  const Index layers = grid.size[2] - 1;
  const Index slabs = (layers + kSlab - 1) / kSlab;
  std::vector<Totals> totals(static_cast<std::size_t>(slabs));
  for (Index parity = 0; parity < 2; ++parity) {
    const auto count = static_cast<std::size_t>((slabs + 1 - parity) / 2);
    parallel_for_each(count, [&](std::size_t s) {
      const Index slab = 2 * static_cast<Index>(s) + parity;
      totals[static_cast<std::size_t>(slab)] = estimator.run_layers(
          slab * kSlab, std::min(layers, (slab + 1) * kSlab), result.node_metrics);
    });
  }
  for (const Totals& slab : totals) {
    result.sums.add(slab.sums);
    result.predicted_cells += slab.predicted_cells;
  }
  const GridMass mass(grid);
  parallel_for(result.node_metrics.size(), [&](std::size_t n) {
    // The cells around a node have four times its lumped mass.
    const auto factor = static_cast<float>(3.0 / 8 / (4 * mass.at(n)));
    for (float& entry : result.node_metrics[n]) entry *= factor;
  });
  return result;
}

void smooth_log_metrics(const KuhnGrid& grid, std::vector<PackedSym3>& logs, int sweeps) {
  // Slabs run concurrently, each from its own copies of the layers that others change.
  constexpr Index kSlab = 16;
  const std::size_t layer = grid.stride()[2];
  const auto slabs = static_cast<std::size_t>((grid.size[2] + kSlab - 1) / kSlab);
  std::vector<std::vector<PackedSym3>> first(slabs), last(slabs);
  const auto layer_at = [&](Index k) { return logs.data() + static_cast<std::size_t>(k) * layer; };
  const auto end_of = [&](std::size_t slab) {
    return std::min(grid.size[2], (static_cast<Index>(slab) + 1) * kSlab);
  };
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    parallel_for_each(slabs, [&](std::size_t s) {
      const PackedSym3 *low = layer_at(static_cast<Index>(s) * kSlab),
                       *high = layer_at(end_of(s) - 1);
      first[s].assign(low, low + layer);
      last[s].assign(high, high + layer);
    });
    parallel_for_each(slabs, [&](std::size_t s) {
      std::vector<PackedSym3> before, here;
      if (s > 0) before = last[s - 1];
      for (Index k = static_cast<Index>(s) * kSlab; k < end_of(s); ++k) {
        PackedSym3* own = layer_at(k);
        here.assign(own, own + layer);
        const PackedSym3* after = k + 1 < end_of(s) ? layer_at(k + 1)
                                  : s + 1 < slabs   ? first[s + 1].data()
                                                    : nullptr;
        smooth_layer(grid, {before.empty() ? nullptr : before.data(), here.data(), after}, own);
        std::swap(before, here);
      }
    });
  }
}

}  // namespace mesamis::detail::adapt
