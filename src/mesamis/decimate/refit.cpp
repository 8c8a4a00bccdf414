// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/refit.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/decimate/single_places.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/normals.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis {
namespace {

/// Cosine between the triangles of a sharp edge, 40 degrees, and of a flat part.
constexpr double kSharp = 0.766, kFlat = 1 - 1e-9;
/// Cosine of a crease, 25 degrees: no edge may bend by more that did not bend as much before.
constexpr double kCrease = 0.9063;
/// Cosine by which a triangle may turn.
constexpr double kTurn = 0.9;
/// Against moves that the samples say little of, of the mean weight of a point.
constexpr double kPull = 0.02;
/// Of the tolerance: no point moves farther.
constexpr double kFarthest = 0.7;
constexpr double kRounding = 1e-6;  // of cosines
constexpr int kHalvings = 3, kMostChecks = 9;

/// The closest place of a triangle to a point, in its barycentric coordinates.
std::array<double, 3> closest_in(const Vec3& p, const Corners& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = p - t[1];
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const Vec3 cp = p - t[2];
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

Vec3 normal_of(const Corners& t) { return unit_or_zero(cross(t[1] - t[0], t[2] - t[0])); }

/// The triangles of one interface of a surface, and a search among them.
class Interface {
 public:
  /// @param chosen  triangles of the surface, at least one.
  Interface(const TriMesh& surface, std::vector<Index> chosen)
      : chosen_(std::move(chosen)), tree_(part(surface, chosen_)) {}

  const TriangleTree& tree() const { return tree_; }
  /// The triangle of the surface that a search ended at.
  Index index_of(std::size_t hint) const {
    return chosen_[static_cast<std::size_t>(tree_.index_of(hint))];
  }

 private:
  static TriMesh part(const TriMesh& surface, const std::vector<Index>& chosen) {
    TriMesh some{surface.points, {}};
    for (const Index t : chosen) some.triangles.push_back(surface.triangles[t]);
    return some;
  }

  std::vector<Index> chosen_;
  TriangleTree tree_;
};

/// Of each triangle of a surface the interface that it belongs to.
using InterfaceNumbers = std::vector<Index>;

std::vector<Interface> split(const TriMesh& surface, const InterfaceNumbers& numbers,
                             std::size_t count) {
  std::vector<std::vector<Index>> of(count);
  for (std::size_t t = 0; t < numbers.size(); ++t) {
    of[static_cast<std::size_t>(numbers[t])].push_back(static_cast<Index>(t));
  }
  std::vector<Interface> interfaces;
  interfaces.reserve(count);
  for (std::vector<Index>& chosen : of) interfaces.emplace_back(surface, std::move(chosen));
  return interfaces;
}

/// Of each point the interface of its triangles; kNoIndex: of several, or none.
std::vector<Index> of_points(const TriMesh& surface, const InterfaceNumbers& numbers) {
  constexpr Index kNotYet = -2;
  std::vector<Index> of(surface.points.size(), kNotYet);
  for (std::size_t t = 0; t < numbers.size(); ++t) {
    for (const Index p : surface.triangles[t]) {
      of[p] = of[p] == kNotYet || of[p] == numbers[t] ? numbers[t] : kNoIndex;
    }
  }
  std::replace(of.begin(), of.end(), kNotYet, kNoIndex);
  return of;
}

class Refit {
 public:
  /// @param count  of interfaces; each has a triangle of both surfaces.
  Refit(TriMesh decimated, const TriMesh& original, double tolerance, InterfaceNumbers of_decimated,
        InterfaceNumbers of_original, std::size_t count)
      : start_(std::move(decimated)),
        original_(original),
        tolerance_(tolerance),
        of_decimated_(std::move(of_decimated)),
        of_original_(std::move(of_original)),
        of_point_(of_points(original, of_original_)),
        originals_(split(original, of_original_, count)),
        normals_(vertex_normals(start_)),
        stays_(start_.points.size(), 0),
        nearest_(original.points.size(), kNoIndex) {
    for (Vec3& n : normals_) n = unit_or_zero(n);
    find_what_stays();
    pair_triangles();
  }

  TriMesh run() {
    std::vector<double> moves = least_squares();
    moved_ = start_;
    std::vector<char> changed(moves.size(), 0);
    for (std::size_t p = 0; p < moves.size(); ++p) {
      changed[p] = moves[p] != 0 ? 1 : 0;
      place(p, moves[p]);
    }
    SelfIntersections meeting(moved_);
    for (int round = 0; round < kMostChecks; ++round) {
      const std::vector<char> at_fault = corners_at_fault(changed, meeting, round == 0);
      const double share = round < kHalvings ? 0.5 : 0;
      bool any = false;
      for (std::size_t p = 0; p < moves.size(); ++p) {
        changed[p] = at_fault[p] != 0 && moves[p] != 0 ? 1 : 0;
        if (changed[p] == 0) continue;
        any = true;
        moves[p] *= share;
        place(p, moves[p]);
      }
      if (!any) return std::move(moved_);
    }
    return std::move(start_);
  }

 private:
  void place(std::size_t p, double move) {
    moved_.points[p] =
        move == 0 ? start_.points[p] : rounded(start_.points[p] + move * normals_[p]);
  }

  /// Points of sharp edges and of flat parts.
  void find_what_stays() {
    const std::vector<Index> interface = of_points(start_, of_decimated_);
    std::vector<std::vector<Index>> around(start_.points.size());
    std::vector<Vec3> normals;
    for (std::size_t t = 0; t < start_.triangles.size(); ++t) {
      const Triangle& k = start_.triangles[t];
      normals.push_back(normal_of(corners_of(start_, k)));
      for (const Index p : k) around[p].push_back(static_cast<Index>(t));
    }
    for (std::size_t p = 0; p < around.size(); ++p) {
      if (interface[p] == kNoIndex) stays_[p] = 1;
      for (std::size_t i = 0; i < around[p].size() && stays_[p] == 0; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const double c = dot(normals[around[p][i]], normals[around[p][j]]);
          if (c < kSharp || c > kFlat) stays_[p] = 1;
        }
      }
    }
  }

  /// The pairs of triangles that share an edge which no third one has.
  void pair_triangles() {
    std::vector<std::array<Index, 3>> sides;  // lower corner, upper corner, triangle
    for (Index t = 0; t < std::ssize(start_.triangles); ++t) {
      const Triangle& k = start_.triangles[t];
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(k[i], k[(i + 1) % 3]);
        sides.push_back({low, high, t});
      }
    }
    std::sort(sides.begin(), sides.end());
    const auto same = [&](std::size_t a, std::size_t b) {
      return b < sides.size() && sides[a][0] == sides[b][0] && sides[a][1] == sides[b][1];
    };
    for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
      for (end = first + 1; same(first, end);) ++end;
      if (end == first + 2) pairs_.push_back({sides[first][2], sides[first + 1][2]});
    }
  }

  /// What an original point says: where it is nearest to the decimated surface, and how far above.
  struct Sample {
    Index triangle = kNoIndex;  ///< none: it lies where interfaces meet
    std::array<double, 3> share{};
    double distance = 0;
  };

  std::vector<Sample> sampled() const {
    const std::vector<Interface> starts = split(start_, of_decimated_, originals_.size());
    std::vector<Sample> samples(original_.points.size());
    parallel_blocks(samples.size(), 512, [&](std::size_t begin, std::size_t end) {
      std::vector<std::size_t> hints(starts.size(), 0);
      for (std::size_t p = begin; p < end; ++p) {
        if (of_point_[p] == kNoIndex) continue;
        const auto own = static_cast<std::size_t>(of_point_[p]);
        std::size_t& hint = hints[own];
        const Interface& start = starts[own];
        const Vec3& x = original_.points[p];
        start.tree().squared_distance_to(x, hint);
        const Corners& t = start.tree().triangle(hint);
        const std::array<double, 3> share = closest_in(x, t);
        const Vec3 q = share[0] * t[0] + share[1] * t[1] + share[2] * t[2];
        samples[p] = {start.index_of(hint), share, dot(x - q, normal_of(t))};
      }
    });
    return samples;
  }

  /// A third of the area of the triangles at each point.
  std::vector<double> areas() const {
    std::vector<double> areas(original_.points.size(), 0);
    for (const Triangle& t : original_.triangles) {
      const Corners c = corners_of(original_, t);
      const double area = norm(cross(c[1] - c[0], c[2] - c[0])) / 6;
      for (const Index p : t) areas[p] += area;
    }
    return areas;
  }

  /// The normal equations of the least squares: a block of the matrix for each triangle.
  struct Equations {
    std::vector<std::array<double, 9>> blocks;
    Eigen::VectorXd right;
  };

  Equations equations(const std::vector<Sample>& samples) const {
    const std::vector<double> weights = areas();
    Equations all{std::vector<std::array<double, 9>>(start_.triangles.size()),
                  Eigen::VectorXd::Zero(static_cast<Eigen::Index>(start_.points.size()))};
    for (std::size_t p = 0; p < samples.size(); ++p) {
      const Sample& s = samples[p];
      if (s.triangle == kNoIndex) continue;
      const Triangle& k = start_.triangles[s.triangle];
      const Vec3 up = normal_of(corners_of(start_, k));
      auto& block = all.blocks[static_cast<std::size_t>(s.triangle)];
      std::array<double, 3> row{};
      for (std::size_t a = 0; a < 3; ++a) row[a] = s.share[a] * dot(normals_[k[a]], up);
      for (std::size_t a = 0; a < 3; ++a) {
        all.right[k[a]] += weights[p] * row[a] * s.distance;
        for (std::size_t b = 0; b < 3; ++b) block[3 * a + b] += weights[p] * row[a] * row[b];
      }
    }
    return all;
  }

  /// The matrix, in which points that stay have an equation of their own.
  Eigen::SparseMatrix<double> matrix_of(const Equations& all) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(9 * all.blocks.size());
    double sum = 0;
    for (std::size_t t = 0; t < all.blocks.size(); ++t) {
      const Triangle& k = start_.triangles[t];
      for (std::size_t a = 0; a < 3; ++a) {
        sum += all.blocks[t][4 * a];
        for (std::size_t b = 0; b < 3; ++b) {
          if (stays_[k[a]] != 0 || stays_[k[b]] != 0) continue;
          entries.emplace_back(k[a], k[b], all.blocks[t][3 * a + b]);
        }
      }
    }
    const auto n = all.right.size();
    const double pull = kPull * sum / static_cast<double>(n);
    for (Eigen::Index p = 0; p < n; ++p) {
      entries.emplace_back(p, p, stays_[static_cast<std::size_t>(p)] != 0 ? 1 : pull);
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  /// How far each point moves along its normal.
  std::vector<double> least_squares() {
    const std::vector<Sample> samples = sampled();
    for (std::size_t p = 0; p < samples.size(); ++p) nearest_[p] = samples[p].triangle;
    Equations all = equations(samples);
    for (std::size_t p = 0; p < stays_.size(); ++p) {
      if (stays_[p] != 0) all.right[static_cast<Eigen::Index>(p)] = 0;
    }
    const Eigen::SparseMatrix<double> matrix = matrix_of(all);
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
    solver.setMaxIterations(60);
    solver.setTolerance(1e-3);
    solver.compute(matrix);
    const Eigen::VectorXd found = solver.solve(all.right);
    std::vector<double> moves(start_.points.size());
    const double most = kFarthest * tolerance_;
    for (std::size_t p = 0; p < moves.size(); ++p) {
      moves[p] = std::clamp(found[static_cast<Eigen::Index>(p)], -most, most);
    }
    return moves;
  }

  /// The cosine between two triangles.
  static double bend(const TriMesh& surface, const TrianglePair& pair) {
    return dot(normal_of(corners_of(surface, surface.triangles[pair[0]])),
               normal_of(corners_of(surface, surface.triangles[pair[1]])));
  }
  bool has_become_a_crease(const TrianglePair& pair) const {
    const double now = bend(moved_, pair);
    return now < kCrease && now < bend(start_, pair) - kRounding;
  }

  /// Whether one moved triangle that is nearest to a corner of an original is near all of it.
  bool is_near_one(const Triangle& original, const Corners& corners) const {
    return std::any_of(original.begin(), original.end(), [&](Index p) {
      if (nearest_[p] == kNoIndex) return false;
      const Corners t = corners_of(moved_, moved_.triangles[nearest_[p]]);
      return std::all_of(corners.begin(), corners.end(), [&](const Vec3& c) {
        return squared_distance(c, t) <= tolerance_ * tolerance_;
      });
    });
  }

  /// Where points have changed: the corners of triangles that have turned or bend at a crease, meet
  /// others or are too far from the original, and of those nearest to what is too far of that.
  std::vector<char> corners_at_fault(const std::vector<char>& changed, SelfIntersections& meeting,
                                     bool all) const {
    std::vector<Index> touched;
    std::vector<char> is_touched(moved_.triangles.size(), 0);
    for (std::size_t t = 0; t < is_touched.size(); ++t) {
      const Triangle& k = moved_.triangles[t];
      if (changed[k[0]] == 0 && changed[k[1]] == 0 && changed[k[2]] == 0) continue;
      is_touched[t] = 1;
      touched.push_back(static_cast<Index>(t));
    }
    std::vector<char> at_fault(moved_.triangles.size(), 0);
    const Enough enough{tolerance_, tolerance_};
    parallel_blocks(touched.size(), 256, [&](std::size_t begin, std::size_t end) {
      std::vector<std::size_t> hints(originals_.size(), 0);
      for (std::size_t n = begin; n < end; ++n) {
        const Triangle& k = moved_.triangles[touched[n]];
        const auto own = static_cast<std::size_t>(of_decimated_[touched[n]]);
        const Corners now = corners_of(moved_, k);
        const bool turned = dot(normal_of(now), normal_of(corners_of(start_, k))) < kTurn;
        const bool far = turned || farthest_distance(now, originals_[own].tree(), enough,
                                                     hints[own]) > tolerance_;
        at_fault[static_cast<std::size_t>(touched[n])] = far ? 1 : 0;
      }
    });
    for (const Index t : nearest_to_what_is_far(is_touched)) at_fault[t] = 1;
    for (const TrianglePair& pair : pairs_) {
      if (is_touched[pair[0]] + is_touched[pair[1]] == 0) continue;
      if (has_become_a_crease(pair)) at_fault[pair[0]] = at_fault[pair[1]] = 1;
    }
    for (const TrianglePair& pair : all ? meeting.all() : meeting.after_move_of(touched)) {
      for (const Index t : pair) at_fault[t] = 1;
    }
    std::vector<char> corners(moved_.points.size(), 0);
    for (std::size_t t = 0; t < at_fault.size(); ++t) {
      if (at_fault[t] == 0) continue;
      for (const Index p : moved_.triangles[t]) corners[p] = 1;
    }
    return corners;
  }

  std::vector<Index> nearest_to_what_is_far(const std::vector<char>& is_touched) const {
    const std::vector<Interface> moved = split(moved_, of_decimated_, originals_.size());
    const Enough enough{tolerance_, tolerance_};
    return parallel_collect<Index>(
        original_.triangles.size(), 256, [&](std::size_t begin, std::size_t end, auto& found) {
          std::vector<std::size_t> hints(moved.size(), 0);
          for (std::size_t t = begin; t < end; ++t) {
            const Triangle& k = original_.triangles[t];
            const auto may_be_far = [&](Index p) {
              return nearest_[p] != kNoIndex && is_touched[nearest_[p]] != 0;
            };
            if (std::none_of(k.begin(), k.end(), may_be_far)) continue;
            const auto own = static_cast<std::size_t>(of_original_[t]);
            const Corners c = corners_of(original_, k);
            if (is_near_one(k, c)) continue;
            if (!(farthest_distance(c, moved[own].tree(), enough, hints[own]) > tolerance_))
              continue;
            for (const Index p : k) {
              if (nearest_[p] != kNoIndex) found.push_back(nearest_[p]);
            }
          }
        });
  }

  TriMesh start_, moved_;
  const TriMesh& original_;
  double tolerance_;
  InterfaceNumbers of_decimated_, of_original_;
  std::vector<Index> of_point_;  // of the original
  std::vector<Interface> originals_;
  std::vector<Vec3> normals_;
  std::vector<char> stays_;
  std::vector<TrianglePair> pairs_;
  std::vector<Index> nearest_;  // to each original point, the triangle before any move
};

}  // namespace

