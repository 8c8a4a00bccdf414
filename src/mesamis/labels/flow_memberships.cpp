// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/flow_memberships.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/labels/label_confidence.h"

namespace mesamis {
namespace {

using Place = std::array<Index, 3>;

constexpr float kLeastMembership = 1e-4F;  // what is less decides nothing
constexpr int kMostIterations = 500;
constexpr Index kKnown = -1;  // no unknown: certain, or beyond reach

/// The system of one label, at the nodes where its membership is open.
struct Unknowns {
  std::vector<std::size_t> nodes;               // of the grid, increasing
  std::vector<std::array<Index, 6>> neighbors;  // unknowns, or kKnown
  std::vector<std::array<double, 6>> conductance;
  std::vector<double> diagonal, right;
};

/// Of one label: the nodes that are open to it and its membership there.
struct Membership {
  std::vector<std::size_t> nodes;
  std::vector<float> value;
};

/// The nodes of a label's own.
struct Extent {
  Place lo, hi;  // both within
};

/// What the labels alone say of a node: 0 to 1.
float membership_of(const GridMemberships& labels, std::size_t node, std::uint16_t label) {
  const auto begin = static_cast<std::size_t>(labels.first[node]);
  const auto end = static_cast<std::size_t>(labels.first[node + 1]);
  const auto is_label = [&](Index material) {
    return labels.label[static_cast<std::size_t>(material)] == label;
  };
  if (begin == end) return is_label(labels.material[node]) ? 1.0F : 0.0F;
  float sum = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (is_label(labels.listed[i])) sum += labels.value[i];
  }
  return std::clamp(sum, 0.0F, 1.0F);
}

class LabelFlow {
 public:
  LabelFlow(const LabelGrid& grid, const FlowFields& fields, const FlowOptions& options)
      : grid_(grid),
        smooth_(fields.smooth),
        weight_(fields.weight),
        edges_(fields.edges),
        options_(options) {
    const Vec3 h = (1 / options.unit_mm) * grid.spacing;
    mass_ = h.x * h.y * h.z;
    for (std::size_t a = 0; a < 3; ++a) {
      const double along = h[static_cast<int>(a)];
      per_length_[a] = options.beta * mass_ / (along * along);
      most_steps_ =
          std::max(most_steps_,
                   static_cast<int>(std::ceil(options.reach / grid.spacing[static_cast<int>(a)])));
    }
    stride_ = {1, grid.size[0], static_cast<std::ptrdiff_t>(grid.size[0]) * grid.size[1]};
  }

  Membership solve(std::uint16_t label, const Extent& extent) const {
    Unknowns system = collect(label, extent);
    const std::vector<double> p = minimise(system);
    Membership found;
    for (std::size_t n = 0; n < p.size(); ++n) {
      const auto value = static_cast<float>(std::clamp(p[n], 0.0, 1.0));
      if (value < kLeastMembership) continue;
      found.nodes.push_back(system.nodes[n]);
      found.value.push_back(value);
    }
    return found;
  }

 private:
  bool is_open(std::size_t node) const { return weight_[node] < kCertain; }

  /// Part of the grid: a label's extent and what is within reach.
  struct Window {
    Place lo, size;
    std::size_t count() const {
      return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
             static_cast<std::size_t>(size[2]);
    }
    Place place(std::size_t n) const {
      const auto nx = static_cast<std::size_t>(size[0]), ny = static_cast<std::size_t>(size[1]);
      return {static_cast<Index>(n % nx), static_cast<Index>(n / nx % ny),
              static_cast<Index>(n / nx / ny)};
    }
    std::array<std::ptrdiff_t, 3> stride() const {
      return {1, size[0], static_cast<std::ptrdiff_t>(size[0]) * size[1]};
    }
  };

  Window window_around(const Extent& extent) const {
    Window w;
    for (std::size_t a = 0; a < 3; ++a) {
      w.lo[a] = std::max(0, extent.lo[a] - most_steps_);
      w.size[a] = std::min(grid_.size[a] - 1, extent.hi[a] + most_steps_) - w.lo[a] + 1;
    }
    return w;
  }

  std::size_t node_of(const Window& w, const Place& in) const {
    return static_cast<std::size_t>((w.lo[0] + in[0]) * stride_[0] +
                                    (w.lo[1] + in[1]) * stride_[1] +
                                    (w.lo[2] + in[2]) * stride_[2]);
  }

