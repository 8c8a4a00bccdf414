// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/smooth.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "mesamis/remesh/geometry.h"

namespace mesamis::remeshing {
namespace {

/// Inverse of a metric's factor, lower triangular too.
class InverseFactor {
 public:
  explicit InverseFactor(const MetricFactor& l)
      : xx_(1 / double{l.xx}), yy_(1 / double{l.yy}), zz_(1 / double{l.zz}) {
    yx_ = -yy_ * l.yx * xx_;
    zy_ = -zz_ * l.zy * yy_;
    zx_ = -zz_ * (l.zx * xx_ + l.zy * yx_);
  }
  /// L^-1 n
  Vec3 apply(const Vec3& n) const {
    return {xx_ * n.x, yx_ * n.x + yy_ * n.y, zx_ * n.x + zy_ * n.y + zz_ * n.z};
  }
  /// L^-T n
  Vec3 apply_transposed(const Vec3& n) const {
    return {xx_ * n.x + yx_ * n.y + zx_ * n.z, yy_ * n.y + zy_ * n.z, zz_ * n.z};
  }

 private:
  double xx_, yx_, zx_, yy_, zy_, zz_;
};

/// The face of a cell opposite the vertex.
struct OppositeFace {
  Vec3 a, b, c;
  /// Towards the vertex; also the derivative of six times the volume by the vertex's position.
  Vec3 normal() const { return cross(c - a, b - a); }
  Vec3 middle() const { return (1.0 / 3) * (a + b + c); }
};

OppositeFace opposite_face(const WorkingMesh& mesh, const WorkCell& cell, Index vertex) {
  const auto& face = kCellFaces[local_index(cell.points, vertex)];
  return {mesh.vertices[cell.points[face[0]]].position,
          mesh.vertices[cell.points[face[1]]].position,
          mesh.vertices[cell.points[face[2]]].position};
}

/// Where the vertex would have to be for a cell to be regular: above the middle of the opposite
/// face, at the height of a unit regular cell, in the direction normal to it in the metric.
Vec3 ideal_position(const OppositeFace& face, const InverseFactor& inverse) {
  constexpr double kHeight = 0.81649658092772603;  // sqrt(2 / 3)
  const Vec3 normal = inverse.apply(face.normal());
  return face.middle() + kHeight / norm(normal) * inverse.apply_transposed(normal);
}

/// Derivative of a cell's energy by the vertex's position, in the metric of the vertex.
Vec3 energy_gradient(const OppositeFace& face, const Vertex& vertex, double quality3) {
  const Vec3& x = vertex.position;
  const Vec3 a = in_metric(vertex.metric, face.a - x), b = in_metric(vertex.metric, face.b - x),
             c = in_metric(vertex.metric, face.c - x);
  const Vec3 sum = a + b + c;
  const double squares = 4 * (dot(a, a) + dot(b, b) + dot(c, c)) - dot(sum, sum);
  const Vec3 normal = face.normal();
  const Vec3 by_squares = -6 / squares * from_metric(vertex.metric, sum);
  const Vec3 by_volume = -2 / dot(normal, x - face.a) * normal;
  return 1 / std::max(quality3, kTinyQuality3) * (by_squares + by_volume);
}

bool is_inside(const Box& box, const Vec3& p) {
  return p.x >= box.lo.x && p.x <= box.hi.x && p.y >= box.lo.y && p.y <= box.hi.y &&
         p.z >= box.lo.z && p.z <= box.hi.z;
}

/// One vertex on its way to a better place.
class Mover {
 public:
  Mover(Workbench& bench, Index v, std::span<const Index> ball, const SmoothRule& rule)
      : mesh_(bench.mesh),
        sampler_(bench.sampler),
        rule_(rule),
        vertex_(mesh_.vertices[v]),
        ball_(ball) {
    for (const Index c : ball_) {
      const double q = mesh_.cells[c].quality3;
      worst_ = std::min(worst_, q);
      energy_ += energy(q);
    }
    find_directions(v);
  }

  bool run() { return descend(to_ideal_) || descend(along_gradient()); }

 private:
  static constexpr int kMostTrials = 4;

  double least_gain() const { return (1 - rule_.energy_ratio) * energy_; }

  /// Towards the mean of the ideal positions, bad cells weighing more; and the gradient.
  void find_directions(Index v) {
    const InverseFactor inverse(vertex_.metric);
    Vec3 sum;
    double weights = 0;
    for (const Index c : ball_) {
      const double q = mesh_.cells[c].quality3;
      const OppositeFace face = opposite_face(mesh_, mesh_.cells[c], v);
      const double weight = 1 / std::max(std::sqrt(q), 1e-4);
      sum += weight * ideal_position(face, inverse);
      weights += weight;
      gradient_ += energy_gradient(face, vertex_, q);
    }
    to_ideal_ = 1 / weights * sum - vertex_.position;
  }

  /// Down the gradient in the metric, by a fifth of an edge at first.
  Vec3 along_gradient() const {
    constexpr double kFirstStep = 0.2;
    const InverseFactor inverse(vertex_.metric);
    const Vec3 direction =
        on_planes(-inverse.apply_transposed(inverse.apply(on_planes(gradient_))));
    const double length = std::sqrt(squared_length(vertex_.metric, direction));
    return length > 0 ? kFirstStep / length * direction : Vec3{};
  }

  Vec3 on_planes(Vec3 move) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (vertex_.mask >> (2 * axis) & 3) move[axis] = 0;
    }
    return move;
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
        accept();
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
    vertex_.position = old.position + move;
    if (!is_inside(mesh_.box, vertex_.position) ||
        planes_of(mesh_.box, vertex_.position) != old.mask) {
      return kTooBad;
    }
    measure(vertex_, sampler_, old.hint);
    double sum = 0;
    for (std::size_t i = 0; i < ball_.size(); ++i) {
      const double q = quality3(mesh_, mesh_.cells[ball_[i]].points);
      if (q <= rule_.quality3_loss * worst_) return kTooBad;
      sum += energy(q);
      qualities_[i] = q;
    }
    return sum;
  }

  void accept() {
    for (std::size_t i = 0; i < ball_.size(); ++i) {
      WorkCell& cell = mesh_.cells[ball_[i]];
      cell.quality3 = static_cast<float>(qualities_[i]);
      cell.pending = kToAll;
      cell.tried = 0;
    }
  }

  static constexpr double kTooBad = std::numeric_limits<double>::infinity();

  WorkingMesh& mesh_;
  const MetricSampler& sampler_;
  const SmoothRule& rule_;
  Vertex& vertex_;
  std::span<const Index> ball_;
  double worst_ = 1, energy_ = 0;
  Vec3 to_ideal_, gradient_;
  std::array<double, Cavity::kMostBall> qualities_;
};

}  // namespace

bool smooth_vertex(Workbench& bench, Index v, const SmoothRule& rule) {
  const std::uint8_t mask = bench.mesh.vertices[v].mask;
  if ((mask & kFrozen) || std::popcount(unsigned{mask}) == 3) return false;
  const auto ball = bench.cavity.ball(v);
  return !ball.empty() && Mover(bench, v, ball, rule).run();
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

}  // namespace mesamis::remeshing
