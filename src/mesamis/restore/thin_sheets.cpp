// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/thin_sheets.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/image/gaussian.h"
#include "mesamis/image/spline_image.h"
#include "mesamis/restore/level_crossings.h"
#include "mesamis/restore/nearby_range.h"

namespace mesamis::detail::restore {
namespace {

constexpr double kLeastPeak = 0.15;  // of the contrast
constexpr double kMostPeak = 0.97;   // thicker sheets need no lift
/// Peaks of noise in the guide reach five of its deviations; a sheet must exceed them clearly.
constexpr double kPeakOfNoise = 9;
/// On both sides of a sheet the guide falls below this share of the peak.
constexpr double kFall = 0.6;
/// Where it is looked for, in deviations of the guide's blur, and the steps towards the peak.
constexpr double kReach = 2.5, kStep = 0.2;
constexpr int kMostSteps = 16;
/// How far the middle of a sheet rises above its faces, of the contrast: a flatter one would be
/// lost in noise, and to a level that is slightly off.
constexpr double kRise = 0.25, kMostGain = 2;
/// Walls that are found thinner than kThinnest voxels are drawn down to this share of their peak:
/// a thinner one would be full of holes, which the samples cannot show.
constexpr double kThinnest = 0.4, kThickEnough = 0.6, kLeastFace = 0.5;
/// The lift of walls is the mean of what the voxels around say, by a Gaussian of so many voxels.
constexpr double kWallSpread = 1.5;
/// Of the weight of a voxel: where fewer speak for a wall, there is none.
constexpr double kFewest = 0.02;
/// Brighter voxels (of the contrast) that are of no sheet speak against a lift.
constexpr double kBright = 0.7;
/// The gradients around agree if the second main direction has less than this share of the first.
constexpr double kLeastPlanar = 0.5, kPlanar = 0.7;

double normal_distribution(double t) { return 0.5 * std::erfc(-t / std::numbers::sqrt2); }

/// The t of 2 Phi(t / 2) - 1 = peak: thickness of a sheet in deviations of its blur.
double thickness_of(double peak) {
  double low = 0, high = 6;
  for (int n = 0; n < 30; ++n) {
    const double t = (low + high) / 2;
    (2 * normal_distribution(t / 2) - 1 < peak ? low : high) = t;
  }
  return low;
}

/// The restored image of a sheet of thickness t, of the contrast.
struct SheetProfile {
  double face = 0.5;  ///< E(t), at the faces
  double middle = 1;  ///< halfway between them
};

/// Between two tabulated values.
struct Between {
  std::size_t below;
  double share;  ///< of the one above

  /// @param x  in steps of the table; the last entry holds for what is beyond.
  Between(double x, std::size_t count)
      : below(static_cast<std::size_t>(x)), share(x - std::floor(x)) {
    if (below + 1 < count) return;
    below = count - 2;
    share = 1;
  }
  SheetProfile operator()(const SheetProfile& a, const SheetProfile& b) const {
    return {(1 - share) * a.face + share * b.face, (1 - share) * a.middle + share * b.middle};
  }
};

/// Profiles of sheets by their thickness and by the share of the blur's deviation that was undone,
/// which depends on the direction.
class SheetProfiles {
 public:
  explicit SheetProfiles(const std::optional<double>& regularization) {
    for (std::size_t m = 0; m < kShares; ++m) {
      const double undone = static_cast<double>(m) / (kShares - 1);
      for (std::size_t n = 0; n < kCount; ++n) {
        const double t = static_cast<double>(n) * kSpacing;
        tables_[m][n] = {seen_edge(t, undone, regularization),
                         2 * seen_edge(t / 2, undone, regularization)};
      }
      tables_[m][kCount - 1] = {};  // so thick that the blur hides nothing
    }
  }
  /// @param t  in deviations of the scan's blur, >= 0.
  /// @param undone  share of the blur's deviation, 0 to 1.
  SheetProfile at(double t, double undone) const {
    const Between by_thickness(t / kSpacing, kCount), by_share(undone * (kShares - 1), kShares);
    const auto in_table = [&](std::size_t m) {
      return by_thickness(tables_[m][by_thickness.below], tables_[m][by_thickness.below + 1]);
    };
    return by_share(in_table(by_share.below), in_table(by_share.below + 1));
  }

