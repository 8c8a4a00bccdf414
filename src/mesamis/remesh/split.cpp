// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/split.h"

#include <algorithm>
#include <cmath>

#include "mesamis/remesh/edge_candidates.h"
#include "mesamis/remesh/geometry.h"
#include "mesamis/remesh/skin.h"

namespace mesamis::detail::remesh {
namespace {

/// Where the edge's middle lies in the metric, as a share of the edge; the size is taken to
/// vary geometrically along it.
double metric_middle(const Vertex& a, const Vertex& b) {
  const Vec3 e = b.position - a.position;
  const double la = std::sqrt(squared_length(a.metric, e));
  const double lb = std::sqrt(squared_length(b.metric, e));
  const double ratio = lb / la;
  if (ratio > 0.95 && ratio < 1.05) return 0.5;
  return std::clamp(std::log((1 + ratio) / 2) / std::log(ratio), 0.25, 0.75);
}

/// The point at a share of the way from a to b, exactly on the planes of both.
Vec3 point_between(const WorkingMesh& mesh, const Vertex& a, const Vertex& b, double share) {
  Vec3 p = a.position + share * (b.position - a.position);
  const unsigned planes = a.mask & b.mask;
  for (int axis = 0; axis < 3; ++axis) {
    if (planes >> (2 * axis) & 1) p[axis] = mesh.box.lo[axis];
    if (planes >> (2 * axis) & 2) p[axis] = mesh.box.hi[axis];
  }
  return p;
}

/// @param on_skin  whether the edge lies on the skin of a body.
Index make_vertex(Workbench& bench, const SplitEdge& edge, const Vec3& position, bool on_skin) {
  WorkingMesh& mesh = bench.mesh;
  const Index v = mesh.new_vertex();
  const Vertex &va = mesh.vertices[edge.a], &vb = mesh.vertices[edge.b];
  Vertex& vertex = mesh.vertices[v];
  vertex.position = position;
  vertex.mask = va.mask & vb.mask & kPlanes;
  if (on_skin) vertex.mask |= kOnSkin;
  measure(vertex, bench.sampler, va.hint);
  return v;
}

/// The middle of the edge in the metric; of an edge on the skin the place on it that is nearest.
Index make_middle(Workbench& bench, const SplitEdge& edge) {
  const WorkingMesh& mesh = bench.mesh;
  Features features;
  if (mesh.shape != nullptr) features = edge_features(mesh, bench.cavity, {edge.a, edge.b});
  const Vertex &va = mesh.vertices[edge.a], &vb = mesh.vertices[edge.b];
  const Vec3 middle = point_between(mesh, va, vb, metric_middle(va, vb));
  return make_vertex(bench, edge, onto_features(mesh, middle, features), features.on_skin());
}

SplitRule balanced(SplitRule rule, double length) {
  if (rule.balance > 0) rule.new_length_min = std::min(rule.balance / length, std::sqrt(0.5));
  return rule;
}

bool keeps_distance(const Workbench& bench, const SplitEdge& edge, Index v, double distance) {
  const auto& vertices = bench.mesh.vertices;
  auto is_far = [&](Index other) { return length(vertices[other], vertices[v]) >= distance; };
  const auto ring = bench.cavity.ring();
  return is_far(edge.a) && is_far(edge.b) && std::all_of(ring.begin(), ring.end(), is_far);
}

/// Proposes both halves of every cell around the edge. @return whether they are good enough.
bool propose_halves(Workbench& bench, const SplitEdge& edge, Index v, const SplitRule& rule) {
  bench.cavity.clear();
  double before = 1, after = 1;
  for (const Index c : bench.cavity.shell()) {
    before = std::min(before, double{bench.mesh.cells[c].quality3});
    for (const Index end : {edge.a, edge.b}) {
      Cell half = bench.mesh.cells[c].points;
      half[local_index(half, end)] = v;
      const double q = quality3(bench.mesh, half);
      if (q <= 0) return false;
      after = std::min(after, q);
      bench.cavity.propose(half, q, bench.mesh.cells[c].material);
    }
  }
  if (after < std::min(rule.quality3_floor, before)) return false;
  return edge.urgent || after >= rule.quality3_min || after >= rule.quality3_loss * before;
}

/// Puts the halves in the place of the shell, or takes the new vertex back.
bool finish_split(Workbench& bench, Index v, bool is_good) {
  if (is_good) {
    bench.cavity.replace(bench.cavity.shell());
  } else {
    bench.mesh.free_vertex(v);
  }
  return is_good;
}

}  // namespace

bool split_edge(Workbench& bench, const SplitEdge& edge, const SplitRule& rule) {
  WorkingMesh& mesh = bench.mesh;
  if (mesh.vertices[edge.a].mask & mesh.vertices[edge.b].mask & kFrozen) return false;
  if (!bench.cavity.find_shell(edge.cell, edge.a, edge.b)) return false;
  const Index v = make_middle(bench, edge);
  const Vertex& middle = mesh.vertices[v];
  const bool placed = planes_of(mesh.box, middle.position) == (middle.mask & kPlanes);
  return finish_split(bench, v,
                      placed &&
                          (edge.urgent || keeps_distance(bench, edge, v, rule.new_length_min)) &&
                          propose_halves(bench, edge, v, rule));
}

Index split_edge_at(Workbench& bench, const SplitEdge& edge, double share, bool on_skin) {
  constexpr double kLeastShare = 0.03;
  const WorkingMesh& mesh = bench.mesh;
  if (!bench.cavity.find_shell(edge.cell, edge.a, edge.b)) return kNoIndex;
  const Vertex &va = mesh.vertices[edge.a], &vb = mesh.vertices[edge.b];
  const double inside = std::clamp(share, kLeastShare, 1 - kLeastShare);
  const Index v = make_vertex(bench, edge, point_between(mesh, va, vb, inside), on_skin);
  const bool is_good = propose_halves(bench, {edge.cell, edge.a, edge.b, true}, v, {});
  return finish_split(bench, v, is_good) ? v : kNoIndex;
}

std::int64_t split_long_edges(Workbench& bench, const SplitRule& rule) {
  std::int64_t splits = 0;
  EdgeCandidate last{0, kNoIndex, kNoIndex, kNoIndex};
  for (const EdgeCandidate& edge : long_edges(bench.mesh, rule.length_max)) {
    if (edge.is_same_edge(last) || edge.is_gone(bench.mesh)) continue;
    if (bench.mesh.cell_count() >= rule.most_cells) break;
    last = edge;
    const bool urgent = edge.length > rule.urgent_length;
    splits += split_edge(bench, {edge.cell, edge.a, edge.b, urgent}, balanced(rule, edge.length));
  }
  return splits;
}

}  // namespace mesamis::detail::remesh