TriMesh refit(TriMesh decimated, const TriMesh& original, double tolerance) {
  if (decimated.triangles.empty()) return decimated;
  InterfaceNumbers of_decimated(decimated.triangles.size(), 0);
  InterfaceNumbers of_original(original.triangles.size(), 0);
  return Refit(std::move(decimated), original, tolerance, std::move(of_decimated),
               std::move(of_original), 1)
      .run();
}

PartitionSurface refit_partition(PartitionSurface decimated, const PartitionSurface& original,
                                 double tolerance) {
  if (decimated.sides.size() != decimated.triangles.size() ||
      original.sides.size() != original.triangles.size()) {
    throw InputError("refit: expected a pair of sides for each triangle");
  }
  if (decimated.triangles.empty()) return decimated;
  std::map<std::array<Index, 2>, Index> numbers;
  const auto number = [&](const std::array<Index, 2>& sides) {
    return numbers.try_emplace(sides, static_cast<Index>(numbers.size())).first->second;
  };
  InterfaceNumbers of_decimated, of_original;
  for (const auto& sides : decimated.sides) of_decimated.push_back(number(sides));
  const std::size_t left = numbers.size();
  for (const auto& sides : original.sides) of_original.push_back(number(sides));
  if (numbers.size() != left) throw InputError("refit: expected a triangle of each interface");
  const TriMesh whole{original.points, original.triangles};
  TriMesh surface{std::move(decimated.points), std::move(decimated.triangles)};
  surface = Refit(std::move(surface), whole, tolerance, std::move(of_decimated),
                  std::move(of_original), left)
                .run();
  decimated.points = std::move(surface.points);
  decimated.triangles = std::move(surface.triangles);
  return decimated;
}

}  // namespace mesamis
