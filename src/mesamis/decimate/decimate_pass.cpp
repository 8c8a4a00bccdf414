// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/decimate_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <queue>
#include <tuple>

#include "mesamis/base/each_once.h"
#include "mesamis/base/single_precision.h"
#include "mesamis/decimate/collapse.h"
#include "mesamis/decimate/collapse_intersections.h"
#include "mesamis/decimate/fan_height.h"
#include "mesamis/decimate/quadric.h"
#include "mesamis/decimate/two_sided_bound.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis::detail::decimate {
namespace {

/// Weight, over that of the quadric, of the pull to the middle of an edge: it decides where the
/// surface is flat.
constexpr double kPull = 1e-3;
/// Where errors are equal, as on flat parts, short edges go first: weight of their squared length.
constexpr double kShortFirst = 1e-6;
/// Squared height over length up to which an edge lies on a flat part.
constexpr double kFlat = 1e-12;
/// Root mean square distance of a place from the planes that it stands for, over the tolerance: where
/// it is greater, hardly any collapse keeps the tolerance, and none is looked at.
constexpr double kHopeless = 1.3;
/// So often refused collapses are tried again where the surface has changed.
constexpr int kMostRounds = 12;

std::vector<Index> first_copies(const DecimateTask& task, const Patch& patch) {
  std::vector<Index> firsts;
  if (!task.interfaces) return firsts;
  for (Index p = 0; p < std::ssize(patch.points); ++p) {
    const bool is_copy =
        p > 0 && task.first_copy(patch.points[p]) == task.first_copy(patch.points[p - 1]);
    firsts.push_back(is_copy ? firsts.back() : p);
  }
  return firsts;
}

class Pass {
 public:
  Pass(const DecimateTask& task, const Patch& patch)
      : task_(task),
        points_(patch.cover.points),
        held_(patch.held),
        surface_(points_.size(), patch.cover.triangles),
        intersections_(surface_, points_, first_copies(task, patch)),
        stamps_(points_.size(), 0),
        is_woken_(points_.size(), 0),
        planes_(points_.size()),
        quadrics_(points_.size()),
        left_(surface_.count()) {
    if (std::isfinite(task.tolerance)) {
      bound_.emplace(task.surface, patch.cover, held_, task.tolerance);
    }
    hopeless_ = kHopeless * kHopeless * task.tolerance * task.tolerance;
    const Box box = bounding_box(points_);
    origin_ = 0.5 * (box.lo + box.hi);
    if (task.interfaces) {
      for (const Index p : patch.points) at_rim_.push_back(task.interfaces->at_rim[p]);
    }
    for (Index t = 0; t < surface_.count(); ++t) add_triangle(t);
  }

  void run() {
    push_all();
    const auto first = static_cast<double>(queue_.size());
    double done = 0;
    std::int64_t steps = 0;
    for (int round = 0; round < kMostRounds && left_ > task_.triangles; ++round) {
      bool any = false;
      while (left_ > task_.triangles && !queue_.empty()) {
        const Candidate next = queue_.top();
        queue_.pop();
        if (is_valid(next)) any |= try_to(next.half_edge);
        if (++steps % 4096 == 0) {
          done = std::max(done, 1 - static_cast<double>(queue_.size()) / first);
          task_.progress(std::min(done, 1.0));
        }
      }
      if (any) {
        push_woken();
      } else if (!bound_ && !relaxed_) {
        relaxed_ = true;
        push_all();
      } else {
        break;
      }
    }
  }

  Cover cover() const {
    Cover left;
    left.points = points_;
    for (Index t = 0; t < surface_.count(); ++t) {
      if (surface_.is_removed(t)) continue;
      left.triangles.push_back(surface_.triangle(t));
      left.originals.push_back(bound_ ? bound_->originals_of(t) : std::vector<Index>{});
      left.to_originals.push_back(bound_ ? bound_->to_originals_of(t) : 0);
      left.from_originals.push_back(bound_ ? bound_->from_originals_of(t) : 0);
    }
    return left;
  }

 private:
  struct Candidate {
    double error;
    Index half_edge, from, to, from_stamp, to_stamp;
    /// The smallest error comes out first.
    bool operator<(const Candidate& other) const {
      return std::tie(error, half_edge) > std::tie(other.error, other.half_edge);
    }
  };