 private:
  static constexpr std::size_t kCount = 101, kShares = 9;
  static constexpr double kSpacing = 0.06;

  /// A box of width t, seen at its edge through the blur g and the filter W of deblurred():
  /// (1 / pi) times the integral of g W sin(k t) / k over the frequencies k.
  static double seen_edge(double t, double undone, const std::optional<double>& regularization) {
    constexpr double kEnd = 12, kDelta = 0.02;
    double sum = 0;
    for (double k = kDelta / 2; k < kEnd; k += kDelta) {
      const double g = std::exp(-k * k / 2);
      sum += g * filter_at(undone * k, regularization) * std::sin(k * t) / k * kDelta;
    }
    return sum / std::numbers::pi;
  }

  /// W, at a frequency in units of the blur that was undone.
  static double filter_at(double k, const std::optional<double>& regularization) {
    if (!regularization) return 1;
    const double lambda = k * k, g = std::exp(-lambda / 2);
    return g / (g * g + *regularization * lambda * lambda);
  }

  std::array<std::array<SheetProfile, kCount>, kShares> tables_{};
};

/// How far a sheet has to rise for its faces to have half of the contrast.
struct Lift {
  double rise = 0;    ///< of the contrast; negative: they are too high
  double weight = 0;  ///< 0 to 1: how surely there is a sheet, and how near to the voxel
  double gain = 1;    ///< of the distance from the half maximum, after the rise
};

/// What a voxel tells of the sheets at it.
struct Finding {
  Lift wall, gap;
  double gain() const { return std::max(wall.gain, gap.gain); }
};

/// The same in single precision, of a voxel of a slice: few voxels have one.
struct FoundAt {
  std::size_t voxel;  // of the slice
  float wall, weight, gap, gain;
};

/// The main direction of the gradients around a voxel and how well they agree.
struct Direction {
  Vec3 normal;
  double planarity;  ///< 0 to 1
};

Direction direction_at(const VolumeView& guide, const std::array<Index, 3>& voxel) {
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  std::array<Index, 3> low, high;
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = std::max(0, voxel[a] - 1);
    high[a] = std::min(guide.size[a] - 1, voxel[a] + 1);
  }
  for (Index k = low[2]; k <= high[2]; ++k) {
    for (Index j = low[1]; j <= high[1]; ++j) {
      for (Index i = low[0]; i <= high[0]; ++i) {
        const Vec3 g = gradient_at(guide, i, j, k);
        const Eigen::Vector3d v(g.x, g.y, g.z);
        tensor += v * v.transpose();
      }
    }
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(tensor);
  const auto& values = solver.eigenvalues();
  if (!(values[2] > 0)) return {{0, 0, 0}, 0};
  const Eigen::Vector3d v = solver.eigenvectors().col(2);
  return {{v[0], v[1], v[2]}, (values[2] - std::max(0.0, values[1])) / values[2]};
}

/// A sheet of the object, or of the background within it.
enum class SheetKind { kWall, kGap };

/// The highest value of a sheet along its normal.
struct Peak {
  double height = 0;    ///< of the contrast; 0: there is none
  double distance = 0;  ///< of the place looked at from it, mm
  Vec3 place{};         ///< mm
};

/// How far along each axis the way goes on which a peak is looked for and falls off, voxels: its
/// length depends on its direction n. With the share t of n_a^2 and the squares A of the guide's
/// blur along the axes, mm, n_a^2 sum_b n_b^2 A_b is at most t (t A_a + (1 - t) max A).
std::array<double, 3> farthest_looked_at(const VoxelGrid& grid,
                                         const std::array<double, 3>& blur_of_guide) {
  constexpr double kLongest = (kMostSteps + 1) * kStep + kReach;  // deviations
  std::array<double, 3> squares, reach;
  for (std::size_t a = 0; a < 3; ++a) {
    squares[a] = std::pow(blur_of_guide[a] * grid.spacing[static_cast<int>(a)], 2);
  }
  const double most = *std::max_element(squares.begin(), squares.end());
  for (std::size_t a = 0; a < 3; ++a) {
    const double own = squares[a];
    const double square = most <= 2 * own ? own : most * most / (4 * (most - own));
    reach[a] = kLongest * std::sqrt(square) / grid.spacing[static_cast<int>(a)];
  }
  return reach;
}

/// Looks for the sheets of a restored image.
class SheetFinder {
 public:
  SheetFinder(const VolumeView& restored, const VolumeView& guide, const SheetOptions& options)
      : guide_(guide),
        spline_(interpolating_spline(copy_volume(guide))),
        restored_(interpolating_spline(copy_volume(restored))),
        options_(options),
        profiles_(options.regularization),
        contrast_(options.contrast.difference()),
        near_(guide.size, spline_.coefficients, reach_of_ways()) {
    // The guide averages less at the border: there its noise is larger.
    within_ = {guide.spacing, guide.box().extent() - guide.spacing};
    const double left = std::pow(70.0 / 256, 1.5);  // of white noise, in the guide
    least_ = std::max(kLeastPeak, kPeakOfNoise * left * options.noise / contrast_);
  }

