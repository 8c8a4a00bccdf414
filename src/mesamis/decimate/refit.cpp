// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/refit.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "mesamis/base/each_once.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/single_precision.h"
#include "mesamis/decimate/crease.h"
#include "mesamis/decimate/interface_trees.h"
#include "mesamis/decimate/normal_moves.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/half_edges.h"
#include "mesamis/surface/measure.h"
#include "mesamis/surface/normals.h"
#include "mesamis/surface/self_intersections.h"

namespace mesamis::detail::decimate {
namespace {

/// Cosine between the triangles of a sharp edge, 40 degrees, and of a flat part.
constexpr double kSharp = 0.766, kFlat = 1 - 1e-9;
/// Cosine by which a triangle may turn.
constexpr double kTurn = 0.9;
/// Of the tolerance: no point moves farther.
constexpr double kFarthest = 0.7;
/// Of the tolerance: searches may take no place nearer than this for one that is too far.
constexpr double kProved = 0.997;
constexpr int kHalvings = 3, kMostChecks = 9;
constexpr std::size_t kTrianglesInBlock = 256, kPointsInBlock = 512;

std::vector<Vec3> triangle_normals(const TriMesh& surface) {
  std::vector<Vec3> normals(surface.triangles.size());
  parallel_for(normals.size(), [&](std::size_t t) {
    normals[t] = unit_normal(corners_of(surface, surface.triangles[t]));
  });
  return normals;
}

/// The pairs of triangles that share an edge which no third one has.
std::vector<TrianglePair> triangles_at_edges(const TriMesh& surface) {
  std::vector<TrianglePair> pairs;
  const auto half_edges = sorted_half_edges(surface.triangles, surface.points.size());
  for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
    if (edge.size() == 2) pairs.push_back({edge[0].triangle, edge[1].triangle});
  });
  return pairs;
}

class Refit {
 public:
  /// @param count  of interfaces; each has a triangle of both surfaces.
  Refit(SplitSurface decimated, const SplitSurface& original, std::size_t count, double tolerance)
      : start_(std::move(decimated)),
        original_(original),
        count_(count),
        tolerance_(tolerance),
        to_original_(original, count),
        normals_(triangle_normals(start_.surface)),
        pairs_(triangles_at_edges(start_.surface)) {}

  /// @param before  what was proved of the triangles before any move; without originals: nothing.
  /// @param report  as of refit().
  TriMesh run(const Cover& before, DecimateReport* report) {
    up_ = vertex_normals(start_.surface);
    const std::vector<HeightSample> samples = sampled();
    moves_ = normal_moves({start_.surface, up_, points_that_stay()}, samples);
    for (const HeightSample& sample : samples) nearest_.push_back(sample.triangle);
    const double most = kFarthest * tolerance_;
    moved_ = start_;
    changed_.assign(moves_.size(), 0);
    result_bounds_.assign(normals_.size(), 0);
    original_bounds_.assign(original_.surface.triangles.size(), 0);
    for (std::size_t p = 0; p < moves_.size(); ++p) move(p, std::clamp(moves_[p], -most, most));
    keep_shapes(changed_);
    prove_by_moves(before);
    SelfIntersections meeting(moved_.surface);
    for (int round = 0; round < kMostChecks; ++round) {
      const std::vector<char> at_fault = corners_out_of_place(meeting, round == 0);
      changed_.assign(changed_.size(), 0);
      const std::vector<char> drawn = draw_back(at_fault, round == 0 ? 0 : kHalvings);
      if (drawn.empty()) {
        if (report) measure(*report);
        return std::move(moved_.surface);
      }
      keep_shapes(drawn);
    }
    return std::move(start_.surface);
  }

