// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/follow_image.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/normals.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/split_edges.h"

namespace mesamis {
namespace {

constexpr double kShortestEdge = 1;  // voxels: shorter ones are not split
constexpr double kLeastBend = 0.03;  // voxels between an edge and the level set that are worth it
constexpr int kMostRounds = 8;       // of splitting: about two halve every edge of a triangle
constexpr double kMostMove = 0.7;    // voxels
/// Voxels of noise beyond which the image tells nothing that the mesh does not.
constexpr double kMostNoise = 0.3;
/// Of the noise at the voxels, what the spline passes on between them, and a margin.
constexpr double kNoiseMargin = 1.1;
constexpr double kNoiseOfMean = 0.2;                // variance left in a local mean
constexpr double kLeastSlope = 8, kFullSlope = 20;  // grey values per voxel
constexpr int kSweepsOfMean = 10, kSweepsOfNormals = 3;

/// The neighbours of each point of a surface: those of point p from start[p] to start[p + 1].
struct Neighbors {
  explicit Neighbors(const TriMesh& surface) : start(surface.points.size() + 1, 0) {
    for (const Triangle& t : surface.triangles) {
      for (const Index p : t) ++start[static_cast<std::size_t>(p) + 1];
    }
    for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    points.resize(start.back());
    for (const Triangle& t : surface.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        points[next[static_cast<std::size_t>(t[i])]++] = t[(i + 1) % 3];
      }
    }
  }
  std::vector<std::size_t> start;
  std::vector<Index> points;
};

/// Means over the neighbourhood: each sweep halves the way to the neighbours' weighted mean.
template <class Value>
std::vector<Value> smoothed_along(const Neighbors& neighbors, const std::vector<double>& weights,
                                  std::vector<Value> values, int sweeps) {
  std::vector<Value> next(values.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    parallel_for(values.size(), [&](std::size_t p) {
      const auto count = static_cast<double>(neighbors.start[p + 1] - neighbors.start[p]);
      double weight = weights[p] * count;
      Value sum = weight * values[p];
      for (std::size_t n = neighbors.start[p]; n < neighbors.start[p + 1]; ++n) {
        const Index other = neighbors.points[n];
        weight += weights[other];
        sum = sum + weights[other] * values[other];
      }
      next[p] = weight > 0 ? (1 / weight) * sum : values[p];
    });
    std::swap(values, next);
  }
  return values;
}

/// What the image tells at the points; voxels.
struct Offsets {
  std::vector<double> distance;  ///< to the level set, outwards along the normal
  std::vector<double> noise;     ///< standard deviation of the distance
  std::vector<double> weight;    ///< 0: the image tells nothing
};

class Follower {
 public:
  Follower(const TriMesh& surface, const SplineImage& image, const FollowOptions& options)
      : image_(image),
        options_(options),
        voxel_(image.grid.voxel_size() / options.point_scale),
        box_(box_of(image, options)),
        surface_(surface) {}

  /// Whether the noise leaves anything to be told, at the points as they are.
  bool is_worthwhile() const {
    const Offsets offsets = measure(vertex_normals(surface_));
    std::vector<double> noise;
    for (std::size_t p = 0; p < offsets.noise.size(); ++p) {
      if (offsets.weight[p] > 0) noise.push_back(offsets.noise[p]);
    }
    return !noise.empty() && median(noise) < kMostNoise;
  }

  TriMesh run() {
    surface_ = split_edges(
        std::move(surface_), [this](const Vec3& a, const Vec3& b) { return is_bent(a, b); },
        kMostRounds);
    const Neighbors neighbors(surface_);
    const std::vector<double> ones(surface_.points.size(), 1);
    std::vector<Vec3> normals =
        smoothed_along(neighbors, ones, vertex_normals(surface_), kSweepsOfNormals);
    for (Vec3& normal : normals) normal = unit_or_zero(normal);
    const std::vector<double> moves = filtered(measure(normals), neighbors);
    std::vector<Vec3> shifts(moves.size());
    for (std::size_t p = 0; p < moves.size(); ++p) {
      const double move = std::clamp(moves[p], -kMostMove, kMostMove) * voxel_;
      shifts[p] = within_box(surface_.points[p], move * normals[p]);
    }
    return moved_without_folds(std::move(shifts));
  }

