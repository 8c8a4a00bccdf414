// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/image_edge.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mesamis::detail::fit {
namespace {

constexpr double kStep = 0.2;  // voxels between the samples along a normal
constexpr int kSides = 10;     // samples in which the two sides of an edge are looked for
constexpr double kNoSlope = 0.1, kSureSlope = 0.4;  // of the contrast, per voxel: weights 0 and 1
/// By how much an edge at the ends must be steeper than one at the point; of the contrast, per
/// voxel.
constexpr double kFarther = 0.25;

/// Samples along a normal, turned so that they fall outwards.
class Profile {
 public:
  Profile(const FollowSpace& space, const Vec3& point, const Vec3& normal, double contrast,
          int reach)
      : middle_(reach + kSides) {
    const double sign = contrast > 0 ? 1 : -1;
    for (int i = -middle_; i <= middle_; ++i) {
      values_.push_back(sign * space.value_at(point + (i * kStep * space.voxel()) * normal));
    }
  }

  double at(int i) const {
    return values_[static_cast<std::size_t>(i) + static_cast<std::size_t>(middle_)];
  }
  /// Outwards, per voxel.
  double fall(int i) const { return (at(i - 1) - at(i + 1)) / (2 * kStep); }

 private:
  int middle_;
  std::vector<double> values_;
};

int steepest_place(const Profile& profile, double contrast, int reach) {
  int best = 0;
  double most = profile.fall(0);
  for (int i = -reach; i <= reach; ++i) {
    const double far = static_cast<double>(i) / reach;
    const double worth = profile.fall(i) - kFarther * contrast * far * far;
    if (worth > most) {
      most = worth;
      best = i;
    }
  }
  return best;
}

/// Where the image crosses the mean of its two sides, in samples.
double crossing_near(const Profile& profile, int place) {
  double inside = profile.at(place), outside = inside;
  for (int i = 1; i <= kSides; ++i) {
    inside = std::max(inside, profile.at(place - i));
    outside = std::min(outside, profile.at(place + i));
  }
  const double level = (inside + outside) / 2;
  const int step = profile.at(place) > level ? 1 : -1;
  for (int i = place; std::abs(i - place) < kSides; i += step) {
    const double here = profile.at(i), next = profile.at(i + step);
    if ((here - level) * (next - level) > 0) continue;
    return here == next ? i : i + step * (here - level) / (here - next);
  }
  return place;
}

}  // namespace

ImageEdge find_image_edge(const FollowSpace& space, const Vec3& point, const Vec3& normal,
                          double contrast, double reach) {
  const int samples = std::max(1, static_cast<int>(std::lround(reach / kStep)));
  const Profile profile(space, point, normal, contrast, samples);
  const int place = steepest_place(profile, std::abs(contrast), samples);
  if (std::abs(place) == samples) return {};
  const double slope = profile.fall(place) / std::abs(contrast);
  const double distance = kStep * crossing_near(profile, place);
  if (!(std::abs(distance) < reach)) return {};
  return {distance, std::clamp((slope - kNoSlope) / (kSureSlope - kNoSlope), 0.0, 1.0)};
}

}  // namespace mesamis::detail::fit
