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
#include "mesamis/restore/spread_voxels.h"

namespace mesamis::detail::restore {
namespace {

constexpr double kEdgeScale = 0.8;  // voxels, of the gradient
constexpr double kSpread = 3;       // voxels, of the mean over edges
/// Voxels from an edge to where its sides have their value, and of the contrast, how exactly.
constexpr double kBesideEdge = 3, kLevelSide = 0.25;
constexpr double kThick = 4;  // voxels, of both sides of an edge that counts
constexpr double kLeastOfContrast = 0.1, kLeastOfNoise = 5, kMostOfContrast = 0.6;
/// The dark side of an edge against the object's background, of its contrast.
constexpr double kDarkest = -0.25, kBrightest = 0.35;
/// Edges, in the mean around a voxel, that the object's level weighs as much as: it is that of places
/// far from all edges. The mean on a flat edge, where it shall weigh nothing: 1 / (sqrt(2 pi) kSpread).
constexpr double kPull = 0.02, kOfFlatEdge = 0.133;
constexpr double kLeastWeight = 1e-6;  // of edges that are told from none
/// Standard deviations of the local level, of the contrast: up to the first it is the scatter of one
/// level, from the second on each place has its own.
constexpr double kOneLevel = 0.06, kManyLevels = 0.12;
/// Voxels, along each axis, over which a part of low density belongs to what is beside it.
constexpr Index kNear = 2;

/// What counts as even tissue, of the contrast about the background. Of the deviations there the
/// quantile that no anatomy has raised.
constexpr double kEven = 0.25, kQuiet = 0.25;
constexpr std::size_t kLookedAt = 50'000;  // voxels, about

/// The standard deviation of a voxel inside the grid and the 26 around it.
double deviation_around(const VolumeView& volume, Index i, Index j, Index k) {
  double sum = 0, squares = 0;
  for (Index c = k - 1; c <= k + 1; ++c) {
    for (Index b = j - 1; b <= j + 1; ++b) {
      for (Index a = i - 1; a <= i + 1; ++a) {
        const double f = volume.at(a, b, c);
        sum += f;
        squares += f * f;
      }
    }
  }
  return std::sqrt(std::max(squares / 27 - (sum / 27) * (sum / 27), 0.0));
}

/// The standard deviation in even tissue, native units: what undoing the blur has made of noise that
/// neighbours share. 0: there is no such tissue.
double noise_in_even_tissue(const VolumeView& volume, const ObjectContrast& contrast) {
  std::vector<float> deviations;
  for (const auto& [i, j, k] : spread_voxels(volume, kLookedAt)) {
    const double above = volume.at(i, j, k) - contrast.background;
    if (std::abs(above) > kEven * contrast.difference()) continue;
    deviations.push_back(static_cast<float>(deviation_around(volume, i, j, k)));
  }
  return deviations.empty() ? 0 : quantiles(deviations, {kQuiet})[0];
}

/// An edge and its two sides, native units.
struct Edge {
  std::size_t voxel = 0;
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
        least_(std::max(kLeastOfContrast * contrast_,
                        kLeastOfNoise * std::max(noise, noise_in_even_tissue(volume, contrast)))) {
    for_each_slice([&](Index k) {
      for_each_voxel_in(k, [&](Index i, Index j, std::size_t voxel) {
        steepness_.samples[voxel] = static_cast<float>(norm(gradient_at(smooth_, i, j, k)));
      });
    });
  }

  /// All edges, in the order of the voxels.
  std::vector<Edge> all() const {
    std::vector<std::vector<Edge>> slices(static_cast<std::size_t>(volume_.size[2]));
    for_each_slice([&](Index k) {
      for_each_voxel_in(k, [&](Index i, Index j, std::size_t voxel) {
        const Edge edge = at(i, j, k, voxel);
        if (edge.bright > edge.dark) slices[static_cast<std::size_t>(k)].push_back(edge);
      });
    });
    std::vector<Edge> edges;
    for (const std::vector<Edge>& slice : slices) {
      edges.insert(edges.end(), slice.begin(), slice.end());
    }
    return edges;
  }

