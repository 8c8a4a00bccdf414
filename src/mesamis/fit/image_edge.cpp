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
/// Width of a side, voxels: wider ones are no sheet, narrower ones surely.
constexpr double kNoSheet = 4.2, kSureSheet = 3.2;
constexpr int kAcross = 22;  // samples from a sheet's middle to its other face
/// How far beyond the sheets' level a side reaches that tells nothing of it, and one that does; of
/// the sheets' contrast.
constexpr double kAtLevel = 0.1, kBeyondLevel = 0.2;

/// Samples along a normal, turned so that they fall outwards. Those near the point are kept.
class Profile {
 public:
  Profile(const FollowSpace& space, const Vec3& point, const Vec3& normal, double contrast,
          int reach)
      : space_(space),
        point_(point),
        normal_(normal),
        sign_(contrast > 0 ? 1 : -1),
        middle_(reach + kSides) {
    values_.reserve(2 * static_cast<std::size_t>(middle_) + 1);
    for (int i = -middle_; i <= middle_; ++i) values_.push_back(value_at(i));
  }

  double at(int i) const {
    if (std::abs(i) > middle_) return value_at(i);
    return values_[static_cast<std::size_t>(i) + static_cast<std::size_t>(middle_)];
  }
  double turned(double value) const { return sign_ * value; }
  /// Outwards, per voxel.
  double fall(int i) const { return (at(i - 1) - at(i + 1)) / (2 * kStep); }

 private:
  double value_at(int i) const {
    return turned(space_.value_at(point_ + (i * kStep * space_.voxel()) * normal_));
  }

  const FollowSpace& space_;
  Vec3 point_, normal_;
  double sign_;
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

/// Behind a place, or in front of it.
enum class Side { kBehind = -1, kInFront = 1 };

/// The sample of a side that differs most from the other one.
int extreme_sample(const Profile& profile, int place, Side side) {
  const int way = static_cast<int>(side);
  int best = place;
  for (int i = place; std::abs(i - place) <= kSides; i += way) {
    if (way * (profile.at(i) - profile.at(best)) < 0) best = i;
  }
  return best;
}

/// How surely a side is a sheet, and reaches beyond the sheets' level, 0 to 1.
/// @param extreme  sample of the side.
/// @param level    between the sides.
double sheet_share(const Profile& profile, int extreme, double level, Side side,
                   const SheetLevel& sheets) {
  const int way = static_cast<int>(side);
  const double beyond =
      way * (profile.turned(sheets.level) - profile.at(extreme)) / sheets.contrast;
  if (beyond <= kAtLevel) return 0;
  const auto belongs = [&](int i) { return way * (profile.at(i) - level) < 0; };
  int first = extreme, last = extreme;
  while (first > extreme - kAcross && belongs(first)) --first;
  while (last < extreme + kAcross && belongs(last)) ++last;
  const double width = kStep * (last - first);
  return std::clamp((kNoSheet - width) / (kNoSheet - kSureSheet), 0.0, 1.0) *
         std::min((beyond - kAtLevel) / (kBeyondLevel - kAtLevel), 1.0);
}

/// The level at which an edge lies: half way between its sides, or that of the sheets.
double level_at(const Profile& profile, int place, const SheetLevel& sheets) {
  const int inside = extreme_sample(profile, place, Side::kBehind),
            outside = extreme_sample(profile, place, Side::kInFront);
  const double half = (profile.at(inside) + profile.at(outside)) / 2;
  if (!(sheets.contrast > 0)) return half;
  const double missing = profile.turned(sheets.level) - half;
  const double share = missing > 0 ? sheet_share(profile, inside, half, Side::kBehind, sheets)
                                   : sheet_share(profile, outside, half, Side::kInFront, sheets);
  return half + share * missing;
}

/// Where the image crosses the level of its edge, in samples.
double crossing_near(const Profile& profile, int place, const SheetLevel& sheets) {
  const double level = level_at(profile, place, sheets);
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
                          const EdgeSearch& search) {
  const auto& [contrast, reach, sheets] = search;
  const int samples = std::max(1, static_cast<int>(std::lround(reach / kStep)));
  const Profile profile(space, point, normal, contrast, samples);
  const int place = steepest_place(profile, std::abs(contrast), samples);
  if (std::abs(place) == samples) return {};
  const double slope = profile.fall(place) / std::abs(contrast);
  const double distance = kStep * crossing_near(profile, place, sheets);
  if (!(std::abs(distance) < reach)) return {};
  return {distance, std::clamp((slope - kNoSlope) / (kSureSlope - kNoSlope), 0.0, 1.0)};
}

}  // namespace mesamis::detail::fit