  /// Calls visit(direction, neighbour in the window) for those of the six that lie in it.
  template <class Visit>
  static void for_each_beside(const Window& w, std::size_t n, Visit&& visit) {
    const Place at = w.place(n);
    const auto stride = w.stride();
    for (std::size_t d = 0; d < 6; ++d) {
      const std::size_t a = d / 2;
      const Index to = at[a] + (d % 2 == 0 ? -1 : 1);
      if (to < 0 || to >= w.size[a]) continue;
      const std::ptrdiff_t step = d % 2 == 0 ? -stride[a] : stride[a];
      visit(d, static_cast<std::size_t>(static_cast<std::ptrdiff_t>(n) + step));
    }
  }

  /// The open nodes that can be reached from the label in most_steps_ steps: one each; else 0.
  std::vector<std::uint8_t> reached(std::uint16_t label, const Window& w) const {
    std::vector<std::uint8_t> mark(w.count(), 0);
    std::vector<std::size_t> front;
    for (std::size_t n = 0; n < mark.size(); ++n) {
      const std::size_t node = node_of(w, w.place(n));
      if (grid_.labels[node] != label) continue;
      mark[n] = is_open(node) ? 1 : 0;
      front.push_back(n);
    }
    for (int step = 0; step < most_steps_ && !front.empty(); ++step) {
      std::vector<std::size_t> next;
      for (const std::size_t n : front) {
        for_each_beside(w, n, [&](std::size_t, std::size_t m) {
          if (mark[m] != 0 || !is_open(node_of(w, w.place(m)))) return;
          mark[m] = 1;
          next.push_back(m);
        });
      }
      front = std::move(next);
    }
    return mark;
  }

  Unknowns collect(std::uint16_t label, const Extent& extent) const {
    const Window w = window_around(extent);
    const std::vector<std::uint8_t> mark = reached(label, w);
    Unknowns system;
    std::vector<Index> unknown(mark.size(), kKnown);
    for (std::size_t n = 0; n < mark.size(); ++n) {
      if (mark[n] == 0) continue;
      unknown[n] = static_cast<Index>(system.nodes.size());
      system.nodes.push_back(node_of(w, w.place(n)));
    }
    for (std::size_t n = 0; n < mark.size(); ++n) {
      if (mark[n] != 0) add_row(label, w, n, unknown, system);
    }
    return system;
  }

  /// One node's row: neighbours that are certain of the label are on the right.
  void add_row(std::uint16_t label, const Window& w, std::size_t n,
               const std::vector<Index>& unknown, Unknowns& system) const {
    const std::size_t node = node_of(w, w.place(n));
    const double sure = mass_ * weight_[node];
    double diagonal = sure, right = sure * membership_of(smooth_, node, label);
    std::array<Index, 6> neighbors;
    neighbors.fill(kKnown);
    std::array<double, 6> conductance{};
    for_each_beside(w, n, [&](std::size_t d, std::size_t m) {
      const std::size_t other = node_of(w, w.place(m));
      const double v = edges_[node], v_other = edges_[other];
      const double c = per_length_[d / 2] * (options_.eta + (v * v + v_other * v_other) / 2);
      diagonal += c;
      neighbors[d] = unknown[m];
      conductance[d] = unknown[m] >= 0 ? c : 0;
      if (unknown[m] < 0 && !is_open(other)) right += c * membership_of(smooth_, other, label);
    });
    system.neighbors.push_back(neighbors);
    system.conductance.push_back(conductance);
    system.diagonal.push_back(diagonal);
    system.right.push_back(right);
  }

  static void multiply(const Unknowns& a, const std::vector<double>& x, std::vector<double>& y) {
    for (std::size_t n = 0; n < x.size(); ++n) {
      double sum = a.diagonal[n] * x[n];
      for (std::size_t d = 0; d < 6; ++d) {
        if (a.neighbors[n][d] >= 0) sum -= a.conductance[n][d] * x[a.neighbors[n][d]];
      }
      y[n] = sum;
    }
  }

  /// Conjugate gradients with the diagonal as preconditioner; serial: labels are solved at once.
  std::vector<double> minimise(const Unknowns& a) const {
    const std::size_t count = a.nodes.size();
    std::vector<double> x(count, 0), r = a.right, z(count), p(count), q(count);
    const auto precondition = [&] {
      double sum = 0;
      for (std::size_t n = 0; n < count; ++n) {
        z[n] = r[n] / a.diagonal[n];
        sum += r[n] * z[n];
      }
      return sum;
    };
    double rz = precondition();
    const double enough = options_.tolerance * options_.tolerance * rz;
    p = z;
    for (int k = 0; k < kMostIterations && rz > enough; ++k) {
      multiply(a, p, q);
      double pq = 0;
      for (std::size_t n = 0; n < count; ++n) pq += p[n] * q[n];
      const double step = rz / pq;
      for (std::size_t n = 0; n < count; ++n) {
        x[n] += step * p[n];
        r[n] -= step * q[n];
      }
      const double before = std::exchange(rz, precondition());
      for (std::size_t n = 0; n < count; ++n) p[n] = z[n] + rz / before * p[n];
    }
    return x;
  }