  /// @return nothing where no sheet can be.
  std::optional<Finding> at(const std::array<Index, 3>& voxel) const {
    const double share = share_of(guide_.at(voxel[0], voxel[1], voxel[2]));
    const std::optional<Finding> none;
    if (share < kFlank * least_ || share > 1 - kFlank * least_) return none;
    const NearbyRange::Range& near = near_.at(voxel[0], voxel[1], voxel[2]);
    const bool may_be_wall = may_hold_sheet(share_of(near.low), share_of(near.high));
    const bool may_be_gap = may_hold_sheet(1 - share_of(near.high), 1 - share_of(near.low));
    if (!may_be_wall && !may_be_gap) return none;
    const Direction way = direction_at(guide_, voxel);
    const double agree =
        std::clamp((way.planarity - kLeastPlanar) / (kPlanar - kLeastPlanar), 0.0, 1.0);
    if (agree == 0) return Finding{};
    const Vec3& s = guide_.spacing;
    const Vec3 p{voxel[0] * s.x, voxel[1] * s.y, voxel[2] * s.z};
    const Blur blur = blur_along(way.normal);
    const Start start = start_at(p, way.normal, kStep * blur.guide);
    const Finding found{may_be_wall ? lift(start, blur, SheetKind::kWall, agree) : Lift{},
                        may_be_gap ? lift(start, blur, SheetKind::kGap, agree) : Lift{}};
    return found.wall.weight == 0 && found.gap.weight == 0 ? none : found;
  }

 private:
  static constexpr double kFlank = 0.3;    // of the least peak: lower values belong to no sheet
  static constexpr double kOfGuide = 0.5;  // variance of smoothed(), voxels

  double share_of(double value) const { return (value - options_.contrast.background) / contrast_; }

  /// Whether values in a range can make a peak that counts and falls off. The spline never leaves
  /// the range of the coefficients around, but for round-off.
  bool may_hold_sheet(double low, double high) const {
    constexpr double kRoundOff = 1e-6;
    return high + kRoundOff >= least_ && low - kRoundOff <= kFall * kMostPeak;
  }

  std::array<double, 3> reach_of_ways() const {
    constexpr double kOfSpline = 2;  // voxels from which a value of the spline comes
    std::array<double, 3> blur;
    for (std::size_t a = 0; a < 3; ++a)
      blur[a] = std::sqrt(std::pow(options_.blur[a], 2) + kOfGuide);
    std::array<double, 3> reach = farthest_looked_at(guide_, blur);
    for (double& r : reach) r += kOfSpline;
    return reach;
  }

  /// Deviations of the blur along a direction, and a voxel, mm.
  struct Blur {
    double scan, undone, guide, voxel;
  };

