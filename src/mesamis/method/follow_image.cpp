// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/follow_image.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/fit/surface_moves.h"
#include "mesamis/surface/normals.h"
#include "mesamis/surface/split_edges.h"

namespace mesamis {
namespace {

constexpr double kShortestEdge = 1;  // voxels: shorter ones are not split
constexpr double kLeastBend = 0.03;  // voxels between an edge and the level set that are worth it
constexpr double kLeastHeight = 0.002;  // voxels: edges of less high triangles are not split
constexpr int kMostRounds = 8;          // of splitting: about two halve every edge of a triangle

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

  void run(FollowedPart& part) const {
    TriMesh& surface = part.extracted;
    hold_on_box(part);
    surface = split_edges(std::move(surface),
                          [this](const Vec3& a, const Vec3& b) { return is_bent(a, b); },
                          {kMostRounds, kLeastHeight * space_.voxel(), part.held});
    part.held.resize(surface.points.size(), 0);
    part.moved.insert(part.moved.end(), surface.points.begin() + std::ssize(part.moved),
                      surface.points.end());
    const Neighbors neighbors(surface);
    const std::vector<Vec3> normals = smoothed_normals(surface, neighbors);
    const std::vector<double> moves = filtered_moves(space_, measure(surface, normals), neighbors);
    std::vector<Vec3> shifts(moves.size());
    for (std::size_t p = 0; p < moves.size(); ++p) {
      if (part.held[p] != kFree) continue;
      shifts[p] = space_.within_box(surface.points[p], moves[p] * normals[p]);
    }
    part.moved =
        moved_without_folds(space_, {part.moved, surface.triangles}, std::move(shifts)).points;
  }

 private:
  /// On the box nothing moves: points there would only cut the walls into needles.
  void hold_on_box(FollowedPart& part) const {
    for (std::size_t p = 0; p < part.held.size(); ++p) {
      if (part.held[p] == kFree && space_.on_box(part.extracted.points[p])) part.held[p] = kHeld;
    }
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
    return bend > std::max(kLeastBend, between->noise);
  }

  FollowSpace space_;
  FollowOptions options_;
};

}  // namespace

TriMesh follow_image(const TriMesh& surface, const SplineImage& image,
                     const FollowOptions& options) {
  if (!look_along(surface, image, options).is_worthwhile()) return surface;
  FollowedPart whole{surface, surface.points, std::vector<char>(surface.points.size(), 0)};
  follow_part(whole, image, options);
  return {std::move(whole.moved), std::move(whole.extracted.triangles)};
}

void follow_part(FollowedPart& part, const SplineImage& image, const FollowOptions& options) {
  if (!part.extracted.triangles.empty()) Follower(image, options).run(part);
}

FollowCounts look_along(const TriMesh& surface, const SplineImage& image,
                        const FollowOptions& options) {
  if (surface.triangles.empty()) return {};
  return count_told(Follower(image, options).measure(surface, vertex_normals(surface)));
}

}  // namespace mesamis
