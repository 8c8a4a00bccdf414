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
#include "mesamis/labels/label_flow.h"
#include "mesamis/surface/list_materials.h"

namespace mesamis::detail::labels {
namespace {

/// A label and where it lies.
using LabelAt = std::pair<std::uint16_t, LabelExtent>;

/// The labels that occur, 0 always, increasing, and where they lie.
std::vector<LabelAt> extents_of(const LabelGrid& grid) {
  constexpr Index kFar = std::numeric_limits<Index>::max();
  std::vector<LabelExtent> all(1 + std::size_t{std::numeric_limits<std::uint16_t>::max()},
                               {{kFar, kFar, kFar}, {-1, -1, -1}});
  std::size_t n = 0;
  for (Index k = 0; k < grid.size[2]; ++k) {
    for (Index j = 0; j < grid.size[1]; ++j) {
      for (Index i = 0; i < grid.size[0]; ++i) {
        LabelExtent& e = all[grid.labels[n++]];
        e = {{std::min(e.lo[0], i), std::min(e.lo[1], j), std::min(e.lo[2], k)},
             {std::max(e.hi[0], i), std::max(e.hi[1], j), std::max(e.hi[2], k)}};
      }
    }
  }
  std::vector<LabelAt> found;
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
  Assembly(const LabelGrid& grid, const FlowFields& fields, const std::vector<LabelAt>& labels,
           const std::vector<LabelMembership>& solved)
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
    list_materials(out_);
    parallel_for(out_.material.size(), [&](std::size_t n) {
      for (auto i = static_cast<std::size_t>(out_.first[n]);
           i < static_cast<std::size_t>(out_.first[n + 1]); ++i) {
        out_.value[i] = membership(n, out_.listed[i]);
      }
    });
    return std::move(out_);
  }

 private:
  /// Entries of each node, by material: from first_[n] to before first_[n + 1].
  void sort_by_node(const std::vector<LabelMembership>& solved) {
    first_.assign(grid_.labels.size() + 1, 0);
    for (const LabelMembership& one : solved) {
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
      return smooth_membership(smooth_, node, static_cast<std::uint16_t>(label));
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
  const std::size_t nodes = grid.node_count();
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

FlowReport report_of(const std::vector<LabelAt>& labels,
                     const std::vector<LabelMembership>& solved) {
  FlowReport report;
  for (std::size_t m = 0; m < labels.size(); ++m) {
    if (labels[m].first == 0) continue;
    report.solver_iterations += solved[m].solved.iterations;
    report.solver_residual = std::max(report.solver_residual, solved[m].solved.residual);
    report.solver_converged &= solved[m].solved.converged;
  }
  return report;
}

}  // namespace

GridMemberships flow_memberships(const LabelGrid& grid, const FlowFields& fields,
                                 const FlowOptions& options, FlowReport* report) {
  require_fields(grid, fields, options);
  const auto labels = extents_of(grid);
  const LabelFlow flow(grid, fields, options);
  std::vector<LabelMembership> solved(labels.size());
  parallel_for_each(labels.size(), [&](std::size_t m) {
    if (labels[m].first != 0) solved[m] = flow.solve(labels[m].first, labels[m].second);
  });
  if (report) *report = report_of(labels, solved);
  return Assembly(grid, fields, labels, solved).run();
}

}  // namespace mesamis::detail::labels