 private:
  static Box box_of(const SplineImage& image, const FollowOptions& options) {
    return {{0, 0, 0}, (1 / options.point_scale) * image.grid.box().extent()};
  }

  /// What the image tells at a place; voxels.
  struct Offset {
    double distance;  ///< to the level set
    double noise;     ///< standard deviation of the distance
  };

  /// @param slope  of the image, grey values per voxel.
  /// @return nothing where the image is flat.
  std::optional<Offset> offset_of(double value, double slope) const {
    if (!(slope >= kLeastSlope)) return std::nullopt;
    return Offset{std::clamp((value - options_.level) / slope, -kMostMove, kMostMove),
                  kNoiseMargin * options_.noise / slope};
  }

  /// Along the gradient.
  std::optional<Offset> offset_at(const Vec3& p) const {
    const ImageValue here = spline_at(image_, options_.point_scale * p);
    return offset_of(here.value, norm(here.gradient) * image_.grid.voxel_size());
  }

  /// Whether the level set leaves an edge between its ends by more than noise.
  bool is_bent(const Vec3& a, const Vec3& b) const {
    const Vec3 d = options_.point_scale * (a - b), &s = image_.grid.spacing;
    if (norm({d.x / s.x, d.y / s.y, d.z / s.z}) <= kShortestEdge) return false;
    const auto at_a = offset_at(a), at_b = offset_at(b), between = offset_at(0.5 * (a + b));
    if (!at_a || !at_b || !between) return false;
    const double bend = std::abs(between->distance - (at_a->distance + at_b->distance) / 2);
    return bend > std::max(kLeastBend, between->noise);
  }

  bool on_box(const Vec3& p) const {
    const double slack = 1e-6 * voxel_;
    for (int a = 0; a < 3; ++a) {
      if (p[a] <= box_.lo[a] + slack || p[a] >= box_.hi[a] - slack) return true;
    }
    return false;
  }

  /// The move, shortened to at most half the way to the box where it would leave it.
  Vec3 within_box(const Vec3& p, const Vec3& move) const {
    double part = 1;
    for (int a = 0; a < 3; ++a) {
      const double room = std::max(0.0, move[a] < 0 ? p[a] - box_.lo[a] : box_.hi[a] - p[a]);
      if (std::abs(move[a]) > room) part = std::min(part, room / (2 * std::abs(move[a])));
    }
    return part * move;
  }

  Offsets measure(const std::vector<Vec3>& normals) const {
    const std::size_t count = surface_.points.size();
    Offsets offsets{std::vector<double>(count), std::vector<double>(count),
                    std::vector<double>(count)};
    parallel_for(count, [&](std::size_t p) {
      if (on_box(surface_.points[p])) return;
      const ImageValue here = spline_at(image_, options_.point_scale * surface_.points[p]);
      const double slope = -dot(here.gradient, normals[p]) * image_.grid.voxel_size();
      const auto offset = offset_of(here.value, slope);
      if (!offset) return;
      offsets.distance[p] = offset->distance;
      offsets.noise[p] = offset->noise;
      offsets.weight[p] = std::min(1.0, slope * slope / (kFullSlope * kFullSlope));
    });
    return offsets;
  }

  /// What of the distances is not noise.
  static std::vector<double> filtered(const Offsets& offsets, const Neighbors& neighbors) {
    const std::vector<double>& d = offsets.distance;
    std::vector<double> squares(d.size());
    for (std::size_t p = 0; p < d.size(); ++p) squares[p] = d[p] * d[p];
    const auto mean = smoothed_along(neighbors, offsets.weight, d, kSweepsOfMean);
    const auto mean_square =
        smoothed_along(neighbors, offsets.weight, std::move(squares), kSweepsOfMean);
    std::vector<double> moves(d.size());
    for (std::size_t p = 0; p < d.size(); ++p) {
      if (offsets.weight[p] == 0) continue;
      const double m = mean[p], noise = offsets.noise[p] * offsets.noise[p];
      const double variance = mean_square[p] - m * m;
      const double k = variance > noise ? 1 - noise / variance : 0;
      const double a = m * m > kNoiseOfMean * noise ? 1 - kNoiseOfMean * noise / (m * m) : 0;
      moves[p] = a * m + k * (d[p] - m);
    }
    return moves;
  }

