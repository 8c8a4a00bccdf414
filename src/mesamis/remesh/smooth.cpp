// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/smooth.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "mesamis/remesh/geometry.h"
#include "mesamis/remesh/skin.h"

namespace mesamis::detail::remesh {
namespace {

/// One vertex on its way to a better place.
class Mover {
 public:
  Mover(Workbench& bench, Index v, std::span<const Index> ball, const SmoothRule& rule)
      : mesh_(bench.mesh),
        sampler_(bench.sampler),
        shape_(bench.shape),
        rule_(rule),
        vertex_(mesh_.vertices[v]),
        ball_(ball) {
    for (const Index c : ball_) {
      const double q = mesh_.cells[c].quality3;
      worst_ = std::min(worst_, q);
      energy_ += energy(q);
    }
    shape_.gather(mesh_, ball_, v);
    if (!(vertex_.mask & kOnSkin)) return;
    features_ = vertex_features(mesh_, ball_, v);
    normal_ = skin_normal(mesh_, ball_, v);
    if (features_.freedom() == 1) tangent_ = line_direction();
    skin_ = skin_triangles(mesh_, ball_, v, vertex_.position);
    index_ = v;
  }

  /// Whether the vertex may move at all.
  bool is_free() const { return !features_.on_skin() || features_.freedom() > 0; }

  /// The cut leaves vertices where three materials meet off their line. They come to it as far as
  /// the cells around allow, whatever their energy.
  bool approach_junction() {
    if (!features_.junction() || !(deviation(mesh_, vertex_.position, features_) > kOffLine)) {
      return false;
    }
    const Vertex old = vertex_;
    const Vec3 way = onto_features(mesh_, old.position, features_) - old.position;
    for (const double share : {1.0, 0.5, 0.25}) {
      if (std::isfinite(energy_at(old, old.position + share * way)) &&
          are_turned_little(skin_, skin_here())) {
        accept(false);
        return true;
      }
    }
    vertex_ = old;
    return false;
  }

  bool run() {
    const BallShape::Directions directions = shape_.directions(vertex_);
    gradient_ = directions.gradient;
    return descend(directions.to_ideal) || descend(along_gradient());
  }

 private:
  static constexpr int kMostTrials = 4;

  double least_gain() const { return (1 - rule_.energy_ratio) * energy_; }

  /// Down the gradient in the metric, by a fifth of an edge at first.
  Vec3 along_gradient() const {
    constexpr double kFirstStep = 0.2;
    const Vec3 direction = on_planes(-solve_metric(vertex_.metric, on_planes(gradient_)));
    const double length = std::sqrt(squared_length(vertex_.metric, direction));
    return length > 0 ? kFirstStep / length * direction : Vec3{};
  }

  /// The part of a move that keeps the vertex on its planes and, to first order, on the skin.
  Vec3 on_planes(Vec3 move) const {
    if (features_.on_skin()) {
      if (features_.freedom() == 1) return dot(move, tangent_) * tangent_;
      move = move - dot(move, normal_) * normal_;
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (vertex_.mask >> (2 * axis) & 3) move[axis] = 0;
    }
    return move;
  }

  /// Of the line where three materials meet, or where the skin meets a plane of the box.
  Vec3 line_direction() const {
    if (const auto line = nearest_junction(mesh_, vertex_.position, features_)) {
      return line->direction;
    }
    Vec3 axis;
    for (int i = 0; i < 3; ++i) axis[i] = features_.planes >> (2 * i) & 3 ? 1 : 0;
    return unit_or_zero(cross(normal_, axis));
  }

  /// Line search. The energy is convex, near enough: where it falls too slowly at first it
  /// never falls enough, and a parabola through a failed trial says where to try next.
  bool descend(const Vec3& wanted) {
    constexpr double kLeastMove = 1e-4;  // square of a length in the metric
    const Vec3 move = on_planes(wanted);
    if (!(squared_length(vertex_.metric, move) >= kLeastMove)) return false;
    const double slope = dot(gradient_, move);
    const Vertex old = vertex_;
    double step = 1;
    for (int trial = 0; trial < kMostTrials && -slope * step > least_gain(); ++trial) {
      const double change = try_position(old, step * move) - energy_;
      if (change <= -least_gain()) {
        if (!keeps_skin()) break;
        accept(change > -rule_.small_gain * energy_);
        return true;
      }
      const double curvature = (change - slope * step) / (step * step);
      if (std::isfinite(change) && slope * slope < 4 * curvature * least_gain()) break;
      step *= std::isfinite(change) ? std::clamp(-slope / (2 * curvature * step), 0.1, 0.7) : 0.5;
    }
    vertex_ = old;
    return false;
  }

