// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/match_volumes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/grid_field.h"
#include "mesamis/surface/partition_cells.h"

namespace mesamis::detail::surface {
namespace {

/// No constant changes by more in a round.
constexpr double kLongestStep = 0.25;
/// Of Gauss and Seidel's iteration, which solves for a round's changes.
constexpr int kSweeps = 100;

using Sides = std::array<Index, 2>;

/// Measures what boundaries add to the volumes, and how that changes.
class Measure {
 public:
  explicit Measure(const GridMemberships& grid) : field_(grid, true), marcher_(field_) {}

  /// Of the cells above slice k.
  LayerVolumes layer(Index k) const {
    std::map<Sides, InterfaceVolume> found;
    std::vector<PartitionPiece> pieces;
    InterfaceVolume* at = nullptr;
    field_.for_cells_above(k, [&](const Cell& cell) {
      pieces.clear();
      marcher_.march(cell, pieces);
      for (const PartitionPiece& piece : pieces) {
        if (at == nullptr || piece.sides != at->sides) {
          at = &found[piece.sides];
          at->sides = piece.sides;
        }
        add(cell, piece, *at);
      }
    });
    LayerVolumes volumes;
    for (const auto& [sides, volume] : found) volumes.push_back(volume);
    return volumes;
  }

 private:
  void add(const Cell& cell, const PartitionPiece& piece, InterfaceVolume& to) const {
    const Vec3 a = marcher_.position(piece.corners[0]), b = marcher_.position(piece.corners[1]),
               c = marcher_.position(piece.corners[2]);
    to.flux += dot(a, cross(b, c)) / 6;
    if (piece.sides[1] == kNoIndex) return;
    const double steepness = norm(gradient(cell, piece.sides));
    if (steepness > 0) to.slope += norm(cross(b - a, c - a)) / (2 * steepness);
  }

  /// Of the difference of two memberships.
  Vec3 gradient(const Cell& cell, const Sides& sides) const {
    std::array<Vec3, 4> p;
    std::array<double, 4> d;
    for (std::size_t i = 0; i < 4; ++i) {
      p[i] = field_.point(cell[i]);
      d[i] = field_.membership(cell[i], sides[0]) - field_.membership(cell[i], sides[1]);
    }
    const Vec3 u = p[1] - p[0], v = p[2] - p[0], w = p[3] - p[0];
    const Vec3 sum =
        (d[1] - d[0]) * cross(v, w) + (d[2] - d[0]) * cross(w, u) + (d[3] - d[0]) * cross(u, v);
    return (1 / dot(u, cross(v, w))) * sum;
  }

  GridField field_;
  PartitionMarcher<GridField> marcher_;
};

using Interfaces = std::map<Sides, InterfaceVolume>;

/// Adds up layers in their order.
Interfaces sum_of(std::span<const LayerVolumes> layers) {
  Interfaces all;
  for (const LayerVolumes& layer : layers) {
    for (const InterfaceVolume& part : layer) {
      InterfaceVolume& sum = all[part.sides];
      sum.flux += part.flux;
      sum.slope += part.slope;
    }
  }
  return all;
}

/// What each material lacks of its volume.
std::vector<double> lacks(const std::vector<double>& wanted, const Interfaces& interfaces) {
  std::vector<double> lack = wanted;
  for (const auto& [sides, part] : interfaces) {
    lack[static_cast<std::size_t>(sides[0])] -= part.flux;
    if (sides[1] != kNoIndex) lack[static_cast<std::size_t>(sides[1])] += part.flux;
  }
  return lack;
}

/// Newton's step: the changes d of the constants with sum_b slope_ab (d_a - d_b) = lack_a.
/// @param fixed  the material whose constant stays.
std::vector<double> newton_step(const std::vector<double>& lack, const Interfaces& interfaces,
                                std::size_t fixed) {
  std::vector<std::vector<std::pair<std::size_t, double>>> around(lack.size());
  for (const auto& [sides, part] : interfaces) {
    if (sides[1] == kNoIndex || part.slope <= 0) continue;
    const auto a = static_cast<std::size_t>(sides[0]), b = static_cast<std::size_t>(sides[1]);
    around[a].emplace_back(b, part.slope);
    around[b].emplace_back(a, part.slope);
  }
  std::vector<double> step(lack.size(), 0);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t a = 0; a < lack.size(); ++a) {
      double sum = lack[a], weight = 0;
      for (const auto& [b, slope] : around[a]) {
        sum += slope * step[b];
        weight += slope;
      }
      if (a != fixed && weight > 0) step[a] = sum / weight;
    }
  }
  for (double& s : step) s = std::clamp(s, -kLongestStep, kLongestStep);
  return step;
}

