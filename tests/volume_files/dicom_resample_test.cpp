// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_resample.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "support/dicom_bytes.h"
#include "support/expect_near.h"
#include "support/read_scan.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kColumns = 8, kRows = 6;

/// Slices at these places, pixels of 0.5 x 1.25 mm.
SortedSlices slices_at(const std::vector<Vec3>& positions) {
  std::vector<DicomSlice> slices(positions.size());
  for (std::size_t n = 0; n < slices.size(); ++n) {
    slices[n].file = "s" + std::to_string(n);
    slices[n].columns = kColumns;
    slices[n].rows = kRows;
    slices[n].along_row = {1, 0, 0};
    slices[n].along_column = {0, 1, 0};
    slices[n].column_step = 0.5;
    slices[n].row_step = 1.25;
    slices[n].position = positions[n];
  }
  return sort_along_normal(slices);
}

/// What the slices show of a function of the place, mm.
std::vector<float> samples_of(const SortedSlices& sorted,
                              const std::function<double(const Vec3&)>& f) {
  std::vector<float> samples;
  for (const DicomSlice& slice : sorted.slices) {
    for (int j = 0; j < kRows; ++j) {
      for (int i = 0; i < kColumns; ++i) {
        samples.push_back(static_cast<float>(f(slice.position + Vec3{i * 0.5, j * 1.25, 0})));
      }
    }
  }
  return samples;
}

double linear(const Vec3& p) { return 100 + 3 * p.x - 2 * p.y + 0.5 * p.z; }

/// Linear interpolation keeps a linear function, wherever there is a slice.
/// @return the share of the voxels that the slices cover.
double expect_linear(const SortedSlices& sorted, const ResamplePlan& plan) {
  const auto stored = samples_of(sorted, linear);
  const float least = *std::min_element(stored.begin(), stored.end());
  const auto found = resampled(plan, {kColumns, kRows}, stored);
  EXPECT_EQ(found.size(), plan.grid.voxel_count());
  std::size_t covered = 0, n = 0;
  for (Index k = 0; k < plan.grid.size[2]; ++k) {
    for (Index j = 0; j < plan.grid.size[1]; ++j) {
      for (Index i = 0; i < plan.grid.size[0]; ++i, ++n) {
        const Vec3& s = plan.grid.spacing;
        const double expected = linear(plan.grid.to_world({i * s.x, j * s.y, k * s.z}));
        if (found[n] == least && std::abs(expected - static_cast<double>(least)) > 1e-3) continue;
        EXPECT_NEAR(found[n], expected, 2e-4) << i << " " << j << " " << k;
        ++covered;
      }
    }
  }
  return static_cast<double>(covered) / static_cast<double>(n);
}

TEST(Resampling, ARegularStackKeepsItsOwnGridAndBits) {
  const SortedSlices sorted = slices_at({{1, 2, 3}, {1, 2, 5.01}, {1, 2, 7}});
  const ResamplePlan plan = plan_resampling("scan", sorted);
  EXPECT_FALSE(plan.tilted || plan.uneven);
  EXPECT_THAT(plan.notes, IsEmpty());
  EXPECT_EQ(plan.grid.size, (std::array<Index, 3>{kColumns, kRows, 3}));
  expect_near(plan.grid.spacing, {0.5, 1.25, 2});
  const auto stored = samples_of(sorted, linear);
  EXPECT_EQ(resampled(plan, {kColumns, kRows}, stored), stored);
}

TEST(Resampling, ATiltIsShiftedBack) {
  // 0.7 mm towards the back per 2 mm up: 19.3 degrees.
  std::vector<Vec3> positions;
  for (int k = 0; k < 5; ++k) positions.push_back({1, 2 - 0.7 * k, 3 + 2.0 * k});
  const SortedSlices sorted = slices_at(positions);
  const ResamplePlan plan = plan_resampling("scan", sorted);
  EXPECT_TRUE(plan.tilted);
  EXPECT_FALSE(plan.uneven);
  EXPECT_EQ(plan.grid.size, (std::array<Index, 3>{kColumns, kRows + 3, 5}))
      << "2.8 mm are three rows more";
  expect_near(plan.grid.origin, {1, 2 - 2.8, 3}, 1e-12);
  EXPECT_GT(expect_linear(sorted, plan), 0.5);
  EXPECT_THAT(plan.notes,
              ElementsAre(AllOf(HasSubstr("gantry tilt of 19.2"), HasSubstr("2.8 mm"))));
}