  Blur blur_along(const Vec3& n) const {
    double scan = 0, undone = 0, guide = 0, voxel = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<int>(a);
      const double length = n[axis] * guide_.spacing[axis], blur = options_.blur[a];
      voxel += length * length;
      scan += length * length * blur * blur;
      undone += length * length * options_.undone[a] * options_.undone[a];
      guide += length * length * (blur * blur + kOfGuide);
    }
    return {std::sqrt(scan), std::sqrt(undone), std::sqrt(guide), std::sqrt(voxel)};
  }

  /// The guide's share of the contrast; in gaps what is missing of it.
  static double seen_as(SheetKind kind, double share) {
    return kind == SheetKind::kWall ? share : 1 - share;
  }
  double share_at(const Vec3& p, SheetKind kind) const {
    return seen_as(kind, share_of(spline_value_at(spline_, p)));
  }

  /// From where walls and gaps are looked for: a place, and the guide's shares there and a step up
  /// and down the normal.
  struct Start {
    Vec3 place, normal;
    double step;
    double here, up, down;
  };

  Start start_at(const Vec3& p, const Vec3& normal, double step) const {
    const auto share = [this](const Vec3& q) { return share_at(q, SheetKind::kWall); };
    return {p, normal, step, share(p), share(p + step * normal), share(p - step * normal)};
  }

  /// @param agree  the gradients around, 0 to 1.
  Lift lift(const Start& start, const Blur& blur, SheetKind kind, double agree) const {
    const Peak peak = find_peak(start, kind);
    if (peak.height < least_ || peak.height > kMostPeak) return {};
    const double thickness = thickness_of(peak.height) * blur.guide;
    const double scan = std::max(blur.scan, 0.05 * blur.guide);
    const SheetProfile seen = profiles_.at(thickness / scan, std::min(blur.undone / scan, 1.0));
    const double weight = agree * std::clamp((peak.height - least_) / (0.3 * least_), 0.0, 1.0) *
                          taper((peak.distance - thickness / 2) / blur.guide);
    const double gain = std::clamp(kRise / std::max(seen.middle - seen.face, 1e-3), 1.0, kMostGain);
    const double face =
        kind == SheetKind::kWall ? face_of_wall(seen, peak, thickness / blur.voxel) : seen.face;
    // Gaps of two voxels, which come out a little too wide, stay open.
    const double rise = kind == SheetKind::kWall ? 0.5 - face : std::max(0.0, 0.5 - face);
    return {rise, weight, 1 + (gain - 1) * weight};
  }

  /// What the faces of a wall have: less than E(t) where the image is below what it would be of a
  /// whole sheet of the object's value, as it is in less dense bone, and in sheets so thin that
  /// samples do not show them as a whole.
  double face_of_wall(const SheetProfile& seen, const Peak& peak, double voxels) const {
    const double middle = share_of(spline_value_at(restored_, peak.place));
    const double face = seen.face * std::clamp(middle / std::max(seen.middle, 1e-3), 0.0, 1.0);
    const double thin = std::clamp((kThickEnough - voxels) / (kThickEnough - kThinnest), 0.0, 1.0);
    return face + thin * std::min(0.0, kLeastFace * middle - face);
  }

  /// 1 within a sheet and at its faces, then down to 0.
  static double taper(double beyond) {
    constexpr double kWhole = 0.3, kNone = 1.8;  // deviations of the guide's blur
    const double share = std::clamp((beyond - kWhole) / (kNone - kWhole), 0.0, 1.0);
    return 0.5 + 0.5 * std::cos(std::numbers::pi * share);
  }

  /// Uphill to the peak, which counts if the guide falls off on both sides.
  Peak find_peak(const Start& start, SheetKind kind) const {
    const auto& [p, normal, step, here_share, up_share, down_share] = start;
    const double up = seen_as(kind, up_share), down = seen_as(kind, down_share);
    const Vec3 way = up >= down ? normal : -1.0 * normal;
    double before = std::min(up, down), here = seen_as(kind, here_share), next = std::max(up, down);
    int steps = 0;
    while (next > here) {
      if (++steps > kMostSteps) return {};
      before = here;
      here = next;
      next = share_at(p + (steps + 1) * step * way, kind);
    }
    if (here < least_) return {};
    // The vertex of the parabola through the three highest.
    const double bend = before - 2 * here + next;
    const double beside = bend < 0 ? std::clamp(0.5 * (before - next) / bend, -0.5, 0.5) : 0;
    const double distance = (steps + beside) * step;
    const Vec3 ridge = p + distance * way, reach = (kReach / kStep) * step * way;
    if (!within_.contains(ridge)) return {};
    const bool falls = falls_off(ridge, reach, kFall * here, kind) &&
                       falls_off(ridge, -1.0 * reach, kFall * here, kind);
    return falls ? Peak{here, std::abs(distance), ridge} : Peak{};
  }

