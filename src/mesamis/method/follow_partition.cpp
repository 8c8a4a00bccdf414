// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/follow_partition.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/method/surface_moves.h"

namespace mesamis {
namespace {

constexpr int kRounds = 2;            // a flow of labels ends up to a voxel from the level set
constexpr double kLeastContrast = 4;  // standard deviations of the noise
constexpr double kLeastGrey = 10;     // grey values: a contrast that means something

constexpr int kFairingSweeps = 10;  // pairs of steps of Taubin's filter
constexpr double kShrink = 0.5, kGrow = -0.53;
constexpr double kMostFairing = 0.7;  // voxels

/// What the image tells at the points between two materials.
Offsets measure(const FollowSpace& space, const TriMesh& surface, const std::vector<Vec3>& normals,
                const std::vector<const PairLevel*>& pair_of, double noise) {
  Offsets offsets(surface.points.size());
  parallel_for(surface.points.size(), [&](std::size_t p) {
    const PairLevel* const pair = pair_of[p];
    if (pair == nullptr || !shows_edge(*pair, noise) || space.on_box(surface.points[p])) return;
    const double sign = pair->contrast > 0 ? 1 : -1;
    const ImageValue here = space.at(surface.points[p]);
    const double slope = space.per_voxel(-sign * dot(here.gradient, normals[p]));
    const auto offset = image_offset(sign * (here.value - pair->level), slope, noise);
    if (offset) offsets.set(p, *offset, slope);
  });
  return offsets;
}

/// The pair of each point; none where several meet.
std::vector<const PairLevel*> pair_at_points(const PartitionSurface& partition,
                                             const std::vector<PairLevel>& pairs) {
  const std::vector<Index> pair_of = pairs_of_points(partition, pairs);
  std::vector<const PairLevel*> between(pair_of.size(), nullptr);
  for (std::size_t p = 0; p < between.size(); ++p) {
    if (pair_of[p] != kNoIndex) between[p] = &pairs[static_cast<std::size_t>(pair_of[p])];
  }
  return between;
}

/// What each point is smoothed with: the points beside it, on a curve where boundaries meet those
/// of the curve alone.
class Fairing {
 public:
  Fairing(const FollowSpace& space, const TriMesh& surface, const Neighbors& neighbors,
          const std::vector<const PairLevel*>& pair_of)
      : surface_(surface),
        neighbors_(neighbors),
        free_(surface.points.size()),
        on_curve_(surface.points.size()) {
    parallel_for(free_.size(), [&](std::size_t p) {
      free_[p] = space.on_box(surface.points[p]) ? 0 : 1;
      on_curve_[p] = pair_of[p] == nullptr ? 1 : 0;
    });
  }

  /// How far Taubin's filter moves the points, at most so far.
  std::vector<Vec3> shifts(double most) const {
    std::vector<Vec3> points = surface_.points;
    for (int sweep = 0; sweep < kFairingSweeps; ++sweep) {
      points = stepped(points, kShrink);
      points = stepped(points, kGrow);
    }
    parallel_for(points.size(), [&](std::size_t p) {
      const Vec3 shift = points[p] - surface_.points[p];
      const double length = norm(shift);
      points[p] = (length > most ? most / length : 1) * shift;
    });
    return points;
  }

 private:
  std::vector<Vec3> stepped(const std::vector<Vec3>& points, double factor) const {
    std::vector<Vec3> next(points.size());
    parallel_for(points.size(), [&](std::size_t p) {
      Vec3 sum;
      int count = 0;
      for (std::size_t n = neighbors_.start[p]; n < neighbors_.start[p + 1]; ++n) {
        const Index other = neighbors_.points[n];
        if (on_curve_[p] > on_curve_[static_cast<std::size_t>(other)]) continue;
        sum += points[static_cast<std::size_t>(other)];
        ++count;
      }
      next[p] = points[p];
      if (free_[p] != 0 && count > 1) next[p] += factor * ((1.0 / count) * sum - points[p]);
    });
    return next;
  }

  const TriMesh& surface_;
  const Neighbors& neighbors_;
  std::vector<char> free_, on_curve_;
};

}  // namespace

bool shows_edge(const PairLevel& pair, double noise) {
  return std::abs(pair.contrast) >= std::max(kLeastGrey, kLeastContrast * noise);
}

PartitionSurface follow_image(PartitionSurface partition, const SplineImage& image,
                              const std::vector<PairLevel>& pairs, double noise) {
  const FollowSpace space(image, 1);
  const auto between = pair_at_points(partition, pairs);
  TriMesh surface{std::move(partition.points), std::move(partition.triangles)};
  const Neighbors neighbors(surface);
  const Fairing fairing(space, surface, neighbors, between);
  surface = moved_without_folds(space, surface, fairing.shifts(kMostFairing * space.voxel()));
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Vec3> normals = smoothed_normals(surface, neighbors);
    const Offsets offsets = measure(space, surface, normals, between, noise);
    if (!is_worthwhile(offsets)) break;
    const std::vector<double> moves = filtered_moves(space, offsets, neighbors);
    std::vector<Vec3> shifts(moves.size());
    for (std::size_t p = 0; p < moves.size(); ++p) {
      shifts[p] = space.within_box(surface.points[p], moves[p] * normals[p]);
    }
    surface = moved_without_folds(space, surface, std::move(shifts));
  }
  partition.points = std::move(surface.points);
  partition.triangles = std::move(surface.triangles);
  return partition;
}

}  // namespace mesamis