 private:
  template <class Visit>
  void for_each_slice(Visit&& visit) const {
    parallel_for(static_cast<std::size_t>(volume_.size[2]),
                 [&](std::size_t k) { visit(static_cast<Index>(k)); });
  }

  template <class Visit>
  void for_each_voxel_in(Index k, Visit&& visit) const {
    for (Index j = 0; j < volume_.size[1]; ++j) {
      for (Index i = 0; i < volume_.size[0]; ++i) visit(i, j, volume_.offset(i, j, k));
    }
  }

  /// @return equal sides where there is none.
  Edge at(Index i, Index j, Index k, std::size_t voxel) const {
    const double steep = steepness_.samples[voxel];
    // A blurred step of the least height rises by about a sixth of it per voxel.
    if (steep < least_ / 6) return {};
    const Vec3 here{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
    const Vec3 up = unit_or_zero(gradient_at(smooth_, i, j, k));
    if (slopes_.at(here + up) > steep || slopes_.at(here - up) > steep) {
      return {};
    }
    const double middle = volume_.samples[voxel];
    Edge edge{voxel, middle, middle};
    for (const double t : {0.5, 1.0, 1.5, 2.0}) {
      edge.bright = std::max(edge.bright, image_.at(here + t * up));
      edge.dark = std::min(edge.dark, image_.at(here - t * up));
    }
    return counts(edge) && are_level(edge, here, up) && are_thick(edge, here, up) ? edge : Edge{};
  }

  /// Whether the sides have come to an end: skin that falls to air within more than two voxels would
  /// be taken for bone against soft tissue.
  bool are_level(const Edge& edge, const Vec3& here, const Vec3& up) const {
    const double most = kLevelSide * (edge.bright - edge.dark);
    return image_.at(here - kBesideEdge * up) > edge.dark - most &&
           image_.at(here + kBesideEdge * up) < edge.bright + most;
  }

  /// Whether each side stays on its side of the middle, as far as thin walls and clefts do not: the
  /// blur keeps these from their own value.
  bool are_thick(const Edge& edge, const Vec3& here, const Vec3& up) const {
    const double middle = (edge.bright + edge.dark) / 2;
    for (double t = 1; t <= kThick; t += 0.5) {
      if (image_.at(here + t * up) < middle) return false;
      if (image_.at(here - t * up) > middle) return false;
    }
    return true;
  }

  bool counts(const Edge& edge) const {
    const double dark = (edge.dark - background_) / contrast_;
    return edge.bright - edge.dark > least_ && dark > kDarkest && dark < kBrightest &&
           edge.bright > background_ + least_;
  }

  const VolumeView& volume_;
  Volume smoothed_;
  VolumeView smooth_;
  Volume steepness_;
  Trilinear image_, slopes_;
  double background_, contrast_, least_;
};

/// Visits a voxel and those near it.
template <class Visit>
void for_each_near(const VoxelGrid& grid, std::size_t voxel, Visit&& visit) {
  const auto [nx, ny, nz] = grid.size;
  const auto [i, j, k] = grid.voxel(voxel);
  for (Index c = std::max<Index>(k - kNear, 0); c <= std::min(k + kNear, nz - 1); ++c) {
    for (Index b = std::max<Index>(j - kNear, 0); b <= std::min(j + kNear, ny - 1); ++b) {
      for (Index a = std::max<Index>(i - kNear, 0); a <= std::min(i + kNear, nx - 1); ++a) {
        visit(grid.offset(a, b, c));
      }
    }
  }
}

/// The mean excess over a level of the edges around each voxel, native units.
Volume mean_excess(const std::vector<Edge>& edges, const VoxelGrid& grid, double level,
                   double contrast) {
  Volume counts{grid, std::vector<float>(grid.voxel_count(), 0)}, weights = counts;
  Volume weighted = counts;
  for (const Edge& edge : edges) {
    const double weight = std::min(edge.bright - edge.dark, kMostOfContrast * contrast) / contrast;
    const double above = (edge.bright + edge.dark) / 2 - level;
    weights.samples[edge.voxel] = static_cast<float>(weight);
    weighted.samples[edge.voxel] = static_cast<float>(weight * above);
    counts.samples[edge.voxel] = 1;
  }
  const WeightedMeans means(std::move(weighted), std::move(weights), kSpread, kLeastWeight);
  Volume excess = gaussian_smoothed(std::move(counts), kSpread);
  parallel_for(excess.samples.size(), [&](std::size_t n) {
    const double count = excess.samples[n];
    const double share = std::min(1.0, count / (count + kPull) * (1 + kPull / kOfFlatEdge));
    excess.samples[n] = static_cast<float>(means.at(n) * share);
  });
  return excess;
}

/// How much of the local levels counts, 0 to 1: where they hardly differ, they are one.
/// @param excess  of each voxel, native units.
double share_that_counts(const Volume& excess, const std::vector<Edge>& edges, double contrast) {
  double sum = 0, squares = 0;
  for (const Edge& edge : edges) {
    const double level = excess.samples[edge.voxel] / contrast;
    sum += level;
    squares += level * level;
  }
  const auto count = static_cast<double>(edges.size());
  const double variance = squares / count - (sum / count) * (sum / count);
  const double deviation = std::sqrt(std::max(variance, 0.0));
  return std::clamp((deviation - kOneLevel) / (kManyLevels - kOneLevel), 0.0, 1.0);
}

/// Gives parts that nowhere reach the object's level that level back: ears, and vessels full of
/// contrast agent, have edges too. A part is what lies above its local level, without a gap of more
/// than a voxel.
void drop_parts_below(double level, const VolumeView& image, Volume& excess) {
  const std::span<const float> samples = image.samples;
  std::vector<float>& above = excess.samples;
  const auto is_object = [&](std::size_t n) { return samples[n] - above[n] > level; };
  std::vector<unsigned char> reaches(samples.size(), 0);
  std::vector<std::size_t> front;
  const auto reach = [&](std::size_t n) {
    if (reaches[n] != 0 || !is_object(n)) return;
    reaches[n] = 1;
    front.push_back(n);
  };
  for (std::size_t n = 0; n < samples.size(); ++n) {
    if (samples[n] > level) reach(n);
    while (!front.empty()) {
      const std::size_t here = front.back();
      front.pop_back();
      for_each_near(image, here, reach);
    }
  }
  parallel_for(samples.size(), [&](std::size_t n) {
    if (reaches[n] == 0 && is_object(n)) above[n] = 0;
  });
}

}  // namespace

LocalLevel find_local_level(const VolumeView& volume, const ObjectContrast& contrast, double level,
                            const LocalLevelOptions& options) {
  const std::vector<Edge> edges = EdgeFinder(volume, contrast, options.noise).all();
  LocalLevel local;
  local.edge_share = static_cast<double>(edges.size()) / static_cast<double>(volume.samples.size());
  if (edges.empty()) return local;
  Volume excess = mean_excess(edges, volume, level, contrast.difference());
  local.share =
      options.share ? *options.share : share_that_counts(excess, edges, contrast.difference());
  if (local.share == 0) return local;
  const auto share = static_cast<float>(local.share);
  parallel_for(excess.samples.size(), [&](std::size_t n) { excess.samples[n] *= share; });
  drop_parts_below(level, volume, excess);
  std::vector<float> levels;
  levels.reserve(edges.size());
  for (const Edge& edge : edges) levels.push_back(excess.samples[edge.voxel]);
  const auto ends = quantiles(levels, {0.05, 0.95});
  local.range = {level + ends[0], level + ends[1]};
  local.excess = std::move(excess);
  return local;
}

bool is_likely_bone(const VolumeView& volume, double level) {
  constexpr double kLeastHu = 100;  // surfaces of the skin and of organs lie at less
  return level >= kLeastHu && is_hounsfield(volume);
}

void take_off(const VolumeView& excess, Volume& volume) {
  if (excess.samples.empty()) return;
  parallel_for(volume.samples.size(),
               [&](std::size_t n) { volume.samples[n] -= excess.samples[n]; });
}

}  // namespace mesamis::detail::restore
