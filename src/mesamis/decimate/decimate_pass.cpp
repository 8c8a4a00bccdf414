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
#include "mesamis/decimate/curves.h"
#include "mesamis/decimate/fan_height.h"
#include "mesamis/decimate/flip.h"
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

std::optional<Curves> curves_of(const DecimateTask& task, const Patch& patch) {
  if (!task.interfaces) return std::nullopt;
  return Curves(*task.interfaces, patch);
}

class Pass {
 public:
  Pass(const DecimateTask& task, const Patch& patch)
      : task_(task),
        points_(patch.cover.points),
        held_(patch.held),
        surface_(points_.size(), patch.cover.triangles),
        curves_(curves_of(task, patch)),
        intersections_(surface_, points_, curves_ ? curves_->first_copies() : std::vector<Index>{}),
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
    for (Index t = 0; t < surface_.count(); ++t) add_triangle(t);
    if (curves_) add_curves();
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
      if (bound_ && round == 0) any |= flip_edges();
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

  /// The lines of the curves, for each point by its first copy.
  void add_curves() {
    lines_.resize(points_.size());
    for (Index h = 0; h < 3 * surface_.count(); ++h) {
      if (!is_at_curve(h) || first_at_curve(h) != h) continue;
      const Vec3 &a = points_[surface_.from(h)], &b = points_[surface_.to(h)];
      const Vec3 way = b - a;
      for (const Index p : {surface_.from(h), surface_.to(h)}) {
        lines_[curves_->first_copies()[p]].add_line(a - origin_, unit_or_zero(way),
                                                    dot(way, way) / 6);
      }
    }
  }

  /// Whether an edge lies at a curve along which it may be collapsed.
  bool is_at_curve(Index h) const {
    return curves_ && !surface_.is_removed(h / 3) && surface_.opposite(h) == kNoIndex &&
           (curves_->may_go(surface_.from(h)) || curves_->may_go(surface_.to(h)));
  }