  const LabelGrid& grid_;
  const GridMemberships& smooth_;
  std::span<const float> weight_, edges_;
  FlowOptions options_;
  double mass_ = 0;
  std::array<double, 3> per_length_{};
  int most_steps_ = 0;
  std::array<std::ptrdiff_t, 3> stride_{};
};

/// The labels that occur, 0 always, increasing, and where they lie.
std::vector<std::pair<std::uint16_t, Extent>> extents_of(const LabelGrid& grid) {
  constexpr Index kFar = std::numeric_limits<Index>::max();
  std::vector<Extent> all(1 + std::size_t{std::numeric_limits<std::uint16_t>::max()},
                          {{kFar, kFar, kFar}, {-1, -1, -1}});
  std::size_t n = 0;
  for (Index k = 0; k < grid.size[2]; ++k) {
    for (Index j = 0; j < grid.size[1]; ++j) {
      for (Index i = 0; i < grid.size[0]; ++i) {
        Extent& e = all[grid.labels[n++]];
        e = {{std::min(e.lo[0], i), std::min(e.lo[1], j), std::min(e.lo[2], k)},
             {std::max(e.hi[0], i), std::max(e.hi[1], j), std::max(e.hi[2], k)}};
      }
    }
  }
  std::vector<std::pair<std::uint16_t, Extent>> found;
  for (std::size_t label = 0; label < all.size(); ++label) {
    if (label == 0 || all[label].hi[0] >= 0) {
      found.emplace_back(static_cast<std::uint16_t>(label), all[label]);
    }
  }
  return found;
}

/// The memberships of all materials at the open nodes, and who wins.
class Assembly {
 public:
  Assembly(const LabelGrid& grid, const FlowFields& fields,
           const std::vector<std::pair<std::uint16_t, Extent>>& labels,
           const std::vector<Membership>& solved)
      : grid_(grid), smooth_(fields.smooth), weight_(fields.weight) {
    number_.assign(1 + std::size_t{std::numeric_limits<std::uint16_t>::max()}, 0);
    for (std::size_t m = 0; m < labels.size(); ++m) {
      number_[labels[m].first] = static_cast<Index>(m);
    }
    sort_by_node(solved);
    out_.size = grid.size;
    out_.spacing = grid.spacing;
    for (const auto& [label, extent] : labels) out_.label.push_back(label);
  }

  GridMemberships run() {
    out_.material.resize(grid_.labels.size());
    parallel_for(out_.material.size(), [&](std::size_t n) { out_.material[n] = winner(n); });
    list_boundaries();
    return std::move(out_);
  }

 private:
  /// Entries of each node, by material: from first_[n] to before first_[n + 1].
  void sort_by_node(const std::vector<Membership>& solved) {
    first_.assign(grid_.labels.size() + 1, 0);
    for (const Membership& one : solved) {
      for (const std::size_t node : one.nodes) ++first_[node + 1];
    }
    for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
    material_.resize(static_cast<std::size_t>(first_.back()));
    value_.resize(material_.size());
    std::vector<std::int64_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t m = 0; m < solved.size(); ++m) {
      for (std::size_t i = 0; i < solved[m].nodes.size(); ++i) {
        const auto to = static_cast<std::size_t>(next[solved[m].nodes[i]]++);
        material_[to] = static_cast<Index>(m);
        value_[to] = solved[m].value[i];
      }
    }
  }

  /// Of a node that is certain: smoothing may have taken a step of the labels off.
  Index own(std::size_t node) const {
    const auto material = static_cast<std::size_t>(smooth_.material[node]);
    return number_[static_cast<std::size_t>(smooth_.label[material])];
  }

  /// The background has what the others leave.
  float membership(std::size_t node, Index material) const {
    if (weight_[node] >= kCertain) {
      const Index label = out_.label[static_cast<std::size_t>(material)];
      return membership_of(smooth_, node, static_cast<std::uint16_t>(label));
    }
    float rest = 1;
    for (auto i = static_cast<std::size_t>(first_[node]);
         i < static_cast<std::size_t>(first_[node + 1]); ++i) {
      if (material_[i] == material) return value_[i];
      rest -= value_[i];
    }
    return material == 0 ? std::max(0.0F, rest) : 0.0F;
  }