  /// The energy with the vertex there, where it stays; infinite if a cell is too bad.
  double try_position(const Vertex& old, const Vec3& move) {
    return energy_at(old, onto_features(mesh_, old.position + move, features_));
  }

  double energy_at(const Vertex& old, const Vec3& place) {
    vertex_.position = place;
    if (!mesh_.box.contains(vertex_.position) ||
        planes_of(mesh_.box, vertex_.position) != (old.mask & kPlanes)) {
      return kTooBad;
    }
    measure(vertex_, sampler_, old.hint);
    qualities_ = shape_.qualities(vertex_);
    if (std::ranges::min(qualities_) <= rule_.quality3_loss * worst_) return kTooBad;
    double sum = 0;
    for (const double q : qualities_) sum += energy(q);
    return sum;
  }

  bool keeps_skin() const {
    return !features_.on_skin() || may_replace_skin(mesh_, skin_, skin_here());
  }

  std::vector<Corners3> skin_here() const {
    return skin_triangles(mesh_, ball_, index_, vertex_.position);
  }

  void accept(bool is_small) {
    const auto pending = static_cast<std::uint8_t>(is_small ? kToAll & ~kToSmooth : kToAll);
    for (std::size_t i = 0; i < ball_.size(); ++i) {
      WorkCell& cell = mesh_.cells[ball_[i]];
      cell.quality3 = static_cast<float>(qualities_[i]);
      cell.pending = static_cast<std::uint8_t>(cell.pending | pending);
      cell.tried = 0;
    }
  }

  /// In tolerances: nearer vertices are on the line of three materials.
  static constexpr double kOffLine = 0.1;
  static constexpr double kTooBad = std::numeric_limits<double>::infinity();

  WorkingMesh& mesh_;
  const MetricSampler& sampler_;
  BallShape& shape_;
  const SmoothRule& rule_;
  Vertex& vertex_;
  std::span<const Index> ball_;
  double worst_ = 1, energy_ = 0;
  Vec3 gradient_;
  std::span<const double> qualities_;
  // Of a vertex on the skin:
  Features features_;
  Vec3 normal_;
  Vec3 tangent_;                ///< of the line that the vertex may move along
  std::vector<Corners3> skin_;  ///< around the vertex where it was
  Index index_ = kNoIndex;
};

}  // namespace

bool smooth_vertex(Workbench& bench, Index v, const SmoothRule& rule) {
  Vertex& vertex = bench.mesh.vertices[v];
  if ((vertex.mask & kFrozen) || std::popcount(unsigned{vertex.mask} & kPlanes) == 3) return false;
  if (vertex.rest > 0) {
    --vertex.rest;
    return false;
  }
  const auto ball = bench.cavity.ball(v);
  if (ball.empty()) return false;
  Mover mover(bench, v, ball, rule);
  const bool moved = mover.approach_junction() || (mover.is_free() && mover.run());
  const int failures = moved ? 0 : std::min(rule.most_rest, vertex.failures + 1);
  vertex.failures = vertex.rest = static_cast<std::uint8_t>(failures);
  return moved;
}

std::int64_t smooth_bad_cells(Workbench& bench, const SmoothRule& rule) {
  WorkingMesh& mesh = bench.mesh;
  std::int64_t moves = 0;
  bench.seen.clear();
  for (Index c = 0; c < std::ssize(mesh.cells); ++c) {
    if (mesh.cells[c].quality3 > rule.quality3_max) continue;
    if (!take_pending(mesh, c, kToSmooth)) continue;
    for (const Index v : Cell{mesh.cells[c].points}) {
      if (bench.seen.insert(v)) moves += smooth_vertex(bench, v, rule);
    }
  }
  return moves;
}

}  // namespace mesamis::detail::remesh