  /// Of the half-edges at an edge of a curve the one that stands for all.
  Index first_at_curve(Index h) const { return curves_->half_edges_at(surface_, h).front(); }

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
    std::vector<Index>& at_curves = at_curves_;
    at_curves.clear();
    for (const Index h : half_edges) {
      const Index o = surface_.opposite(h);
      if (o != kNoIndex && o > h) push(h);
      if (is_at_curve(h)) at_curves.push_back(first_at_curve(h));
    }
    sort_once(at_curves);
    for (const Index h : at_curves) push(h);
  }

  void push(Index h) {
    const Edge edge = edge_at(h);
    const std::optional<Vec3> place = place_of(edge);
    if (!place) return;
    const double squares = std::max(edge.quadric.at(*place - origin_), 0.0);
    if (squares > hopeless_ * edge.quadric.weight) return;
    const Vec3 way = points_[edge.a] - points_[edge.b];
    const double error = squares + kShortFirst * edge.quadric.weight * dot(way, way);
    queue_.push({error, h, edge.a, edge.b, stamps_[edge.a], stamps_[edge.b]});
  }

  using Planes = std::array<bool, 3>;  // of the axes

  /// An edge that may be collapsed. Of a curve: what all interfaces there have to say.
  struct Edge {
    Index a, b;
    bool a_stays, b_stays;
    Planes a_planes, b_planes;
    Quadric quadric;  ///< of both ends
  };

  Edge edge_at(Index h) const {
    const Index a = surface_.from(h), b = surface_.to(h);
    if (surface_.opposite(h) != kNoIndex) {
      Edge edge{a, b, !may_move(a), !may_move(b), planes_[a], planes_[b], quadrics_[a]};
      edge.quadric += quadrics_[b];
      return edge;
    }
    Edge edge{a, b, !curves_->may_go(a), !curves_->may_go(b), {}, {}, {}};
    const auto see = [this, &edge](Index p, Planes& planes) {
      edge.quadric += lines_[curves_->first_copies()[p]];
      curves_->for_each_copy(p, [&](Index copy) {
        edge.quadric += quadrics_[copy];
        for (std::size_t axis = 0; axis < 3; ++axis) planes[axis] |= planes_[copy][axis];
      });
    };
    see(a, edge.a_planes);
    see(b, edge.b_planes);
    return edge;
  }

  bool is_hopeless(const Quadric& q, const Vec3& place) const {
    return q.at(place - origin_) > hopeless_ * q.weight;
  }

  /// Which of the axis planes that one point keeps to, the other does not.
  bool keeps_more(const Planes& a, const Planes& b) const {
    bool more = false;
    if (relaxed_) return false;
    for (std::size_t axis = 0; axis < 3; ++axis) more |= a[axis] && !b[axis];
    return more;
  }

  /// Where the edge's points go: none if neither may.
  std::optional<Vec3> place_of(const Edge& edge) const {
    const Vec3 &a = points_[edge.a], &b = points_[edge.b];
    const bool to_a = edge.a_stays || keeps_more(edge.a_planes, edge.b_planes),
               to_b = edge.b_stays || keeps_more(edge.b_planes, edge.a_planes);
    if (to_a && to_b) return std::nullopt;
    if (to_a) return a;
    if (to_b) return b;
    for (int axis = 0; axis < 3; ++axis) {
      if (!relaxed_ && edge.a_planes[static_cast<std::size_t>(axis)] && a[axis] != b[axis]) {
        return std::nullopt;
      }
    }
    const Quadric& q = edge.quadric;
    const double at_a = q.at(a - origin_), at_b = q.at(b - origin_);
    const Vec3 better = at_a < at_b ? a : b;
    // Where it is flat, points that are there lie better than new ones, which are rounded.
    const Vec3 way = a - b;
    if (std::min(at_a, at_b) < kFlat * q.weight * dot(way, way)) return better;
    const Vec3 middle = 0.5 * (a + b) - origin_;
    return rounded(minimum(q, middle, kPull, relaxed_ ? Planes{} : edge.a_planes) + origin_);
  }

  bool may_move(Index p) const { return held_[p] == 0 && surface_.is_inner(p); }

  /// Whether two points would get a second edge: of other interfaces, or beyond a point at which this
  /// one touches itself.
  bool joins_twice(const Collapse& collapse) const {
    if (!curves_) return false;
    const Index left = surface_.from(EditableSurface::previous(collapse.half_edge)),
                right = surface_.to(EditableSurface::next(surface_.opposite(collapse.half_edge)));
    bool joins = false;
    surface_.for_each_leaving(collapse.removed, [&](Index h) {
      const Index q = surface_.to(h);
      joins |= q != collapse.kept && q != left && q != right &&
               !curves_->may_join(surface_, collapse.kept, q);
    });
    return joins;
  }

  /// Collapses an edge to the best place, half of the way from there to its middle, or onto one of its
  /// ends, if that is allowed: beyond a bend, the best place is outside of it.
  bool try_to(Index h) {
    const Edge edge = edge_at(h);
    const std::optional<Vec3> place = place_of(edge);
    if (!place) return false;
    const Vec3 from = points_[edge.a], to = points_[edge.b];
    const bool is_new = *place != from && *place != to;
    if (may_become(h, edge, *place) && become()) return true;
    if (!bound_ && !relaxed_) return false;  // another end would cost more
    if ((!relaxed_ && edge.a_planes != edge.b_planes) || edge.a_stays || edge.b_stays) return false;
    const Vec3 first = *place == to ? from : to, second = first == to ? from : to;
    const Vec3 between = rounded(0.5 * *place + 0.25 * (from + to));
    const auto may_go_to = [&](const Vec3& other) {
      return other != *place && !is_hopeless(edge.quadric, other) && may_become(h, edge, other) &&
             become();
    };
    return (is_new && may_go_to(between)) || may_go_to(first) || may_go_to(second);
  }

  /// Whether the shapes of the triangles allow a collapse to a place.
  bool may_become(Index h, const Edge& edge, const Vec3& place) {
    // The point that goes is one that may.
    const bool b_goes = edge.a_stays || place == points_[edge.a];
    if (surface_.opposite(h) == kNoIndex) return may_become_at_curve(h, b_goes, place);
    if (b_goes) h = surface_.opposite(h);
    if (!surface_.may_collapse(h)) return false;
    collapses_.resize(1);
    describe(surface_, points_, h, place, collapses_[0]);
    if (joins_twice(collapses_[0]) || spoils_shape(collapses_[0])) return false;
    return !curves_ || !bound_ || !bends_curve(surface_, normals_, *curves_, collapses_[0]);
  }

  bool may_become_at_curve(Index h, bool b_goes, const Vec3& place) {
    const Index removed = b_goes ? surface_.to(h) : surface_.from(h);
    const std::vector<Index> half_edges = curves_->half_edges_at(surface_, h);
    if (left_ - std::ssize(half_edges) + 2 < task_.triangles)
      return false;  // too few would be left
    if (!curves_->may_collapse(surface_, half_edges, removed)) return false;
    collapses_.resize(half_edges.size());
    for (std::size_t n = 0; n < half_edges.size(); ++n) {
      describe_at_rim(surface_, points_, half_edges[n],
                      curves_->copy_at(surface_, half_edges[n], removed), place, collapses_[n]);
      if (spoils_shape(collapses_[n])) return false;
    }
    return !bound_ ||
           !(spoils_curve(surface_, points_, normals_, collapses_) ||
             std::any_of(collapses_.begin(), collapses_.end(), [this](const Collapse& c) {
               return bends_curve(surface_, normals_, *curves_, c);
             }));
  }

  bool spoils_shape(const Collapse& collapse) const {
    return decimate::spoils_shape(surface_, points_, normals_, collapse, bound_.has_value());
  }

  /// Makes the collapse that was looked at last if all else allows it.
  bool become() {
    for (Collapse& collapse : collapses_) {
      collapse.height = fan_height(surface_, points_, collapse);
      if (bound_ && !bound_->allows(surface_, points_, collapse)) return false;
    }
    if (intersections_.occur(surface_, points_, collapses_)) return false;
    apply();
    return true;
  }

  void apply() {
    std::vector<Index>& around = scratch_;
    around.clear();
    const bool at_curve = collapses_[0].at_rim;
    if (at_curve) {
      const auto& first = curves_->first_copies();
      lines_[first[collapses_[0].kept]] += lines_[first[collapses_[0].removed]];
    }
    for (const Collapse& collapse : collapses_) {
      // Of several interfaces each has its own proof, of which only the last is at hand: it is
      // found again, for the others change nothing in this one.
      if (bound_ && at_curve) bound_->allows(surface_, points_, collapse);
      apply(collapse);
      surface_.for_each_edge_at(collapse.kept, [&](Index h, Index neighbor) {
        for (const Index k : {h, surface_.opposite(h)}) {
          if (k != kNoIndex) around.push_back(k);
        }
        wake(neighbor);
      });
    }
    push(around);
  }

  void apply(const Collapse& collapse) {
    if (bound_) bound_->apply(collapse);
    quadrics_[collapse.kept] += quadrics_[collapse.removed];
    if (collapse.at_rim) {
      surface_.collapse_at_rim(collapse.half_edge, collapse.removed);
    } else {
      surface_.collapse(collapse.half_edge);
    }
    points_[collapse.kept] = collapse.place;
    intersections_.apply(collapse);
    for (std::size_t i = 0; i < collapse.faces.size(); ++i) {
      normals_[collapse.faces[i]] = unit_normal(collapse.after[i]);
    }
    left_ -= collapse.at_rim ? 1 : 2;
    ++stamps_[collapse.removed];
    ++stamps_[collapse.kept];
  }

  /// Flips edges where that makes the surface smoother: then more can be collapsed.
  bool flip_edges() {
    bool any = false;
    for (Index h = 0; h < 3 * surface_.count(); ++h) any |= may_flip(h) && flip(h);
    return any;
  }

  /// Whether two points keep to the same plane, as where the box of a scan cuts the object.
  bool are_on_a_plane(Index a, Index b) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int i = static_cast<int>(axis);
      if (planes_[a][axis] && planes_[b][axis] && points_[a][i] == points_[b][i]) return true;
    }
    return false;
  }

  /// Each edge is looked at by one of its half-edges. Triangles at rims stay.
  bool may_flip(Index h) const {
    if (surface_.is_removed(h / 3)) return false;
    const Index o = surface_.opposite(h);
    if (o == kNoIndex || o < h || bound_->stays(h / 3) || bound_->stays(o / 3)) return false;
    for (const Index k : {h, o}) {
      if (surface_.opposite(EditableSurface::next(k)) == kNoIndex ||
          surface_.opposite(EditableSurface::previous(k)) == kNoIndex) {
        return false;
      }
    }
    const Index left = surface_.from(EditableSurface::previous(h)),
                right = surface_.from(EditableSurface::previous(o));
    // Other patches may have an edge between points that both have.
    if (held_[left] != 0 && held_[right] != 0) return false;
    if (are_on_a_plane(surface_.from(h), surface_.to(h)) || are_on_a_plane(left, right))
      return false;
    return (!curves_ || curves_->may_join(surface_, left, right)) && surface_.may_flip(h);
  }

  bool flip(Index h) {
    const Flip flip = describe_flip(surface_, points_, h);
    if (!smooths(surface_, points_, normals_, flip)) return false;
    surface_.flip(h);
    if (intersections_.occur(surface_, points_, flip) || !bound_->allows(surface_, flip)) {
      surface_.flip_back(h);
      return false;
    }
    bound_->apply(flip);
    intersections_.apply(flip);
    for (std::size_t i = 0; i < flip.faces.size(); ++i) {
      normals_[flip.faces[i]] = unit_normal(flip.after[i]);
      for (const Index p : surface_.triangle(flip.faces[i])) wake(p);
    }
    return true;
  }

  void wake(Index p) {
    if (is_woken_[p] == 0) woken_.push_back(p);
    is_woken_[p] = 1;
  }

  void push_woken() {
    std::vector<Index> around;
    for (const Index p : woken_) {
      is_woken_[p] = 0;
      surface_.for_each_edge_at(p, [&](Index h, Index) {
        const Index o = surface_.opposite(h);
        around.push_back(o != kNoIndex ? std::min(h, o) : h);
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
  std::optional<Curves> curves_;  // of interfaces
  CollapseIntersections intersections_;
  std::optional<TwoSidedBound> bound_;
  std::vector<Index> stamps_, woken_;
  std::vector<char> is_woken_;
  std::vector<Planes> planes_;     // that each point keeps to
  std::vector<Quadric> quadrics_;  // of the triangles at each point, relative to the origin
  std::vector<Quadric> lines_;     // of the curve at each point, by its first copy
  std::vector<Vec3> normals_;      // of triangles
  Vec3 origin_;
  double hopeless_;  // mean square distance, mm^2
  std::int64_t left_;
  bool relaxed_ = false;  // without a tolerance, once nothing else can be done: ends that cost more
                          // are taken, and planes left
  std::priority_queue<Candidate> queue_;
  std::vector<Collapse> collapses_;  // that are looked at: several at an edge of a curve
  std::vector<Index> scratch_, at_curves_;
};

}  // namespace

Cover decimate_pass(const DecimateTask& task, const Patch& patch) {
  Pass pass(task, patch);
  pass.run();
  return pass.cover();
}

}  // namespace mesamis::detail::decimate
