// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/local_level.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/image/gaussian.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/image/trilinear.h"
#include "mesamis/restore/level_crossings.h"

namespace mesamis::detail::restore {
namespace {

constexpr double kEdgeScale = 0.8;  // voxels, of the gradient
constexpr double kSpread = 3;       // voxels, of the mean over edges
constexpr double kThick = 4;        // voxels, of both sides of an edge that counts
constexpr double kLeastOfContrast = 0.1, kLeastOfNoise = 4, kMostOfContrast = 0.6;
/// The dark side of an edge against the object's background, of its contrast.
constexpr double kDarkest = -0.25, kBrightest = 0.35;
/// Of the median weight of an edge: what holds the level at the object's where there are no edges.
constexpr double kPull = 0.005;
/// Standard deviations of the local level, of the contrast: up to the first it is the scatter of one
/// level, from the second on each place has its own.
constexpr double kOneLevel = 0.06, kManyLevels = 0.12;

/// The two sides of an edge, native units.
struct Sides {
  double dark = 0, bright = 0;
};

/// The image that edges are looked for in; its gradients are per voxel.
Volume smoothed_in_voxels(const VolumeView& volume) {
  Volume smooth =
      gaussian_smoothed({volume, {volume.samples.begin(), volume.samples.end()}}, kEdgeScale);
  smooth.spacing = {1, 1, 1};
  return smooth;
}

/// Looks for the edges of an image.
class EdgeFinder {
 public:
  EdgeFinder(const VolumeView& volume, const ObjectContrast& contrast, double noise)
      : volume_(volume),
        smoothed_(smoothed_in_voxels(volume)),
        smooth_(smoothed_),
        steepness_{volume, std::vector<float>(volume.samples.size())},
        image_(volume_),
        slopes_(steepness_),
        background_(contrast.background),
        contrast_(contrast.difference()),
        least_(std::max(kLeastOfContrast * contrast_, kLeastOfNoise * noise)) {
    for_each_voxel([&](Index i, Index j, Index k) {
      steepness_.samples[volume_.offset(i, j, k)] =
          static_cast<float>(norm(gradient_at(smooth_, i, j, k)));
    });
  }

  template <class Visit>
  void for_each_voxel(Visit&& visit) const {
    parallel_for(static_cast<std::size_t>(volume_.size[2]), [&](std::size_t k) {
      for (Index j = 0; j < volume_.size[1]; ++j) {
        for (Index i = 0; i < volume_.size[0]; ++i) visit(i, j, static_cast<Index>(k));
      }
    });
  }

  /// @return equal sides where there is none.
  Sides at(Index i, Index j, Index k) const {
    const double steep = steepness_.samples[volume_.offset(i, j, k)];
    // A blurred step of the least height rises by about a sixth of it per voxel.
    if (steep < least_ / 6) return {};
    const Vec3 here{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
    const Vec3 up = unit_or_zero(gradient_at(smooth_, i, j, k));
    if (slopes_.at(here + up) > steep || slopes_.at(here - up) > steep) {
      return {};
    }
    const double middle = volume_.samples[volume_.offset(i, j, k)];
    Sides sides{middle, middle};
    for (const double t : {0.5, 1.0, 1.5, 2.0}) {
      sides.bright = std::max(sides.bright, image_.at(here + t * up));
      sides.dark = std::min(sides.dark, image_.at(here - t * up));
    }
    return counts(sides) && are_thick(sides, here, up) ? sides : Sides{};
  }

 private:
  /// Whether each side stays on its side of the middle, as far as thin walls and clefts do not: the
  /// blur keeps these from their own value.
  bool are_thick(const Sides& sides, const Vec3& here, const Vec3& up) const {
    const double middle = (sides.bright + sides.dark) / 2;
    for (double t = 1; t <= kThick; t += 0.5) {
      if (image_.at(here + t * up) < middle) return false;
      if (image_.at(here - t * up) > middle) return false;
    }
    return true;
  }

  bool counts(const Sides& sides) const {
    const double dark = (sides.dark - background_) / contrast_;
    return sides.bright - sides.dark > least_ && dark > kDarkest && dark < kBrightest &&
           sides.bright > background_ + kLeastOfContrast * contrast_;
  }

  const VolumeView& volume_;
  Volume smoothed_;
  VolumeView smooth_;
  Volume steepness_;
  Trilinear image_, slopes_;
  double background_, contrast_, least_;
};

/// How much of the local levels counts, 0 to 1: where they hardly differ, they are one.
/// @param excess    of each voxel, native units.
/// @param at_edges  the voxels that lie on edges.
double share_that_counts(const Volume& excess, const std::vector<std::size_t>& at_edges,
                         double contrast) {
  double sum = 0, squares = 0;
  for (const std::size_t n : at_edges) {
    const double level = excess.samples[n] / contrast;
    sum += level;
    squares += level * level;
  }
  const auto count = static_cast<double>(at_edges.size());
  const double variance = squares / count - (sum / count) * (sum / count);
  const double deviation = std::sqrt(std::max(variance, 0.0));
  return std::clamp((deviation - kOneLevel) / (kManyLevels - kOneLevel), 0.0, 1.0);
}

}  // namespace

LocalLevel find_local_level(const VolumeView& volume, const ObjectContrast& contrast, double level,
                            double noise) {
  const double most = kMostOfContrast * contrast.difference();
  Volume weight{volume, std::vector<float>(volume.samples.size(), 0)}, pulled = weight;
  const EdgeFinder edges(volume, contrast, noise);
  edges.for_each_voxel([&](Index i, Index j, Index k) {
    const Sides sides = edges.at(i, j, k);
    if (!(sides.bright > sides.dark)) return;
    const std::size_t n = volume.offset(i, j, k);
    const double w = std::min(sides.bright - sides.dark, most);
    weight.samples[n] = static_cast<float>(w);
    pulled.samples[n] = static_cast<float>(w * ((sides.bright + sides.dark) / 2 - level));
  });
  LocalLevel local;
  std::vector<float> weights;
  std::vector<std::size_t> at_edges;
  for (std::size_t n = 0; n < weight.samples.size(); ++n) {
    if (!(weight.samples[n] > 0)) continue;
    weights.push_back(weight.samples[n]);
    at_edges.push_back(n);
  }
  local.range = {level, level};
  local.edge_share =
      static_cast<double>(at_edges.size()) / static_cast<double>(weight.samples.size());
  local.excess = std::move(pulled);
  if (at_edges.empty()) return local;
  const double pull = kPull * quantiles(weights, {0.5})[0];
  const WeightedMeans means(local.excess, std::move(weight), kSpread, pull);
  std::vector<float>& excess = local.excess.samples;
  parallel_for(excess.size(), [&](std::size_t n) { excess[n] = static_cast<float>(means.at(n)); });
  const auto share =
      static_cast<float>(share_that_counts(local.excess, at_edges, contrast.difference()));
  parallel_for(excess.size(), [&](std::size_t n) { excess[n] *= share; });
  std::vector<float> levels;
  levels.reserve(at_edges.size());
  for (const std::size_t n : at_edges) levels.push_back(excess[n]);
  const auto ends = quantiles(levels, {0.05, 0.95});
  local.range = {level + ends[0], level + ends[1]};
  return local;
}

void take_off(const LocalLevel& local, Volume& volume) {
  parallel_for(volume.samples.size(),
               [&](std::size_t n) { volume.samples[n] -= local.excess.samples[n]; });
}

}  // namespace mesamis::detail::restore