  bool falls_off(const Vec3& ridge, const Vec3& reach, double below, SheetKind kind) const {
    for (const double share : {0.5, 0.75, 1.0}) {
      if (share_at(ridge + share * reach, kind) <= below) return true;
    }
    return false;
  }

  const VolumeView guide_;
  SplineImage spline_, restored_;
  SheetOptions options_;
  SheetProfiles profiles_;
  double contrast_, least_;
  NearbyRange near_;
  Box within_;
};

/// What is found of sheets in each slice, by increasing voxel.
std::vector<std::vector<FoundAt>> find_sheets(const SheetFinder& finder, const VoxelGrid& grid) {
  std::vector<std::vector<FoundAt>> slices(static_cast<std::size_t>(grid.size[2]));
  const std::size_t voxels = grid.voxel_count() / slices.size();  // of a slice
  parallel_for_each(slices.size(), [&](std::size_t k) {
    for (std::size_t n = 0; n < voxels; ++n) {
      const auto [i, j, first] = grid.voxel(n);
      const auto found = finder.at({i, j, first + static_cast<Index>(k)});
      if (!found) continue;
      const auto& [wall, gap] = *found;
      slices[k].push_back(
          {n, static_cast<float>(wall.weight * wall.rise), static_cast<float>(wall.weight),
           static_cast<float>(gap.weight * gap.rise), static_cast<float>(found->gain())});
    }
  });
  return slices;
}

/// How far the walls around each voxel have to rise, of the contrast.
WeightedMeans rises_of_walls(const std::vector<std::vector<FoundAt>>& slices,
                             const VolumeView& guide, const ObjectContrast& contrast) {
  Volume walls{guide, std::vector<float>(guide.samples.size())}, weights = walls;
  parallel_for(guide.samples.size(), [&](std::size_t n) {
    const double share = (guide.samples[n] - contrast.background) / contrast.difference();
    weights.samples[n] = share > kBright ? 1 : 0;
  });
  for (std::size_t k = 0; k < slices.size(); ++k) {
    const std::size_t first = guide.offset(0, 0, static_cast<Index>(k));
    for (const FoundAt& found : slices[k]) {
      walls.samples[first + found.voxel] = found.wall;
      weights.samples[first + found.voxel] = found.weight;
    }
  }
  return {std::move(walls), std::move(weights), kWallSpread, kFewest};
}

}  // namespace

void lift_thin_sheets(Volume& restored, const VolumeView& guide, const SheetOptions& options) {
  const auto slices = find_sheets(SheetFinder(restored, guide, options), restored);
  const WeightedMeans rises = rises_of_walls(slices, guide, options.contrast);
  const double contrast = options.contrast.difference(), half = options.contrast.half_maximum();
  parallel_for_each(slices.size(), [&](std::size_t k) {
    const std::size_t first = restored.offset(0, 0, static_cast<Index>(k)),
                      count = restored.samples.size() / slices.size();
    auto next = slices[k].begin();
    for (std::size_t voxel = 0; voxel < count; ++voxel) {
      const bool is_found = next != slices[k].end() && next->voxel == voxel;
      const double gain = is_found ? next->gain : 1;
      const double rise = rises.at(first + voxel) - (is_found ? next->gap : 0);
      if (is_found) ++next;
      if (rise == 0 && gain == 1) continue;
      float& value = restored.samples[first + voxel];
      value = static_cast<float>(half + gain * (value + contrast * rise - half));
    }
  });
}

}  // namespace mesamis::detail::restore
