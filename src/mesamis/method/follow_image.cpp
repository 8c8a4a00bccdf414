// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/follow_image.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "mesamis/base/morton_code.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fit/bending.h"
#include "mesamis/fit/surface_moves.h"
#include "mesamis/fit/terraces.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/normals.h"
#include "mesamis/surface/split_edges.h"

namespace mesamis::detail::method {
namespace {

constexpr double kShortestEdge = 1.4;  // voxels: shorter ones are not split
constexpr double kLeastBend = 0.03;    // voxels between an edge and the level set that are worth it
constexpr double kLeastHeight = 0.002;  // voxels: edges of less high triangles are not split
constexpr int kMostRounds = 8;          // of splitting: about two halve every edge of a triangle
constexpr double kDraftBend = 0.1, kDraftAccuracy = 0.01;  // of drafts
constexpr double kBending = 6;          // against a weight of 1 of the place where a point is
constexpr double kMostSmoothed = 0.25;  // voxels
/// Voxels: points that noise moves by more are held with the weight 1, by half of it or less with 4.
constexpr double kNoiseOfWeight = 0.15, kMostWeight = 4;
constexpr double kThick = 3, kThinnest = 0.75, kDepthStep = 0.25;  // voxels behind the surface

/// Orders points along a Morton curve and triangles by their first corners: what goes from neighbour
/// to neighbour finds it in memory nearby, though split_edges() appends what it adds.
void sort_along_curve(FollowedPart& part) {
  const std::vector<Vec3>& points = part.extracted.points;
  const Box box = bounding_box(points);
  std::vector<std::pair<std::uint64_t, Index>> order(points.size());
  parallel_for(points.size(), [&](std::size_t p) {
    order[p] = {morton_code(box, points[p]), static_cast<Index>(p)};
  });
  std::sort(order.begin(), order.end());
  std::vector<Index> number(points.size());
  FollowedPart sorted{{std::vector<Vec3>(points.size()), std::move(part.extracted.triangles)},
                      std::vector<Vec3>(points.size()),
                      std::vector<char>(points.size())};
  parallel_for(order.size(), [&](std::size_t to) {
    const Index from = order[to].second;
    number[from] = static_cast<Index>(to);
    sorted.extracted.points[to] = points[from];
    sorted.moved[to] = part.moved[from];
    sorted.held[to] = part.held[from];
  });
  for (Triangle& t : sorted.extracted.triangles) {
    for (Index& p : t) p = number[p];
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  }
  std::ranges::sort(sorted.extracted.triangles);
  part = std::move(sorted);
}

class Follower {
 public:
  Follower(const SplineImage& image, const FollowOptions& options)
      : space_(image, options.point_scale), options_(options) {}

  /// What the image tells at the points of a surface.
  Offsets measure(const TriMesh& surface, const std::vector<Vec3>& normals) const {
    Offsets offsets(surface.points.size());
    parallel_for(surface.points.size(), [&](std::size_t p) {
      if (space_.on_box(surface.points[p])) return;
      const ImageValue here = space_.at(surface.points[p]);
      const double slope = space_.per_voxel(-dot(here.gradient, normals[p]));
      const auto offset = image_offset(here.value - options_.level, slope, options_.noise);
      if (offset) offsets.set(p, *offset, slope);
    });
    return offsets;
  }

  /// Splits edges that the level set leaves, and holds what nothing may move.
  void split(FollowedPart& part) const {
    hold_on_box(part);
    if (options_.to_image) split_bent_edges(part);
  }

  void move(FollowedPart& part) const {
    const Neighbors neighbors(part.extracted);
    std::vector<Vec3> goals = part.moved;
    if (options_.to_image) move_to_image(part, neighbors, goals);
    if (options_.smooth) smooth(part, neighbors, goals);
    for (std::size_t p = 0; p < goals.size(); ++p) goals[p] = goals[p] - part.moved[p];
    part.moved =
        moved_without_folds(space_, {part.moved, part.extracted.triangles}, std::move(goals),
                            options_.draft ? Unfolded::kInFile : Unfolded::kHereAndInFile)
            .points;
  }

 private:
  /// On the box nothing moves: points there would only cut the walls into needles.
  void hold_on_box(FollowedPart& part) const {
    for (std::size_t p = 0; p < part.held.size(); ++p) {
      if (part.held[p] == kFree && space_.on_box(part.extracted.points[p])) part.held[p] = kHeld;
    }
  }

  void split_bent_edges(FollowedPart& part) const {
    part.extracted = split_edges(
        std::move(part.extracted), [this](const Vec3& a, const Vec3& b) { return is_bent(a, b); },
        {options_.draft ? 1 : kMostRounds, kLeastHeight * space_.voxel(), part.held});
    part.held.resize(part.extracted.points.size(), kFree);
    part.moved.insert(part.moved.end(), part.extracted.points.begin() + std::ssize(part.moved),
                      part.extracted.points.end());
  }

