// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_resample.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/scan_file.h"

namespace mesamis::detail::volume_files {
namespace {

constexpr double kSmallestShare = 0.25;  // of the median distance, between planes
constexpr double kRoundOff = 1e-6;       // of a pixel or a plane: places count as whole numbers

template <class Check>
bool passes(const Check& check) {
  try {
    check();
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Shifts of the slices against the first, pixels; the least of each direction is made 0.
/// @return what was taken off, pixels.
std::array<double, 2> set_shifts(const SortedSlices& sorted, ResamplePlan& plan) {
  const DicomSlice& first = sorted.slices.front();
  const Vec3 along_row = unit_or_zero(first.along_row);
  const Vec3 along_column = unit_or_zero(first.along_column);
  std::array<double, 2> least{0, 0};
  for (const DicomSlice& slice : sorted.slices) {
    const Vec3 d = slice.position - first.position;
    plan.shift.push_back({plan.tilted ? dot(d, along_row) / first.column_step : 0,
                          plan.tilted ? dot(d, along_column) / first.row_step : 0});
    for (std::size_t a = 0; a < 2; ++a) least[a] = std::min(least[a], plan.shift.back()[a]);
  }
  for (auto& shift : plan.shift) {
    for (std::size_t a = 0; a < 2; ++a) shift[a] -= least[a];
  }
  return least;
}

/// How many more pixels the shifted slices take.
std::int64_t more_pixels(const ResamplePlan& plan, std::size_t direction) {
  double most = 0;
  for (const auto& shift : plan.shift) most = std::max(most, shift[direction]);
  constexpr double kFarTooMany = 1e12;  // refused with the grid's size
  return static_cast<std::int64_t>(std::ceil(std::clamp(most - kRoundOff, 0.0, kFarTooMany)));
}

/// How many planes there are over a range of unevenly spaced slices, mm.
/// @param gaps  distances of neighbours, mm, ascending.
double plane_count(double range, const std::vector<double>& gaps) {
  const double median = gaps[(gaps.size() - 1) / 2];
  return std::round(range / std::max(gaps.front(), kSmallestShare * median)) + 1;
}

/// Positions in a file's header must not take memory that its samples do not justify.
void require_justified(const std::filesystem::path& path, const SortedSlices& sorted,
                       const VoxelGrid& grid) {
  constexpr double kMostGrowth = 64;
  const DicomSlice& first = sorted.slices.front();
  const double stored =
      1.0 * first.columns * first.rows * static_cast<double>(sorted.slices.size());
  const double wanted = 1.0 * grid.size[0] * grid.size[1] * grid.size[2];
  if (wanted <= kMostGrowth * stored) return;
  refuse(path, message("expected a regular grid of at most ", kMostGrowth, " times the ", stored,
                       " samples of the slices, found ", wanted, " voxels"));
}

void note_tilt(const SortedSlices& sorted, ResamplePlan& plan) {
  const DicomSlice &first = sorted.slices.front(), &last = sorted.slices.back();
  const Vec3 d = last.position - first.position;
  const double rise = dot(d, sorted.normal), shift = norm(d - rise * sorted.normal);
  plan.notes.push_back(message(
      "gantry tilt of ", std::atan2(shift, rise) * 180 / std::numbers::pi,
      " degrees: slices shifted by up to ", shift,
      " mm onto a straight grid, linear between pixels, which blurs by up to half a pixel; what no "
      "slice covers has the least value"));
}

/// @param gaps  distances of neighbours, mm, ascending.
void note_uneven(const std::vector<double>& gaps, ResamplePlan& plan) {
  plan.notes.push_back(message("slices ", gaps.front(), " to ", gaps.back(),
                               " mm apart: resampled to ", plan.grid.spacing.z,
                               " mm, linear between slices; no plane is farther than ",
                               gaps.back() / 2, " mm from a slice"));
}

/// A slice as a function of the place in it.
class Slice {
 public:
  Slice(const float* samples, const std::array<int, 2>& size) : samples_(samples), size_(size) {}

  /// Linear between pixels; false outside.
  bool at(double x, double y, double& value) const {
    if (x < -kRoundOff || y < -kRoundOff || x > size_[0] - 1 + kRoundOff ||
        y > size_[1] - 1 + kRoundOff) {
      return false;
    }
    const int i = cell(x, 0), j = cell(y, 1);
    const double s = fraction(x - i), t = fraction(y - j);
    value = (1 - t) * line(i, j, s) + (t > 0 ? t * line(i, j + 1, s) : 0);
    return true;
  }

 private:
  static double fraction(double t) { return t < kRoundOff ? 0 : std::min(t, 1.0); }
  int cell(double x, std::size_t direction) const {
    return std::clamp(static_cast<int>(x), 0, std::max(0, size_[direction] - 2));
  }
  double line(int i, int j, double s) const {
    const float* at = samples_ + static_cast<std::ptrdiff_t>(j) * size_[0] + i;
    return (1 - s) * static_cast<double>(at[0]) + (s > 0 ? s * static_cast<double>(at[1]) : 0);
  }

  const float* samples_;
  std::array<int, 2> size_;
};

/// A plane between two slices.
struct Between {
  std::size_t below, above;
  double weight;  ///< of the one above
};

Between slices_around(const std::vector<double>& planes, double k) {
  const auto after = std::upper_bound(planes.begin(), planes.end(), k + kRoundOff);
  const auto above = std::min(static_cast<std::size_t>(after - planes.begin()), planes.size() - 1);
  const std::size_t below = above == 0 ? 0 : above - 1;
  const double gap = planes[above] - planes[below];
  const double weight = gap > 0 ? (k - planes[below]) / gap : 0;
  return {below, above, weight < kRoundOff ? 0 : weight > 1 - kRoundOff ? 1 : weight};
}

}  // namespace

ResamplePlan plan_resampling(const std::filesystem::path& path, const SortedSlices& sorted) {
  for (std::size_t n = 1; n < sorted.height.size(); ++n) require_apart(path, sorted, n);
  ResamplePlan plan;
  plan.uneven = !passes([&] { require_even_spacing(path, sorted); });
  plan.tilted = !passes([&] { require_no_tilt(path, sorted); });
  const auto moved = set_shifts(sorted, plan);
  const DicomSlice& first = sorted.slices.front();
  ScanFile scan{path, "DICOM", {}, {}, {}};
  const double range = sorted.height.back() - sorted.height.front();
  std::vector<double> gaps = gaps_of(sorted);
  std::sort(gaps.begin(), gaps.end());
  const double planes =
      plan.uneven ? plane_count(range, gaps) : static_cast<double>(sorted.height.size());
  constexpr double kMostPlanes = 1e6;
  if (!(planes <= kMostPlanes))
    refuse(path, message("expected at most 1e6 planes, found ", planes));
  set_size(scan, {first.columns + more_pixels(plan, 0), first.rows + more_pixels(plan, 1),
                  static_cast<std::int64_t>(planes)});
  const double spacing = range / (planes - 1);
  const auto steps = grid_steps(first, spacing * sorted.normal);
  set_axes(scan, steps);
  set_origin(scan, first.position + moved[0] * steps[0] + moved[1] * steps[1]);
  require_justified(path, sorted, scan.grid);
  plan.grid = scan.grid;
  for (std::size_t n = 0; n < sorted.height.size(); ++n) {
    plan.plane.push_back(plan.uneven ? (sorted.height[n] - sorted.height.front()) / spacing
                                     : static_cast<double>(n));
  }
  if (plan.tilted) note_tilt(sorted, plan);
  if (plan.uneven) note_uneven(gaps, plan);
  return plan;
}

std::vector<float> resampled(const ResamplePlan& plan, const std::array<int, 2>& columns_rows,
                             const std::vector<float>& samples) {
  const VoxelGrid& grid = plan.grid;
  const std::size_t pixels =
      static_cast<std::size_t>(columns_rows[0]) * static_cast<std::size_t>(columns_rows[1]);
  const float beyond = *std::min_element(samples.begin(), samples.end());
  std::vector<float> out(grid.voxel_count());
  parallel_for_each(static_cast<std::size_t>(grid.size[2]), [&](std::size_t k) {
    const auto [below, above, weight] = slices_around(plan.plane, static_cast<double>(k));
    const Slice low(samples.data() + below * pixels, columns_rows);
    const Slice high(samples.data() + above * pixels, columns_rows);
    float* at = out.data() + grid.offset(0, 0, static_cast<Index>(k));
    for (Index j = 0; j < grid.size[1]; ++j) {
      for (Index i = 0; i < grid.size[0]; ++i, ++at) {
        double a = 0, b = 0;
        const bool inside =
            (weight == 1 || low.at(i - plan.shift[below][0], j - plan.shift[below][1], a)) &&
            (weight == 0 || high.at(i - plan.shift[above][0], j - plan.shift[above][1], b));
        *at = inside ? static_cast<float>((1 - weight) * a + weight * b) : beyond;
      }
    }
  });
  return out;
}

}  // namespace mesamis::detail::volume_files