  void add_triangle(Index t) {
    const Triangle k = surface_.triangle(t);
    const Corners c{points_[k[0]], points_[k[1]], points_[k[2]]};
    const Vec3 area = cross(c[1] - c[0], c[2] - c[0]);
    const Vec3 n = unit_or_zero(area);
    normals_.push_back(n);
    for (const Index p : k) quadrics_[p].add_plane(n, dot(n, c[0] - origin_), norm(area) / 6);
    for (int axis = 0; axis < 3; ++axis) {
      if (c[0][axis] != c[1][axis] || c[0][axis] != c[2][axis]) continue;
      for (const Index p : k) planes_[p][static_cast<std::size_t>(axis)] = true;
    }
  }

  bool is_valid(const Candidate& c) const {
    return stamps_[c.from] == c.from_stamp && stamps_[c.to] == c.to_stamp;
  }

  void push_all() {
    std::vector<Index> all;
    for (Index h = 0; h < 3 * surface_.count(); ++h) {
      if (!surface_.is_removed(h / 3)) all.push_back(h);
    }
    push(all);
  }

  void push(const std::vector<Index>& half_edges) {
    for (const Index h : half_edges) {
      const Index o = surface_.opposite(h);
      if (o == kNoIndex || o < h) continue;
      const std::optional<Vec3> place = place_of(h);
      if (!place) continue;
      const Quadric q = quadric_of(h);
      const double squares = std::max(q.at(*place - origin_), 0.0);
      if (squares > hopeless_ * q.weight) continue;
      const Index a = surface_.from(h), b = surface_.to(h);
      const Vec3 way = points_[a] - points_[b];
      const double error = squares + kShortFirst * q.weight * dot(way, way);
      queue_.push({error, h, a, b, stamps_[a], stamps_[b]});
    }
  }

  /// Of both ends of an edge.
  Quadric quadric_of(Index h) const {
    Quadric q = quadrics_[surface_.from(h)];
    q += quadrics_[surface_.to(h)];
    return q;
  }

  bool is_hopeless(Index h, const Vec3& place) const {
    const Quadric q = quadric_of(h);
    return q.at(place - origin_) > hopeless_ * q.weight;
  }

  /// Which of the axis planes that one point keeps to, the other does not.
  bool keeps_more(Index a, Index b) const {
    bool more = false;
    if (relaxed_) return false;
    for (std::size_t axis = 0; axis < 3; ++axis) more |= planes_[a][axis] && !planes_[b][axis];
    return more;
  }

  /// Where the edge's points go: none if neither may.
  std::optional<Vec3> place_of(Index h) const {
    const Index a = surface_.from(h), b = surface_.to(h);
    const bool a_stays = !may_move(a), b_stays = !may_move(b);
    const bool to_a = a_stays || keeps_more(a, b), to_b = b_stays || keeps_more(b, a);
    if (to_a && to_b) return std::nullopt;
    if (to_a) return points_[a];
    if (to_b) return points_[b];
    for (int axis = 0; axis < 3; ++axis) {
      if (!relaxed_ && planes_[a][static_cast<std::size_t>(axis)] &&
          points_[a][axis] != points_[b][axis]) {
        return std::nullopt;
      }
    }
    const Quadric q = quadric_of(h);
    const double at_a = q.at(points_[a] - origin_), at_b = q.at(points_[b] - origin_);
    const Vec3 better = at_a < at_b ? points_[a] : points_[b];
    // Where it is flat, points that are there lie better than new ones, which are rounded.
    const Vec3 way = points_[a] - points_[b];
    if (std::min(at_a, at_b) < kFlat * q.weight * dot(way, way)) return better;
    const Vec3 middle = 0.5 * (points_[a] + points_[b]) - origin_;
    return rounded(minimum(q, middle, kPull, relaxed_ ? std::array<bool, 3>{} : planes_[a]) +
                   origin_);
  }

  bool may_move(Index p) const { return held_[p] == 0 && surface_.is_inner(p); }

  bool joins_rims(const Collapse& collapse) const {
    if (at_rim_.empty() || at_rim_[collapse.kept] == 0) return false;
    const Index left = surface_.from(EditableSurface::previous(collapse.half_edge)),
                right = surface_.to(EditableSurface::next(surface_.opposite(collapse.half_edge)));
    bool joins = false;
    surface_.for_each_leaving(collapse.removed, [&](Index h) {
      const Index q = surface_.to(h);
      joins |= q != collapse.kept && q != left && q != right && at_rim_[q] != 0;
    });
    return joins;
  }