  void move_to_image(const FollowedPart& part, const Neighbors& neighbors,
                     std::vector<Vec3>& points) const {
    constexpr int kRounds = 3;     // the image is not linear
    TriMesh now = part.extracted;  // held points too: others see what they do
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<Vec3> normals = smoothed_normals(now, neighbors);
      const std::vector<double> moves = filtered_moves(space_, measure(now, normals), neighbors);
      parallel_for(moves.size(), [&](std::size_t p) {
        const Vec3 &start = part.extracted.points[p], goal = now.points[p] + moves[p] * normals[p];
        now.points[p] = start + space_.step_to(goal, start, kMostMove);
      });
    }
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (part.held[p] == kFree) points[p] = now.points[p];
    }
  }

  void smooth(const FollowedPart& part, const Neighbors& neighbors,
              std::vector<Vec3>& points) const {
    const TriMesh surface{points, part.extracted.triangles};
    const std::vector<Vec3> normals = smoothed_normals(surface, neighbors);
    // A rim is as thin as the faces beside it, though much is behind it.
    const std::vector<double> depths = least_around(neighbors, depths_behind(points, normals));
    Springs springs{std::vector<double>(points.size()), {}, std::vector<char>(points.size())};
    parallel_for(points.size(), [&](std::size_t p) {
      springs.held[p] = part.held[p] == kFree ? 0 : 1;
      springs.weight[p] = std::pow(kThick / depths[p], 2);
    });
    if (options_.draft) springs.accuracy = kDraftAccuracy;
    points = without_terraces(space_, surface, neighbors, springs);
    parallel_for(points.size(),
                 [&](std::size_t p) { springs.weight[p] *= weight_by_noise(points[p]); });
    springs.goal = points;
    // Held points, those of a wall of the box among them, do not bend what is free beside them.
    const Umbrella umbrella(neighbors, links_along_curves(neighbors, springs.held));
    const std::vector<Vec3> goals = relax(umbrella, springs, kBending, points);
    parallel_for(points.size(), [&](std::size_t p) {
      if (springs.held[p] == 0) points[p] += space_.step_to(goals[p], points[p], kMostSmoothed);
    });
  }

  /// How far the object goes behind the points, kThinnest to kThick, voxels.
  std::vector<double> depths_behind(const std::vector<Vec3>& points,
                                    const std::vector<Vec3>& normals) const {
    std::vector<double> depths(points.size());
    parallel_for(points.size(), [&](std::size_t p) {
      const Vec3 step = (-space_.voxel()) * normals[p];
      double& depth = depths[p] = kThinnest;
      while (depth < kThick && space_.value_at(points[p] + depth * step) >= options_.level) {
        depth += kDepthStep;
      }
    });
    return depths;
  }

  double weight_by_noise(const Vec3& p) const {
    const auto offset = offset_at(p);
    if (!offset) return 1;
    const double ratio = kNoiseOfWeight / offset->noise;  // infinite without noise
    return std::clamp(ratio * ratio, 1.0, kMostWeight);
  }

  /// Along the gradient.
  std::optional<ImageOffset> offset_at(const Vec3& p) const {
    const ImageValue here = space_.at(p);
    return image_offset(here.value - options_.level, space_.per_voxel(norm(here.gradient)),
                        options_.noise);
  }

  /// Whether the level set leaves an edge between its ends by more than noise.
  bool is_bent(const Vec3& a, const Vec3& b) const {
    if (space_.in_steps(a - b) <= kShortestEdge) return false;
    const auto at_a = offset_at(a), at_b = offset_at(b), between = offset_at(0.5 * (a + b));
    if (!at_a || !at_b || !between) return false;
    const double bend = std::abs(between->distance - (at_a->distance + at_b->distance) / 2);
    return bend > std::max(options_.draft ? kDraftBend : kLeastBend, between->noise);
  }

  FollowSpace space_;
  FollowOptions options_;
};

bool has_work(const TriMesh& surface, const FollowOptions& options) {
  return (options.to_image || options.smooth) && !surface.triangles.empty();
}

}  // namespace

TriMesh follow_image(const TriMesh& surface, const SplineImage& image,
                     const FollowOptions& options) {
  FollowOptions what = options;
  what.to_image = options.to_image && look_along(surface, image, options).is_worthwhile();
  if (!has_work(surface, what)) return surface;
  const Follower follower(image, what);
  FollowedPart whole{surface, surface.points, std::vector<char>(surface.points.size(), 0)};
  follower.split(whole);
  if (whole.extracted.points.size() > surface.points.size()) sort_along_curve(whole);
  follower.move(whole);
  return {std::move(whole.moved), std::move(whole.extracted.triangles)};
}

double most_followed(const VoxelGrid& grid, double point_scale) {
  const SurfaceSpace space(grid, point_scale);
  return (kMostMove + kMostSmoothed) * space.voxel() + most_moved_by_terraces(space);
}

void follow_part(FollowedPart& part, const SplineImage& image, const FollowOptions& options) {
  if (!has_work(part.extracted, options)) return;
  const Follower follower(image, options);
  follower.split(part);
  follower.move(part);
}

FollowCounts look_along(const TriMesh& surface, const SplineImage& image,
                        const FollowOptions& options) {
  if (surface.triangles.empty()) return {};
  return count_told(Follower(image, options).measure(surface, vertex_normals(surface)));
}

}  // namespace mesamis::detail::method