TEST(Resampling, ATiltByWholePixelsMovesSamplesUnchanged) {
  const SortedSlices sorted = slices_at({{0, 0, 0}, {1, 0, 2}, {2, 0, 4}});
  const ResamplePlan plan = plan_resampling("scan", sorted);
  EXPECT_EQ(plan.grid.size, (std::array<Index, 3>{kColumns + 4, kRows, 3}));
  const auto stored = samples_of(sorted, linear);
  const auto found = resampled(plan, {kColumns, kRows}, stored);
  for (Index k = 0; k < 3; ++k) {
    const auto at = plan.grid.offset(2 * k, 0, k);
    EXPECT_EQ(found[at], stored[static_cast<std::size_t>(k) * kColumns * kRows]);
  }
}

TEST(Resampling, UnevenSlicesAreInterpolatedAtTheLeastDistance) {
  const SortedSlices sorted =
      slices_at({{1, 2, 0}, {1, 2, 1.25}, {1, 2, 2.5}, {1, 2, 7.5}, {1, 2, 10}});
  const ResamplePlan plan = plan_resampling("scan", sorted);
  EXPECT_TRUE(plan.uneven);
  EXPECT_FALSE(plan.tilted);
  EXPECT_EQ(plan.grid.size[2], 9);
  EXPECT_NEAR(plan.grid.spacing.z, 1.25, 1e-12);
  EXPECT_EQ(expect_linear(sorted, plan), 1);
  EXPECT_THAT(plan.notes,
              ElementsAre(AllOf(HasSubstr("slices 1.25 to 5 mm apart: resampled to 1.25 mm"),
                                HasSubstr("farther than 2.5 mm from a slice"))));
}

TEST(Resampling, BothAtOnce) {
  const SortedSlices sorted = slices_at({{0, 0, 0}, {0.25, 0, 1}, {0.5, 0, 2}, {1.25, 0, 5}});
  const ResamplePlan plan = plan_resampling("scan", sorted);
  EXPECT_TRUE(plan.tilted && plan.uneven);
  EXPECT_GT(expect_linear(sorted, plan), 0.5);
}

TEST(Resampling, NearlyEqualPlacesDoNotMakeManyPlanes) {
  const SortedSlices sorted = slices_at({{0, 0, 0}, {0, 0, 0.001}, {0, 0, 4}, {0, 0, 8}});
  EXPECT_EQ(plan_resampling("scan", sorted).grid.size[2], 9) << "a quarter of the median, 4 mm";
  EXPECT_REFUSED(plan_resampling("scan", slices_at({{0, 0, 0}, {0, 0, 0}, {0, 0, 4}})),
                 HasSubstr("two at the same"));
}

TEST(Resampling, PlacesFarAwayDoNotTakeMemory) {
  EXPECT_REFUSED(plan_resampling("scan", slices_at({{0, 0, 0}, {1e5, 0, 2}, {2e5, 0, 4}})),
                 HasSubstr("at most 64 times the 144 samples"));
  EXPECT_REFUSED(plan_resampling("scan", slices_at({{0, 0, 0}, {1e30, 0, 2}})),
                 HasSubstr("scan: "));
  EXPECT_REFUSED(plan_resampling("scan", slices_at({{0, 0, 0}, {0, 0, 1}, {0, 0, 1e5}})),
                 HasSubstr("at most 64 times"));
  EXPECT_REFUSED(
      plan_resampling("scan", slices_at({{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 1e40}})),
      HasSubstr("planes"));
}

TEST(Resampling, IsDoneOnRequestAlone) {
  const TempFolder folder;
  for (const int z : {0, 2, 4, 8, 10}) {
    SliceBytes slice;
    slice.position = {0, 0, static_cast<double>(z)};
    slice.pixels.assign(12, static_cast<std::int16_t>(10 * z));
    write_bytes(folder / std::to_string(z), slice.bytes());
  }
  EXPECT_THAT(complaint(folder / ""), AllOf(HasSubstr("missing"), HasSubstr("--resample")));
  const VolumeFile file = read_volume(folder / "", {.resample = true});
  ASSERT_EQ(file.volume.size, (std::array<Index, 3>{4, 3, 6}));
  EXPECT_THAT(file.warnings, Contains(HasSubstr("resampled to 2 mm")));
  for (Index k = 0; k < 6; ++k) EXPECT_EQ(file.volume.at(1, 1, k), 20 * k);
  EXPECT_THAT(list_volumes(folder / "")[0].problem, HasSubstr("missing"));
  const auto info = list_volumes(folder / "", {.resample = true})[0];
  EXPECT_EQ(info.problem, "");
  EXPECT_EQ(info.size, file.volume.size);
}

}  // namespace
}  // namespace mesamis