double worst_of(const std::vector<double>& lack, const std::vector<double>& wanted) {
  double worst = 0;
  for (std::size_t m = 0; m < lack.size(); ++m) {
    worst = std::max(worst, std::abs(lack[m]) / wanted[m]);
  }
  return worst;
}

/// Calls visit(node, eighths of its voxel within the grid) for all nodes of a grid.
/// @param ends  whether the grid ends at the bottom, and at the top.
template <class Visit>
void for_each_share(const std::array<Index, 3>& size, const std::array<bool, 2>& ends,
                    Visit&& visit) {
  std::size_t n = 0;
  for (Index k = 0; k < size[2]; ++k) {
    const bool is_end = (k == 0 && ends[0]) || (k + 1 == size[2] && ends[1]);
    for (Index j = 0; j < size[1]; ++j) {
      for (Index i = 0; i < size[0]; ++i, ++n) {
        std::int64_t share = is_end ? 4 : 8;
        if (i == 0 || i + 1 == size[0]) share /= 2;
        if (j == 0 || j + 1 == size[1]) share /= 2;
        visit(n, share);
      }
    }
  }
}

}  // namespace

std::vector<std::int64_t> voxel_eighths(const GridMemberships& grid,
                                        std::span<const Index> material) {
  std::vector<std::int64_t> eighths(grid.label.size(), 0);
  for_each_share(grid.size, {grid.below == 0, grid.above == 0},
                 [&](std::size_t n, std::int64_t share) { eighths[material[n]] += share; });
  return eighths;
}

std::vector<std::int64_t> label_eighths(const LabelGrid& labels) {
  std::vector<std::int64_t> eighths;
  for_each_share(labels.size, {true, true}, [&](std::size_t n, std::int64_t share) {
    const std::size_t label = labels.labels[n];
    if (label >= eighths.size()) eighths.resize(label + 1, 0);
    eighths[label] += share;
  });
  return eighths;
}

std::vector<double> volumes_of(std::span<const std::int64_t> eighths, const Vec3& spacing) {
  const double eighth = spacing.x * spacing.y * spacing.z / 8;
  std::vector<double> volumes;
  volumes.reserve(eighths.size());
  for (const std::int64_t count : eighths) volumes.push_back(static_cast<double>(count) * eighth);
  return volumes;
}

std::vector<LayerVolumes> measure_layers(const GridMemberships& grid) {
  const Measure measure(grid);
  std::vector<LayerVolumes> layers(static_cast<std::size_t>(grid.size[2] - 1));
  parallel_for_each(layers.size(),
                    [&](std::size_t k) { layers[k] = measure.layer(static_cast<Index>(k)); });
  return layers;
}

void add_constants(std::span<const float> base, std::span<const double> constants,
                   GridMemberships& grid) {
  parallel_for(grid.material.size(), [&](std::size_t n) {
    const auto begin = static_cast<std::size_t>(grid.first[n]);
    const auto end = static_cast<std::size_t>(grid.first[n + 1]);
    std::size_t own = end;
    float most = -1e30F;
    for (std::size_t i = begin; i < end; ++i) {
      const auto m = static_cast<std::size_t>(grid.listed[i]);
      grid.value[i] = base[i] + static_cast<float>(constants[m]);
      if (grid.listed[i] == grid.material[n]) {
        own = i;
      } else {
        most = std::max(most, grid.value[i]);
      }
    }
    if (own < end) grid.value[own] = std::max(grid.value[own], most + kLeastLead);
  });
}

VolumeMatch::VolumeMatch(std::vector<double> wanted, const SmoothOptions& options)
    : wanted_(std::move(wanted)), constants_(wanted_.size(), 0), options_(options) {}

bool VolumeMatch::improve(std::span<const LayerVolumes> layers) {
  const Interfaces interfaces = sum_of(layers);
  const std::vector<double> lack = lacks(wanted_, interfaces);
  report_.volume_error = worst_of(lack, wanted_);
  report_.converged = report_.volume_error <= options_.volume_accuracy;
  if (report_.converged || report_.rounds == options_.most_rounds) return false;
  // The largest material keeps its constant.
  const auto fixed =
      static_cast<std::size_t>(std::max_element(wanted_.begin(), wanted_.end()) - wanted_.begin());
  const std::vector<double> step = newton_step(lack, interfaces, fixed);
  for (std::size_t m = 0; m < step.size(); ++m) constants_[m] += step[m];
  ++report_.rounds;
  return true;
}

SmoothReport match_volumes(GridMemberships& memberships, std::vector<double> wanted,
                           const SmoothOptions& options) {
  VolumeMatch match(std::move(wanted), options);
  const std::vector<float> base = memberships.value;
  do {
    add_constants(base, match.constants(), memberships);
  } while (match.improve(measure_layers(memberships)));
  return match.report();
}

}  // namespace mesamis::detail::surface
