// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/shape_repair.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "mesamis/base/parallel.h"
#include "mesamis/remesh/body_shape.h"
#include "mesamis/remesh/collapse.h"
#include "mesamis/remesh/geometry.h"
#include "mesamis/remesh/skin.h"
#include "mesamis/remesh/swap.h"

namespace mesamis::detail::remesh {
namespace {

/// An operation must make the worst shape better by this factor.
constexpr double kGain = 1.005;

/// 26 directions around a vertex, to its neighbours in a grid of cubes.
std::vector<Vec3> directions() {
  std::vector<Vec3> all;
  for (int i = 0; i < 27; ++i) {
    const int x = i % 3, y = i / 3 % 3, z = i / 9;
    const Vec3 d{x - 1.0, y - 1.0, z - 1.0};
    if (i != 13) all.push_back(unit_or_zero(d));
  }
  return all;
}

class ShapeRepair {
 public:
  ShapeRepair(Workbench& bench, const ShapeRule& rule)
      : bench_(bench), mesh_(bench.mesh), rule_(rule), directions_(directions()) {}

  Counters run() {
    for (int sweep = 0; sweep < rule_.sweeps; ++sweep) {
      bool any = false;
      for (const auto& [score, cell] : bad_cells()) any |= improve(cell);
      if (!any) break;
    }
    return done_;
  }

 private:
  struct BadCell {
    double score;
    Index cell;
  };

  double score(const Cell& points) const { return shape_score(mesh_, points, rule_); }
  double worst_of(std::span<const Index> cells) const {
    return worst_score_inside(mesh_, cells, rule_);
  }
  double worst_proposed() const {
    double worst = INFINITY;
    for (const auto& proposal : bench_.cavity.proposed()) {
      if (proposal.quality3 <= kTinyQuality3) return 0;
      if (proposal.material != kOutside) worst = std::min(worst, score(proposal.points));
    }
    return worst;
  }

  static bool is_inside(const WorkCell& cell) { return cell.alive() && cell.material != kOutside; }

  std::vector<BadCell> bad_cells() const {
    auto bad = parallel_collect<BadCell>(mesh_.cells.size(), kBlock,
                                         [&](std::size_t begin, std::size_t end, auto& found) {
                                           for (std::size_t c = begin; c < end; ++c) {
                                             if (!is_inside(mesh_.cells[c])) continue;
                                             const double s = score(mesh_.cells[c].points);
                                             if (s < 1) found.push_back({s, static_cast<Index>(c)});
                                           }
                                         });
    std::sort(bad.begin(), bad.end(), [](const BadCell& a, const BadCell& b) {
      return std::tie(a.score, a.cell) < std::tie(b.score, b.cell);
    });
    return bad;
  }

  /// A cell of the list may have been replaced since: what is in its slot is looked at again.
  bool improve(Index cell) {
    if (!take_pending(mesh_, cell, kToRepair) || !is_inside(mesh_.cells[cell])) return false;
    if (score(mesh_.cells[cell].points) >= 1) return false;
    if (remove_an_edge(cell) || remove_a_face(cell)) {
      ++done_.swaps;
      return true;
    }
    if (collapse_an_edge(cell)) {
      ++done_.collapses;
      return true;
    }
    const bool moved = move_a_vertex(cell);
    done_.moves += moved;
    return moved;
  }

  bool remove_an_edge(Index cell) {
    const Cell points = mesh_.cells[cell].points;
    for (const auto& [i, j] : kCellEdges) {
      if (!propose_without_edge(bench_, cell, {points[i], points[j]})) continue;
      const auto shell = bench_.cavity.shell();
      if (!(worst_proposed() > kGain * worst_of(shell))) continue;
      bench_.cavity.replace(shell);
      return true;
    }
    return false;
  }

  bool remove_a_face(Index cell) {
    for (int f = 0; f < 4; ++f) {
      if (!propose_without_face(bench_, cell, f)) continue;
      const std::array<Index, 2> both{cell, cell_of(mesh_.cells[cell].neighbors[f])};
      if (!(worst_proposed() > kGain * worst_of(both))) continue;
      bench_.cavity.replace(both);
      return true;
    }
    return false;
  }

  bool collapse_an_edge(Index cell) {
    const Cell points = mesh_.cells[cell].points;
    for (const auto& [i, j] : kCellEdges) {
      if (collapse(points[i], points[j]) || collapse(points[j], points[i])) return true;
    }
    return false;
  }