  /// Moves all points, then takes moves back, first half, then whole, where triangles meet, here or
  /// once the surface is in a file, which holds single precision.
  TriMesh moved_without_folds(std::vector<Vec3> shifts) const {
    constexpr int kHalvings = 2, kMostTrials = 40;
    std::vector<int> taken_back(shifts.size(), 0);
    TriMesh moved = surface_;
    for (std::size_t p = 0; p < shifts.size(); ++p) moved.points[p] += shifts[p];
    TriMesh filed = as_in_a_file(moved);
    SelfIntersections here(moved), in_file(filed);
    std::vector<char> meeting = moved_corners(shifts, here.all(), in_file.all());
    for (int trial = 0; trial < kMostTrials; ++trial) {
      const std::vector<Index> concerned = triangles_at(meeting);
      if (concerned.empty()) return moved;
      for (std::size_t p = 0; p < shifts.size(); ++p) {
        if (meeting[p] == 0) continue;
        shifts[p] = (taken_back[p]++ < kHalvings ? 0.5 : 0.0) * shifts[p];
        moved.points[p] = surface_.points[p] + shifts[p];
        filed.points[p] = as_in_a_file(moved.points[p]);
      }
      meeting =
          moved_corners(shifts, here.after_move_of(concerned), in_file.after_move_of(concerned));
    }
    return triangles_at(meeting).empty() ? moved : surface_;
  }

  /// Of each point 1 if it is a corner of a pair of which any corner is still moved. Others met
  /// before: needles, in single precision.
  std::vector<char> moved_corners(const std::vector<Vec3>& shifts,
                                  const std::vector<TrianglePair>& some,
                                  const std::vector<TrianglePair>& others) const {
    std::vector<char> corners(surface_.points.size(), 0);
    const auto is_moved = [&](Index t) {
      const Triangle& k = surface_.triangles[t];
      return std::any_of(k.begin(), k.end(), [&](Index p) { return norm(shifts[p]) > 0; });
    };
    for (const auto* pairs : {&some, &others}) {
      for (const auto& [a, b] : *pairs) {
        if (!is_moved(a) && !is_moved(b)) continue;
        for (const Index p : surface_.triangles[a]) corners[p] = 1;
        for (const Index p : surface_.triangles[b]) corners[p] = 1;
      }
    }
    return corners;
  }

  /// The triangles at points that are chosen, increasing.
  std::vector<Index> triangles_at(const std::vector<char>& chosen) const {
    std::vector<Index> triangles;
    for (Index t = 0; t < std::ssize(surface_.triangles); ++t) {
      const Triangle& k = surface_.triangles[t];
      if (chosen[k[0]] + chosen[k[1]] + chosen[k[2]] > 0) triangles.push_back(t);
    }
    return triangles;
  }

  Vec3 as_in_a_file(const Vec3& point) const {
    Vec3 p = image_.grid.to_world(options_.point_scale * point);
    for (int a = 0; a < 3; ++a) p[a] = static_cast<float>(p[a]);
    return p;
  }

  TriMesh as_in_a_file(TriMesh surface) const {
    parallel_for(surface.points.size(),
                 [&](std::size_t p) { surface.points[p] = as_in_a_file(surface.points[p]); });
    return surface;
  }

  const SplineImage& image_;
  FollowOptions options_;
  double voxel_;  // in the surface's unit
  Box box_;
  TriMesh surface_;
};

}  // namespace

TriMesh follow_image(const TriMesh& surface, const SplineImage& image,
                     const FollowOptions& options) {
  if (surface.triangles.empty()) return surface;
  Follower follower(surface, image, options);
  return follower.is_worthwhile() ? follower.run() : surface;
}

}  // namespace mesamis