 private:
  /// Points of sharp edges, of flat parts, and where interfaces meet.
  std::vector<char> points_that_stay() const {
    const std::vector<Index> interface = interfaces_of_points(start_);
    std::vector<std::vector<Index>> around(interface.size());
    for (Index t = 0; t < std::ssize(normals_); ++t) {
      for (const Index p : start_.surface.triangles[t]) around[p].push_back(t);
    }
    std::vector<char> stays(around.size());
    for (std::size_t p = 0; p < around.size(); ++p) {
      if (interface[p] == kNoIndex) stays[p] = 1;
      for (std::size_t i = 0; i < around[p].size() && stays[p] == 0; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const double c = dot(normals_[around[p][i]], normals_[around[p][j]]);
          if (c < kSharp || c > kFlat) stays[p] = 1;
        }
      }
    }
    return stays;
  }

  /// What each original point says: a third of the area of its triangles is its weight. Those where
  /// interfaces meet say nothing.
  std::vector<HeightSample> sampled() const {
    const InterfaceTrees to_start(start_, count_);
    const std::vector<Index> interface = interfaces_of_points(original_);
    const TriMesh& original = original_.surface;
    std::vector<HeightSample> samples(interface.size());
    parallel_blocks(samples.size(), kPointsInBlock, [&](std::size_t begin, std::size_t end) {
      std::vector<std::size_t> hints = to_start.hints();
      for (std::size_t p = begin; p < end; ++p) {
        const Index own = interface[p];
        if (own == kNoIndex) continue;
        const Vec3& x = original.points[p];
        const TriangleTree& tree = to_start.tree(own);
        tree.squared_distance_to(x, hints[own]);
        const Corners& t = tree.triangle(hints[own]);
        const std::array<double, 3> place = nearest_place(x, t);
        const Vec3 q = place[0] * t[0] + place[1] * t[1] + place[2] * t[2];
        samples[p] = {to_start.index_of(own, hints[own]), place, dot(x - q, unit_normal(t)), 0};
      }
    });
    for (std::size_t t = 0; t < original.triangles.size(); ++t) {
      const double third = triangle_area(original, t) / 3;
      for (const Index p : original.triangles[t]) samples[p].weight += third;
    }
    return samples;
  }

  void move(std::size_t p, double move) {
    if (move == 0 && moves_[p] == 0) return;
    const Vec3& from = start_.surface.points[p];
    moves_[p] = move;
    moved_.surface.points[p] = move == 0 ? from : rounded(from + move * up_[p]);
    changed_[p] = 1;
  }

  /// Halves the moves of points, or takes them back once they have been halved so often.
  /// @return of each point 1 if it has changed; empty: none.
  std::vector<char> draw_back(const std::vector<char>& chosen, int times) {
    std::vector<char> drawn(moves_.size(), 0);
    bool any = false;
    for (std::size_t p = 0; p < moves_.size(); ++p) {
      if (chosen[p] == 0 || moves_[p] == 0) continue;
      move(p, times < kHalvings ? 0.5 * moves_[p] : 0);
      drawn[p] = 1;
      any = true;
    }
    return any ? drawn : std::vector<char>{};
  }

  /// Draws back what has turned triangles or bent them at a crease. These are most of all faults, and
  /// seen at once; distances are searched for when none is left.
  void keep_shapes(std::vector<char> changed) {
    for (int times = 0; !changed.empty(); ++times) {
      changed = draw_back(
          corners_of_all(misshapen(triangles_at(moved_.surface.triangles, changed))), times);
    }
  }

  std::vector<char> corners_of_all(const std::vector<char>& triangles) const {
    std::vector<char> corners(moves_.size(), 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (triangles[t] == 0) continue;
      for (const Index p : moved_.surface.triangles[t]) corners[p] = 1;
    }
    return corners;
  }

  /// Of each triangle 1 if it has turned or bends at a crease.
  std::vector<char> misshapen(const std::vector<Index>& touched) {
    std::vector<char> is_touched(normals_.size(), 0), at_fault = is_touched;
    if (normals_now_.empty()) normals_now_ = normals_;
    for (const Index t : touched) {
      is_touched[t] = 1;
      normals_now_[t] = unit_normal(corners_of(moved_.surface, moved_.surface.triangles[t]));
      if (dot(normals_now_[t], normals_[t]) < kTurn) at_fault[t] = 1;
    }
    for (const auto& [a, b] : pairs_) {
      if (is_touched[a] + is_touched[b] == 0) continue;
      const double now = dot(normals_now_[a], normals_now_[b]);
      if (makes_crease(dot(normals_[a], normals_[b]), now)) at_fault[a] = at_fault[b] = 1;
    }
    return at_fault;
  }

  /// What decimation proved, and the moves: no point of a triangle moves farther than its corners.
  void prove_by_moves(const Cover& before) {
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    result_proofs_.assign(normals_.size(), kUnknown);
    original_proofs_.assign(original_bounds_.size(), before.originals.empty() ? kUnknown : 0);
    for (std::size_t t = 0; t < before.originals.size(); ++t) {
      double moved = 0;
      for (const Index p : start_.surface.triangles[t]) {
        moved = std::max(moved, norm(moved_.surface.points[p] - start_.surface.points[p]));
      }
      result_proofs_[t] = before.to_originals[t] + moved;
      for (const Index o : before.originals[t]) {
        original_proofs_[o] = std::max(original_proofs_[o], before.from_originals[t] + moved);
      }
    }
  }

  /// Whether no search could find it too far.
  bool is_near(double proof) const { return proof <= kProved * tolerance_; }

  /// Where points have changed: the corners of triangles that meet others or are too far from the
  /// original, and of those nearest to what is too far of that.
  std::vector<char> corners_out_of_place(SelfIntersections& meeting, bool all) {
    const std::vector<Index> touched = triangles_at(moved_.surface.triangles, changed_);
    std::vector<char> at_fault(moved_.surface.triangles.size(), 0);
    parallel_blocks(touched.size(), kTrianglesInBlock, [&](std::size_t begin, std::size_t end) {
      std::vector<std::size_t> hints = to_original_.hints();
      for (std::size_t n = begin; n < end; ++n) {
        const Index t = touched[n];
        const Corners now = corners_of(moved_.surface, moved_.surface.triangles[t]);
        result_bounds_[t] = all && is_near(result_proofs_[t])
                                ? result_proofs_[t]
                                : bound(now, to_original_, moved_.interface[t], hints);
        if (result_bounds_[t] > tolerance_) at_fault[t] = 1;
      }
    });
    const std::vector<Index> near = all ? originals_without_proof() : originals_near(touched);
    for (const Index t : nearest_to_what_is_far(near)) at_fault[t] = 1;
    for (const TrianglePair& pair : all ? meeting.all() : meeting.after_move_of(touched)) {
      for (const Index t : pair) at_fault[t] = 1;
    }
    return corners_of_all(at_fault);
  }

  std::vector<Index> originals_without_proof() {
    std::vector<Index> open;
    for (Index o = 0; o < std::ssize(original_proofs_); ++o) {
      original_bounds_[o] = original_proofs_[o];
      if (!is_near(original_proofs_[o])) open.push_back(o);
    }
    return open;
  }

  /// Of the distance of a triangle from an interface; above the tolerance where a point is farther.
  double bound(const Corners& triangle, const InterfaceTrees& trees, Index interface,
               std::vector<std::size_t>& hints) const {
    return farthest_distance(triangle, trees.tree(interface), {tolerance_, tolerance_},
                             hints[interface]);
  }

  /// The originals that may be near what is touched, increasing.
  std::vector<Index> originals_near(const std::vector<Index>& touched) const {
    // No point has moved by more than the tolerance, nor did an original reach farther before.
    const double reach = 3 * tolerance_;
    std::vector<Index> near = parallel_collect<Index>(
        touched.size(), kTrianglesInBlock, [&](std::size_t begin, std::size_t end, auto& found) {
          for (std::size_t n = begin; n < end; ++n) {
            Box box =
                bounding_box(corners_of(moved_.surface, moved_.surface.triangles[touched[n]]));
            box.lo = box.lo - Vec3{reach, reach, reach};
            box.hi = box.hi + Vec3{reach, reach, reach};
            const Index own = moved_.interface[touched[n]];
            to_original_.tree(own).for_each_overlap(
                box, [&](std::size_t t) { found.push_back(to_original_.index_of(own, t)); });
          }
        });
    sort_once(near);
    return near;
  }

  /// Of originals those that no moved triangle nearest to one of their corners is near to as a whole:
  /// most are, and need no search.
  std::vector<Index> originals_to_search_for(const std::vector<Index>& originals) {
    return parallel_collect<Index>(
        originals.size(), kTrianglesInBlock, [&](std::size_t begin, std::size_t end, auto& found) {
          for (std::size_t n = begin; n < end; ++n) {
            const Triangle& k = original_.surface.triangles[originals[n]];
            double& least = original_bounds_[originals[n]] =
                std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < 3 && least > tolerance_; ++i) {
              if (nearest_[k[i]] != kNoIndex) {
                least = farthest_corner(corners_of(original_.surface, k), nearest_[k[i]]);
              }
            }
            if (least > tolerance_) found.push_back(originals[n]);
          }
        });
  }

  double farthest_corner(const Corners& original, Index moved) const {
    const Corners t = corners_of(moved_.surface, moved_.surface.triangles[moved]);
    double greatest = 0;
    for (const Vec3& p : original) greatest = std::max(greatest, squared_distance(p, t));
    return std::sqrt(greatest);
  }

  /// Of the originals given, the triangles nearest to the corners of those that are too far.
  std::vector<Index> nearest_to_what_is_far(const std::vector<Index>& originals) {
    const std::vector<Index> open = originals_to_search_for(originals);
    if (open.empty()) return {};
    to_moved_.emplace(moved_, count_);
    return parallel_collect<Index>(
        open.size(), kTrianglesInBlock, [&](std::size_t begin, std::size_t end, auto& found) {
          std::vector<std::size_t> hints = to_moved_->hints();
          for (std::size_t n = begin; n < end; ++n) {
            const Index t = open[n];
            const Triangle& k = original_.surface.triangles[t];
            original_bounds_[t] =
                bound(corners_of(original_.surface, k), *to_moved_, original_.interface[t], hints);
            if (original_bounds_[t] <= tolerance_) continue;
            for (const Index p : k) {
              if (nearest_[p] != kNoIndex) found.push_back(nearest_[p]);
            }
          }
        });
  }

  void measure(DecimateReport& report) {
    if (!to_moved_) to_moved_.emplace(moved_, count_);
    report.original_to_result =
        greatest_distance(original_, *to_moved_, report.original_to_result, original_bounds_);
    report.result_to_original =
        greatest_distance(moved_, to_original_, report.result_to_original, result_bounds_);
  }

  /// The greatest distance of a triangle, from bounds that are kept of each: most are below it.
  double greatest_distance(const SplitSurface& from, const InterfaceTrees& to, double proved,
                           const std::vector<double>& bounds) const {
    std::vector<Index> order;
    for (Index t = 0; t < std::ssize(bounds); ++t) {
      if (bounds[t] > proved) order.push_back(t);
    }
    std::sort(order.begin(), order.end(), [&bounds](Index a, Index b) {
      return std::pair{-bounds[a], a} < std::pair{-bounds[b], b};
    });
    std::vector<std::size_t> hints = to.hints();
    double greatest = proved;
    for (const Index t : order) {
      if (bounds[t] <= greatest) break;
      const Index own = from.interface[t];
      greatest =
          std::max(greatest, farthest_distance(corners_of(from.surface, from.surface.triangles[t]),
                                               to.tree(own), {greatest}, hints[own]));
    }
    return greatest;
  }

  SplitSurface start_, moved_;
  const SplitSurface& original_;
  std::size_t count_;
  double tolerance_;
  InterfaceTrees to_original_;
  std::vector<Vec3> normals_;      // of the triangles, before any move
  std::vector<Vec3> normals_now_;  // once points have moved
  std::vector<TrianglePair> pairs_;
  std::vector<Index> nearest_;  // to each original point, the triangle before any move
  std::vector<Vec3> up_;        // of each point, before any move
  std::vector<double> moves_;   // along it, mm
  std::vector<double> result_proofs_, original_proofs_;  // of triangles, without a search, mm
  std::vector<double> result_bounds_, original_bounds_;  // of triangles that were looked at, mm
  std::optional<InterfaceTrees> to_moved_;               // as it was then
  std::vector<char> changed_;  // of each point 1 if it has moved since the last search
};

}  // namespace

