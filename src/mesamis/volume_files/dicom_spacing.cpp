// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_spacing.h"

#include <algorithm>
#include <cmath>

#include "mesamis/files/refuse.h"

namespace mesamis::detail::volume_files {
namespace {

constexpr const char* kHint = " (--resample interpolates such stacks)";

/// The lower median.
double median_gap(std::vector<double> gaps) {
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>((gaps.size() - 1) / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  return *middle;
}

/// Those of slice n and of the one below it.
std::string names_around(const SortedSlices& sorted, std::size_t n) {
  return name_of(sorted.slices[n - 1]) + " and " + name_of(sorted.slices[n]);
}

}  // namespace

SortedSlices sort_along_normal(std::vector<DicomSlice> slices) {
  const Vec3 across = cross(slices[0].along_row, slices[0].along_column);
  SortedSlices sorted{std::move(slices), (1 / norm(across)) * across, {}};
  const Vec3 n = sorted.normal;
  std::stable_sort(sorted.slices.begin(), sorted.slices.end(),
                   [&n](const DicomSlice& a, const DicomSlice& b) {
                     return dot(a.position, n) < dot(b.position, n);
                   });
  for (const DicomSlice& slice : sorted.slices) sorted.height.push_back(dot(slice.position, n));
  return sorted;
}

double mean_spacing(const SortedSlices& sorted) {
  return (sorted.height.back() - sorted.height.front()) /
         static_cast<double>(sorted.height.size() - 1);
}

std::vector<double> gaps_of(const SortedSlices& sorted) {
  std::vector<double> gaps;
  for (std::size_t n = 1; n < sorted.height.size(); ++n) {
    gaps.push_back(sorted.height[n] - sorted.height[n - 1]);
  }
  return gaps;
}

void require_apart(const std::filesystem::path& path, const SortedSlices& sorted, std::size_t n) {
  const double gap = sorted.height[n] - sorted.height[n - 1];
  if (gap > kDuplicateDistance) return;
  refuse(path, message("expected one slice per position, found two at the same: ",
                       names_around(sorted, n), " (", gap, " mm apart)"));
}

void require_even_spacing(const std::filesystem::path& path, const SortedSlices& sorted) {
  const std::vector<double> gaps = gaps_of(sorted);
  const double median = median_gap(gaps);
  for (std::size_t n = 1; n < sorted.height.size(); ++n) {
    require_apart(path, sorted, n);
    const double gap = gaps[n - 1];
    if (std::abs(gap - median) <= kStepTolerance * median) continue;
    const double steps = gap / median;
    const bool missing = steps > 1.5 && std::abs(steps - std::round(steps)) < 0.1;
    refuse(path, message(missing ? "slices are missing" : "the slices are unevenly spaced",
                         " between ", names_around(sorted, n), ": expected ", median, " mm, found ",
                         gap, " mm", kHint));
  }
}

void require_no_tilt(const std::filesystem::path& path, const SortedSlices& sorted) {
  const DicomSlice& first = sorted.slices.front();
  const double median = median_gap(gaps_of(sorted));
  const double drift = kDriftTolerance * std::min({median, first.column_step, first.row_step});
  const auto lateral = [&sorted](const DicomSlice& a, const DicomSlice& b) {
    const Vec3 d = b.position - a.position;
    return norm(d - dot(d, sorted.normal) * sorted.normal);
  };
  for (std::size_t n = 1; n < sorted.slices.size(); ++n) {
    const DicomSlice& below = sorted.slices[n - 1];
    const DicomSlice& slice = sorted.slices[n];
    const double shift = lateral(below, slice), total = lateral(first, slice);
    if (shift <= kStepTolerance * median && total <= drift) continue;
    const bool jump = shift > kStepTolerance * median;
    const DicomSlice& from = jump ? below : first;
    const double rise = dot(slice.position - from.position, sorted.normal);
    const double angle_deg = std::atan2(jump ? shift : total, rise) * 45 / std::atan(1);
    refuse(path, message("expected slices straight above one another, found a tilt of ", angle_deg,
                         " degrees (gantry tilt): ", name_of(slice), " is shifted by ",
                         jump ? shift : total, " mm against ", name_of(from), " over ", rise, " mm",
                         kHint));
  }
}

}  // namespace mesamis::detail::volume_files
