// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/collapse.h"

#include <algorithm>
#include <cmath>

#include "mesamis/remesh/edge_candidates.h"
#include "mesamis/remesh/geometry.h"
#include "mesamis/remesh/skin.h"
#include "mesamis/remesh/smooth.h"

namespace mesamis::detail::remesh {
namespace {

/// A vertex may leave for another only if that lies on all of its box planes, and on the skin.
bool may_move(const Vertex& vertex, const Vertex& onto) {
  return !(vertex.mask & kFrozen) && (vertex.mask & ~onto.mask & (kPlanes | kOnSkin)) == 0;
}

double worst_quality3(const WorkingMesh& mesh, std::span<const Index> cells) {
  double worst = 1;
  for (const Index c : cells) worst = std::min(worst, double{mesh.cells[c].quality3});
  return worst;
}

/// Proposes the vertex's cells with `onto` in its place; those that have both vanish.
bool propose_moved(Workbench& bench, std::span<const Index> ball, std::array<Index, 2> move,
                   double quality3_min) {
  bench.cavity.clear();
  for (const Index c : ball) {
    Cell moved = bench.mesh.cells[c].points;
    if (local_index(moved, move[1]) >= 0) continue;
    moved[local_index(moved, move[0])] = move[1];
    const double q = quality3(bench.mesh, moved);
    if (q < quality3_min) return false;
    bench.cavity.propose(moved, q, bench.mesh.cells[c].material);
  }
  return !bench.cavity.proposed().empty();
}

CollapseRule balanced(CollapseRule rule, double length) {
  if (rule.balance > 0) rule.new_length_max = std::max(rule.balance / length, std::sqrt(2.0));
  return rule;
}

bool keeps_edges_short(Workbench& bench, Index onto, double length_max) {
  const auto& vertices = bench.mesh.vertices;
  bench.seen.clear();
  bench.seen.insert(onto);
  for (const auto& proposal : bench.cavity.proposed()) {
    for (const Index p : proposal.points) {
      if (bench.seen.insert(p) && length(vertices[onto], vertices[p]) > length_max) return false;
    }
  }
  return true;
}

/// @return the end that is left, or kNoIndex if both are.
Index collapse_edge(Workbench& bench, const EdgeCandidate& edge, const CollapseRule& rule) {
  if (collapse_vertex(bench, edge.a, edge.b, rule)) return edge.b;
  return collapse_vertex(bench, edge.b, edge.a, rule) ? edge.a : kNoIndex;
}

}  // namespace

bool propose_collapse(Workbench& bench, std::span<const Index> ball, std::array<Index, 2> move,
                      const CollapseLimits& limits) {
  const auto& vertices = bench.mesh.vertices;
  if (!may_move(vertices[move[0]], vertices[move[1]])) return false;
  if (!propose_moved(bench, ball, move, limits.quality3_min)) return false;
  if (!keeps_edges_short(bench, move[1], limits.new_length_max)) return false;
  return bench.mesh.shape == nullptr || may_collapse_in_body(bench, ball, move[0], move[1]);
}

bool collapse_vertex(Workbench& bench, Index vertex, Index onto, const CollapseRule& rule) {
  WorkingMesh& mesh = bench.mesh;
  if (!may_move(mesh.vertices[vertex], mesh.vertices[onto])) return false;  // spares the ball
  const auto ball = bench.cavity.ball(vertex);
  if (ball.empty()) return false;
  const double worst = worst_quality3(mesh, ball);
  const double loss_limit = std::max(rule.quality3_loss * worst, kTinyQuality3);
  const double limit =
      std::max(std::min(rule.quality3_min, loss_limit), std::min(rule.quality3_floor, worst));
  if (!propose_collapse(bench, ball, {vertex, onto}, {limit, rule.new_length_max})) return false;
  bench.cavity.replace(ball);
  mesh.free_vertex(vertex);
  return true;
}

std::int64_t collapse_short_edges(Workbench& bench, const CollapseRule& rule) {
  const WorkingMesh& mesh = bench.mesh;
  std::int64_t collapses = 0;
  EdgeCandidate last{0, kNoIndex, kNoIndex, kNoIndex};
  for (const EdgeCandidate& edge : short_edges(bench.mesh, rule.length_min)) {
    if (edge.is_same_edge(last) || edge.is_gone(mesh)) continue;
    last = edge;
    const Index kept = collapse_edge(bench, edge, balanced(rule, edge.length));
    if (kept == kNoIndex) continue;
    ++collapses;
    smooth_vertex(bench, kept, {});
  }
  return collapses;
}

}  // namespace mesamis::detail::remesh