TriMesh refit(TriMesh decimated, const TriMesh& original, double tolerance,
              DecimateReport* report) {
  return refit(unproved(std::move(decimated)), original, tolerance, report);
}

TriMesh refit(Cover decimated, const TriMesh& original, double tolerance, DecimateReport* report) {
  TriMesh surface{std::move(decimated.points), std::move(decimated.triangles)};
  if (surface.triangles.empty()) return surface;
  const SplitSurface whole{original, std::vector<Index>(original.triangles.size(), 0)};
  std::vector<Index> interface(surface.triangles.size(), 0);
  return Refit({std::move(surface), std::move(interface)}, whole, 1, tolerance)
      .run(decimated, report);
}

PartitionSurface refit_partition(PartitionSurface decimated, const PartitionSurface& original,
                                 double tolerance) {
  if (decimated.sides.size() != decimated.triangles.size() ||
      original.sides.size() != original.triangles.size()) {
    throw InputError("refit: expected a pair of sides for each triangle");
  }
  if (decimated.triangles.empty()) return decimated;
  std::map<std::array<Index, 2>, Index> numbers;
  const auto numbered = [&](const PartitionSurface& partition) {
    std::vector<Index> interface;
    interface.reserve(partition.sides.size());
    for (const auto& sides : partition.sides) {
      interface.push_back(
          numbers.try_emplace(sides, static_cast<Index>(numbers.size())).first->second);
    }
    return interface;
  };
  std::vector<Index> interface = numbered(decimated);
  const std::size_t count = numbers.size();
  const SplitSurface whole{{original.points, original.triangles}, numbered(original)};
  if (numbers.size() != count) throw InputError("refit: expected a triangle of each interface");
  TriMesh surface = Refit({taken_from(decimated), std::move(interface)}, whole, count, tolerance)
                        .run({}, nullptr);
  return put_back(std::move(surface), std::move(decimated));
}

}  // namespace mesamis::detail::decimate