  /// Collapses an edge to the best place, or onto one of its ends, if that is allowed.
  bool try_to(Index h) {
    const std::optional<Vec3> place = place_of(h);
    if (!place) return false;
    const Vec3 from = points_[surface_.from(h)], to = points_[surface_.to(h)];
    const bool is_new = *place != from && *place != to;
    if (may_become(h, *place) && become()) return true;
    if (!bound_ && !relaxed_) return false;  // another end would cost more
    if ((!relaxed_ && planes_[surface_.from(h)] != planes_[surface_.to(h)]) ||
        !may_move(surface_.from(h)) || !may_move(surface_.to(h))) {
      return false;
    }
    const Vec3 first = *place == to ? from : to, second = first == to ? from : to;
    const auto may_go_to = [&](const Vec3& end) {
      return !is_hopeless(h, end) && may_become(h, end) && become();
    };
    return may_go_to(first) || (is_new && may_go_to(second));
  }

  /// Whether the shapes of the triangles allow a collapse to a place.
  bool may_become(Index h, const Vec3& place) {
    // The point that goes is one that may.
    const Index a = surface_.from(h);
    if (!may_move(a) || place == points_[a]) h = surface_.opposite(h);
    if (!surface_.may_collapse(h)) return false;
    describe(surface_, points_, h, place, collapse_);
    return !joins_rims(collapse_) &&
           !spoils_shape(surface_, points_, normals_, collapse_, bound_.has_value());
  }

  /// Makes the collapse that was looked at last if all else allows it.
  bool become() {
    collapse_.height = fan_height(surface_, points_, collapse_);
    if (bound_ && !bound_->allows(surface_, points_, collapse_)) return false;
    if (intersections_.occur(surface_, points_, collapse_)) return false;
    apply();
    return true;
  }

  void apply() {
    if (bound_) bound_->apply(collapse_);
    quadrics_[collapse_.kept] += quadrics_[collapse_.removed];
    surface_.collapse(collapse_.half_edge);
    points_[collapse_.kept] = collapse_.place;
    intersections_.apply(collapse_);
    for (std::size_t i = 0; i < collapse_.faces.size(); ++i) {
      normals_[collapse_.faces[i]] = unit_normal(collapse_.after[i]);
    }
    left_ -= 2;
    ++stamps_[collapse_.removed];
    ++stamps_[collapse_.kept];
    std::vector<Index>& around = scratch_;
    around.clear();
    surface_.for_each_leaving(collapse_.kept, [&](Index h) {
      for (const Index k : {h, surface_.opposite(h)}) {
        if (k != kNoIndex) around.push_back(k);
      }
      wake(surface_.to(h));
    });
    push(around);
  }

  void wake(Index p) {
    if (is_woken_[p] == 0) woken_.push_back(p);
    is_woken_[p] = 1;
  }

  void push_woken() {
    std::vector<Index> around;
    for (const Index p : woken_) {
      is_woken_[p] = 0;
      surface_.for_each_leaving(p, [&](Index h) {
        const Index o = surface_.opposite(h);
        if (o != kNoIndex) around.push_back(std::min(h, o));
      });
    }
    woken_.clear();
    sort_once(around);
    push(around);
  }

  const DecimateTask& task_;
  std::vector<Vec3> points_;
  const std::vector<char>& held_;
  EditableSurface surface_;
  CollapseIntersections intersections_;
  std::optional<TwoSidedBound> bound_;
  std::vector<Index> stamps_, woken_;
  std::vector<char> is_woken_, at_rim_;
  std::vector<std::array<bool, 3>> planes_;  // of the axes that each point keeps to
  std::vector<Quadric> quadrics_;            // relative to the origin
  std::vector<Vec3> normals_;                // of triangles
  Vec3 origin_;
  double hopeless_;  // mean square distance, mm^2
  std::int64_t left_;
  bool relaxed_ = false;  // without a tolerance, once nothing else can be done: ends that cost more
                          // are taken, and planes left
  std::priority_queue<Candidate> queue_;
  Collapse collapse_;
  std::vector<Index> scratch_;
};

}  // namespace

Cover decimate_pass(const DecimateTask& task, const Patch& patch) {
  Pass pass(task, patch);
  pass.run();
  return pass.cover();
}

}  // namespace mesamis::detail::decimate
