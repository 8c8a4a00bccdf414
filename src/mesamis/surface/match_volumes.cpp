// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/match_volumes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/grid_field.h"
#include "mesamis/surface/partition_cells.h"

namespace mesamis {
namespace {

/// No constant changes by more in a round.
constexpr double kLongestStep = 0.25;
/// Of Gauss and Seidel's iteration, which solves for a round's changes.
constexpr int kSweeps = 100;

/// The boundary between two materials, the second kNoIndex at the box.
struct Interface {
  double flux = 0;   ///< what it adds to the volume of the first, mm^3
  double slope = 0;  ///< that volume's change with the difference of the constants, mm^3
};
using Sides = std::array<Index, 2>;
using Interfaces = std::map<Sides, Interface>;

/// The volumes of all materials, and how they change.
class Measure {
 public:
  explicit Measure(const GridMemberships& grid) : field_(grid, true), marcher_(field_) {}

  Interfaces run(std::size_t layers) const {
    std::vector<Interfaces> of_layer(layers);
    parallel_for_each(layers, [&](std::size_t k) { of_layer[k] = layer(static_cast<Index>(k)); });
    Interfaces all;
    for (const Interfaces& some : of_layer) {
      for (const auto& [sides, part] : some) {
        all[sides].flux += part.flux;
        all[sides].slope += part.slope;
      }
    }
    return all;
  }

 private:
  Interfaces layer(Index k) const {
    Interfaces found;
    std::vector<PartitionPiece> pieces;
    Sides last{kNoIndex, kNoIndex};
    Interface* at = nullptr;
    field_.for_cells_above(k, [&](const Cell& cell) {
      pieces.clear();
      marcher_.march(cell, pieces);
      for (const PartitionPiece& piece : pieces) {
        if (at == nullptr || piece.sides != last) at = &found[last = piece.sides];
        add(cell, piece, *at);
      }
    });
    return found;
  }

  void add(const Cell& cell, const PartitionPiece& piece, Interface& to) const {
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

/// The memberships with the constants added; the node's own material is kept ahead.
void shift(const std::vector<float>& base, const std::vector<double>& constants,
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

double worst_of(const std::vector<double>& lack, const std::vector<double>& wanted) {
  double worst = 0;
  for (std::size_t m = 0; m < lack.size(); ++m) {
    worst = std::max(worst, std::abs(lack[m]) / wanted[m]);
  }
  return worst;
}

}  // namespace

std::vector<double> part_volumes(const GridMemberships& grid, const std::vector<Index>& material) {
  std::vector<double> volumes(grid.label.size(), 0);
  const double voxel = grid.spacing.x * grid.spacing.y * grid.spacing.z;
  std::size_t n = 0;
  for (Index k = 0; k < grid.size[2]; ++k) {
    for (Index j = 0; j < grid.size[1]; ++j) {
      for (Index i = 0; i < grid.size[0]; ++i, ++n) {
        double share = voxel;
        if (i == 0 || i + 1 == grid.size[0]) share /= 2;
        if (j == 0 || j + 1 == grid.size[1]) share /= 2;
        if (k == 0 || k + 1 == grid.size[2]) share /= 2;
        volumes[material[n]] += share;
      }
    }
  }
  return volumes;
}

void match_volumes(GridMemberships& memberships, const std::vector<double>& wanted,
                   const SmoothOptions& options, SmoothReport& report) {
  const auto fixed =
      static_cast<std::size_t>(std::max_element(wanted.begin(), wanted.end()) - wanted.begin());
  std::vector<double> constants(wanted.size(), 0);
  const std::vector<float> base = memberships.value;
  for (report.rounds = 0;; ++report.rounds) {
    shift(base, constants, memberships);
    const Interfaces interfaces =
        Measure(memberships).run(static_cast<std::size_t>(memberships.size[2] - 1));
    const std::vector<double> lack = lacks(wanted, interfaces);
    report.volume_error = worst_of(lack, wanted);
    report.converged = report.volume_error <= options.volume_accuracy;
    if (report.converged || report.rounds == options.most_rounds) break;
    const std::vector<double> step = newton_step(lack, interfaces, fixed);
    for (std::size_t m = 0; m < constants.size(); ++m) constants[m] += step[m];
  }
}

}  // namespace mesamis
