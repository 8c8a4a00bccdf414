// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/label_flow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/base/types.h"
#include "mesamis/labels/label_confidence.h"

namespace mesamis::detail::labels {
namespace {

using Place = std::array<Index, 3>;

constexpr float kLeastMembership = 1e-4F;  // what is less decides nothing
constexpr Index kKnown = -1;               // no unknown: certain, or beyond reach
/// The six neighbours in the order of their nodes: along -k, -j, -i, then +i, +j, +k.
constexpr std::array<std::pair<std::size_t, Index>, 6> kSides{
    {{2, -1}, {1, -1}, {0, -1}, {0, 1}, {1, 1}, {2, 1}}};

}  // namespace

/// Part of the grid: a label's extent and what is within reach.
struct LabelFlow::Window {
  Place lo{}, size{};

  std::size_t count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  /// Calls visit(axis, neighbour) for those of the six that lie in the window, in their order.
  template <class Visit>
  void for_each_beside(std::size_t n, Visit&& visit) const {
    const Place at = grid_place(size, n);
    const std::array<std::ptrdiff_t, 3> stride{1, size[0],
                                               static_cast<std::ptrdiff_t>(size[0]) * size[1]};
    for (const auto& [axis, sign] : kSides) {
      const Index to = at[axis] + sign;
      if (to < 0 || to >= size[axis]) continue;
      visit(axis, static_cast<std::size_t>(static_cast<std::ptrdiff_t>(n) + sign * stride[axis]));
    }
  }
};

/// Of one label, at the nodes where its membership is open.
struct LabelFlow::System {
  std::vector<std::size_t> nodes;  // of the grid, increasing
  SparseMatrix matrix;
  std::vector<double> right;
};

float smooth_membership(const GridMemberships& smooth, std::size_t node, std::uint16_t label) {
  const auto begin = static_cast<std::size_t>(smooth.first[node]);
  const auto end = static_cast<std::size_t>(smooth.first[node + 1]);
  const auto is_label = [&](Index material) {
    return smooth.label[static_cast<std::size_t>(material)] == label;
  };
  if (begin == end) return is_label(smooth.material[node]) ? 1.0F : 0.0F;
  float sum = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (is_label(smooth.listed[i])) sum += smooth.value[i];
  }
  return std::clamp(sum, 0.0F, 1.0F);
}

LabelFlow::LabelFlow(const LabelGrid& grid, const FlowFields& fields, const FlowOptions& options)
    : grid_(grid), fields_(fields), options_(options) {
  const Vec3 h = (1 / options.unit_mm) * grid.spacing;
  mass_ = h.x * h.y * h.z;
  for (int a = 0; a < 3; ++a) {
    per_length_[static_cast<std::size_t>(a)] = options.beta * mass_ / (h[a] * h[a]);
    const double steps = std::ceil(options.reach / grid.spacing[a]);
    most_steps_ = std::max(most_steps_, static_cast<int>(steps));
  }
}

LabelMembership LabelFlow::solve(std::uint16_t label, const LabelExtent& extent) const {
  System system = collect(label, extent);
  std::vector<double> p(system.nodes.size(), 0);
  const MatrixOperator matrix(std::move(system.matrix));
  LabelMembership found;
  found.solved = mesamis::solve(matrix, system.right, p, {.tolerance = options_.tolerance});
  for (std::size_t n = 0; n < p.size(); ++n) {
    const auto value = static_cast<float>(std::clamp(p[n], 0.0, 1.0));
    if (value < kLeastMembership) continue;
    found.nodes.push_back(system.nodes[n]);
    found.value.push_back(value);
  }
  return found;
}

bool LabelFlow::is_open(std::size_t node) const { return fields_.weight[node] < kCertain; }

LabelFlow::Window LabelFlow::window_around(const LabelExtent& extent) const {
  Window w;
  for (std::size_t a = 0; a < 3; ++a) {
    w.lo[a] = std::max(0, extent.lo[a] - most_steps_);
    w.size[a] = std::min(grid_.size[a] - 1, extent.hi[a] + most_steps_) - w.lo[a] + 1;
  }
  return w;
}

std::size_t LabelFlow::node_of(const Window& w, std::size_t place) const {
  const Place in = grid_place(w.size, place);
  const auto at = [&](std::size_t a) {
    const Index along = w.lo[a] + in[a];
    return static_cast<std::size_t>(along);
  };
  return at(0) + static_cast<std::size_t>(grid_.size[0]) *
                     (at(1) + static_cast<std::size_t>(grid_.size[1]) * at(2));
}

/// The open nodes that can be reached from the label in most_steps_ steps: one each; else 0.
std::vector<std::uint8_t> LabelFlow::reached(std::uint16_t label, const Window& w) const {
  std::vector<std::uint8_t> mark(w.count(), 0);
  std::vector<std::size_t> front;
  for (std::size_t n = 0; n < mark.size(); ++n) {
    const std::size_t node = node_of(w, n);
    if (grid_.labels[node] != label) continue;
    mark[n] = is_open(node) ? 1 : 0;
    front.push_back(n);
  }
  for (int step = 0; step < most_steps_ && !front.empty(); ++step) {
    std::vector<std::size_t> next;
    for (const std::size_t n : front) {
      w.for_each_beside(n, [&](std::size_t, std::size_t m) {
        if (mark[m] != 0 || !is_open(node_of(w, m))) return;
        mark[m] = 1;
        next.push_back(m);
      });
    }
    front = std::move(next);
  }
  return mark;
}

LabelFlow::System LabelFlow::collect(std::uint16_t label, const LabelExtent& extent) const {
  const Window w = window_around(extent);
  const std::vector<std::uint8_t> mark = reached(label, w);
  System system;
  std::vector<Index> unknown(mark.size(), kKnown);
  for (std::size_t n = 0; n < mark.size(); ++n) {
    if (mark[n] == 0) continue;
    unknown[n] = static_cast<Index>(system.nodes.size());
    system.nodes.push_back(node_of(w, n));
  }
  system.matrix.row_start.push_back(0);
  for (std::size_t n = 0; n < mark.size(); ++n) {
    if (mark[n] != 0) add_row(label, w, n, unknown, system);
  }
  return system;
}

/// One node's row: neighbours that are certain are on the right, with what they say of the label.
void LabelFlow::add_row(std::uint16_t label, const Window& w, std::size_t place,
                        const std::vector<Index>& unknown, System& system) const {
  const std::size_t node = node_of(w, place);
  const double sure = mass_ * fields_.weight[node];
  double diagonal = sure, right = sure * smooth_membership(fields_.smooth, node, label);
  std::vector<Index>& columns = system.matrix.columns;
  std::vector<double>& values = system.matrix.values;
  std::size_t at_diagonal = columns.size();
  w.for_each_beside(place, [&](std::size_t axis, std::size_t m) {
    const std::size_t other = node_of(w, m);
    const double v = fields_.edges[node], v_other = fields_.edges[other];
    const double c = per_length_[axis] * (options_.eta + (v * v + v_other * v_other) / 2);
    diagonal += c;
    if (unknown[m] == kKnown) {
      if (!is_open(other)) right += c * smooth_membership(fields_.smooth, other, label);
      return;
    }
    if (m < place) ++at_diagonal;
    columns.push_back(unknown[m]);
    values.push_back(-c);
  });
  const auto before = static_cast<std::ptrdiff_t>(at_diagonal);
  columns.insert(columns.begin() + before, unknown[place]);
  values.insert(values.begin() + before, diagonal);
  system.matrix.row_start.push_back(std::ssize(columns));
  system.right.push_back(right);
}

}  // namespace mesamis::detail::labels