  bool collapse(Index vertex, Index onto) {
    const auto ball = bench_.cavity.ball(vertex);
    const CollapseLimits limits{kTinyQuality3, rule_.new_length_max};
    if (ball.empty() || !propose_collapse(bench_, ball, {vertex, onto}, limits)) return false;
    if (!(worst_proposed() > kGain * worst_of(ball))) return false;
    bench_.cavity.replace(ball);
    mesh_.free_vertex(vertex);
    return true;
  }

  bool move_a_vertex(Index cell) {
    const Cell points = mesh_.cells[cell].points;
    bool moved = false;
    for (const Index v : points) moved |= move(v);
    return moved;
  }

  /// Where a vertex can go, and what is around it.
  struct Star {
    Index vertex;
    std::vector<Index> ball;
    Features features;
    std::vector<Corners3> skin;
    bool leaves_border = false;  ///< a vertex of the skin may go within the tolerance of the border
  };

  bool move(Index v) {
    Vertex& vertex = mesh_.vertices[v];
    if ((vertex.mask & kFrozen) || std::popcount(unsigned{vertex.mask} & kPlanes) == 3)
      return false;
    Star star{v, {}, {}, {}, false};
    bench_.cavity.collect_ball(v, star.ball);
    if (star.ball.empty()) return false;
    star.features = vertex_features(mesh_, star.ball, v);
    if (star.features.freedom() == 0) return false;
    star.skin = skin_triangles(mesh_, star.ball, v, vertex.position);
    if (climb(star)) return true;
    // Between two sides of a thin wall there is no room on the skin, but some within the tolerance.
    star.leaves_border = star.features.on_skin();
    return star.leaves_border && climb(star);
  }

  /// Steps in all directions, that shrink where none is better.
  bool climb(const Star& star) {
    constexpr double kLeastStep = 0.01;
    Vertex& vertex = mesh_.vertices[star.vertex];
    double best = worst_of(star.ball);
    const double before = best, size = mean_edge(star);
    for (double step = 0.3; step > kLeastStep;) {
      Vec3 best_place = vertex.position;
      const Vec3 here = vertex.position;
      double reached = best;
      for (const Vec3& direction : directions_) {
        const double there = try_place(star, here, here + step * size * direction);
        if (there > reached) {
          reached = there;
          best_place = vertex.position;
        }
        vertex.position = here;
      }
      vertex.position = best_place;
      if (reached > kGain * best) {
        best = reached;
      } else {
        step *= 0.5;
      }
    }
    if (!(best > kGain * before)) return false;
    settle_moved(bench_, star.vertex, star.ball);
    return true;
  }

  double mean_edge(const Star& star) const {
    double sum = 0;
    for (const Index c : star.ball) {
      for (const Index p : mesh_.cells[c].points) {
        sum += norm(mesh_.vertices[p].position - mesh_.vertices[star.vertex].position);
      }
    }
    return sum / (3.0 * static_cast<double>(star.ball.size()));
  }

  /// The worst score with the vertex there, on its features; 0 where it must not be.
  double try_place(const Star& star, const Vec3& here, Vec3 place) {
    const unsigned planes = star.features.planes;
    for (int axis = 0; axis < 3; ++axis) {
      if (planes >> (2 * axis) & 3) place[axis] = here[axis];
    }
    if (!star.leaves_border) place = onto_features(mesh_, place, star.features);
    if (!mesh_.box.contains(place) || planes_of(mesh_.box, place) != planes) return 0;
    Vertex& vertex = mesh_.vertices[star.vertex];
    vertex.position = place;
    const double worst = are_positive(mesh_, star.ball) ? worst_of(star.ball) : 0;
    if (worst <= 0 || !star.features.on_skin()) return worst;
    if (star.leaves_border && deviation(mesh_, place, star.features) > 1) return 0;
    const auto skin = skin_triangles(mesh_, star.ball, star.vertex, place);
    return may_replace_skin(mesh_, star.skin, skin) ? worst : 0;
  }

  Workbench& bench_;
  WorkingMesh& mesh_;
  const ShapeRule& rule_;
  std::vector<Vec3> directions_;
  Counters done_;
};

}  // namespace

Counters repair_shapes(Workbench& bench, const ShapeRule& rule) {
  return ShapeRepair(bench, rule).run();
}

}  // namespace mesamis::detail::remesh