  Index winner(std::size_t node) const {
    if (weight_[node] >= kCertain) return own(node);
    Index best = 0;
    float most = membership(node, 0);
    for (auto i = static_cast<std::size_t>(first_[node]);
         i < static_cast<std::size_t>(first_[node + 1]); ++i) {
      if (value_[i] > most) {
        most = value_[i];
        best = material_[i];
      }
    }
    return best;
  }

  /// The materials of a node and of its 14 neighbours, its own first; how many there are.
  std::size_t materials_at(const Place& p, std::array<Index, 15>& found) const {
    found[0] = material_at(p);
    std::size_t count = 1;
    for (const Index sign : {-1, 1}) {
      for (unsigned step = 1; step < 8; ++step) {
        const Place to{p[0] + sign * static_cast<Index>(step & 1U),
                       p[1] + sign * static_cast<Index>((step >> 1U) & 1U),
                       p[2] + sign * static_cast<Index>(step >> 2U)};
        if (!is_inside(to)) continue;
        const Index m = material_at(to);
        const auto end = found.begin() + static_cast<std::ptrdiff_t>(count);
        if (std::find(found.begin(), end, m) == end) found[count++] = m;
      }
    }
    return count;
  }

  bool is_inside(const Place& p) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (p[a] < 0 || p[a] >= grid_.size[a]) return false;
    }
    return true;
  }

  Index material_at(const Place& p) const {
    const auto nx = static_cast<std::size_t>(grid_.size[0]);
    const auto ny = static_cast<std::size_t>(grid_.size[1]);
    return out_
        .material[(static_cast<std::size_t>(p[2]) * ny + static_cast<std::size_t>(p[1])) * nx +
                  static_cast<std::size_t>(p[0])];
  }

  void list_boundaries() {
    out_.first.push_back(0);
    std::array<Index, 15> found;
    std::size_t node = 0;
    for (Index k = 0; k < grid_.size[2]; ++k) {
      for (Index j = 0; j < grid_.size[1]; ++j) {
        for (Index i = 0; i < grid_.size[0]; ++i, ++node) {
          const std::size_t count = materials_at({i, j, k}, found);
          for (std::size_t m = 0; count > 1 && m < count; ++m) {
            out_.listed.push_back(found[m]);
            out_.value.push_back(membership(node, found[m]));
          }
          out_.first.push_back(std::ssize(out_.listed));
        }
      }
    }
  }

  const LabelGrid& grid_;
  const GridMemberships& smooth_;
  std::span<const float> weight_;
  std::vector<Index> number_;  // the material of each label
  std::vector<std::int64_t> first_;
  std::vector<Index> material_;
  std::vector<float> value_;
  GridMemberships out_;
};

void require_fields(const LabelGrid& grid, const FlowFields& fields, const FlowOptions& o) {
  const std::size_t nodes = static_cast<std::size_t>(grid.size[0]) *
                            static_cast<std::size_t>(grid.size[1]) *
                            static_cast<std::size_t>(grid.size[2]);
  if (grid.labels.size() != nodes || fields.weight.size() != nodes ||
      fields.edges.size() != nodes) {
    throw InputError("labels: expected " + std::to_string(nodes) +
                     " labels, weights and edges, found " + std::to_string(grid.labels.size()) +
                     ", " + std::to_string(fields.weight.size()) + " and " +
                     std::to_string(fields.edges.size()));
  }
  if (fields.smooth.material.size() != nodes) {
    throw InputError("flow of labels: expected smooth_memberships() of the same labels");
  }
  const bool in_range = o.reach > 0 && std::isfinite(o.reach) && o.beta > 0 && o.eta >= 0 &&
                        o.unit_mm > 0 && o.tolerance > 0 && o.tolerance < 1;
  if (!in_range) {
    throw InputError(
        "flow of labels: expected a finite reach, beta and a unit above 0, eta of 0 or more, a "
        "tolerance of 0 to 1");
  }
}

}  // namespace

GridMemberships flow_memberships(const LabelGrid& grid, const FlowFields& fields,
                                 const FlowOptions& options) {
  require_fields(grid, fields, options);
  const auto labels = extents_of(grid);
  const LabelFlow flow(grid, fields, options);
  std::vector<Membership> solved(labels.size());
  parallel_for_each(labels.size(), [&](std::size_t m) {
    if (labels[m].first != 0) solved[m] = flow.solve(labels[m].first, labels[m].second);
  });
  return Assembly(grid, fields, labels, solved).run();
}

}  // namespace mesamis
