// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/sheared_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "support/expect_near.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

VoxelGrid grid_of_size(const std::array<Index, 3>& size) {
  VoxelGrid grid;
  grid.size = size;
  grid.origin = {5, -6, 7};
  return grid;
}

/// A linear field of the world comes out exact wherever the old grid covers the new one, for shears
/// of every kind, left-handed and oblique grids.
TEST(ShearedGrid, KeepsALinearFieldOfTheWorld) {
  const VoxelGrid old = grid_of_size({9, 8, 7});
  const auto field = [](const Vec3& p) { return 2 * p.x - 3 * p.y + 0.5 * p.z + 40; };
  const std::array<std::array<Vec3, 3>, 4> all{
      {{Vec3{1, 0, 0}, Vec3{0, 1.5, 0}, Vec3{0.3, 0.4, 2}},
       {Vec3{1, 0, 0}, Vec3{0.5, 1, 0}, Vec3{0, 0, 2}},
       {Vec3{0.8, 0.6, 0}, Vec3{-0.6, 0.9, 0.2}, Vec3{0.1, 0, -1}},
       {Vec3{-1, 0, 0.1}, Vec3{0, 1, 0}, Vec3{0.2, 0.1, 1}}}};
  for (const auto& steps : all) {
    std::vector<float> samples;
    for (Index k = 0; k < 7; ++k) {
      for (Index j = 0; j < 8; ++j) {
        for (Index i = 0; i < 9; ++i) {
          samples.push_back(static_cast<float>(
              field(old.origin + static_cast<double>(i) * steps[0] +
                    static_cast<double>(j) * steps[1] + static_cast<double>(k) * steps[2])));
        }
      }
    }
    const ShearPlan plan = plan_unsheared("f", old, steps);
    const VoxelGrid& grid = plan.grid;
    const std::vector<float> out = unsheared(plan, samples);
    ASSERT_EQ(out.size(), grid.voxel_count());
    const float least = *std::min_element(samples.begin(), samples.end());
    std::size_t inside = 0;
    for (std::size_t n = 0; n < out.size(); ++n) {
      if (out[n] == least) continue;
      const auto at = grid.voxel(n);
      const Vec3 p =
          grid.to_world({at[0] * grid.spacing.x, at[1] * grid.spacing.y, at[2] * grid.spacing.z});
      EXPECT_NEAR(out[n], field(p), 1e-3);
      ++inside;
    }
    EXPECT_GT(inside, samples.size() / 2);
    const Mat3 rows = grid.direction;
    for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(norm(rows.rows[a]), 1, 1e-12);
  }
}

TEST(ShearedGrid, OrthogonalAxesStayAsTheyAre) {
  const VoxelGrid old = grid_of_size({3, 2, 2});
  const ShearPlan plan = plan_unsheared("f", old, {Vec3{0, 2, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 3}});
  EXPECT_EQ(plan.grid.size, old.size);
  expect_near(plan.grid.origin, old.origin);
  expect_near(plan.grid.spacing, {2, 1, 3});
  const std::vector<float> samples{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  EXPECT_EQ(unsheared(plan, samples), samples);
}

/// The same of labels: no number comes out that did not go in, and none moves by a voxel.
TEST(ShearedGrid, LabelsAreThoseOfTheNearestVoxels) {
  const VoxelGrid old = grid_of_size({9, 8, 7});
  const std::array<Vec3, 3> steps{Vec3{1, 0, 0}, Vec3{0.3, 1, 0}, Vec3{0, 0.4, 1.2}};
  const ShearPlan plan = plan_unsheared("f", old, steps);
  const auto label = [](const Vec3& p) { return static_cast<std::uint16_t>(p.x < 6 ? 3 : 700); };
  std::vector<std::uint16_t> labels(old.voxel_count());
  for (std::size_t n = 0; n < labels.size(); ++n) {
    const auto v = old.voxel(n);
    labels[n] = label(old.origin + v[0] * steps[0] + v[1] * steps[1] + v[2] * steps[2]);
  }
  const std::vector<std::uint16_t> out = unsheared(plan, labels);
  std::size_t covered = 0;
  for (std::size_t n = 0; n < out.size(); ++n) {
    const auto v = plan.grid.voxel(n);
    const Vec3 s = plan.grid.spacing;
    const Vec3 p = plan.grid.to_world({v[0] * s.x, v[1] * s.y, v[2] * s.z});
    if (out[n] == 0) continue;
    ++covered;
    EXPECT_TRUE(out[n] == 3 || out[n] == 700) << out[n];
    if (std::abs(p.x - 6) > 0.7) {
      EXPECT_EQ(out[n], label(p)) << p.x;
    }
  }
  EXPECT_NEAR(static_cast<double>(covered), static_cast<double>(labels.size()),
              0.1 * static_cast<double>(labels.size()));
  EXPECT_THAT(plan.label_note, HasSubstr("background"));
}

TEST(ShearedGrid, RefusesAxesInAPlaneAndGridsThatGrow) {
  const VoxelGrid old = grid_of_size({100, 100, 100});
  EXPECT_REFUSED(plan_unsheared("f", old, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0.01}}),
                 HasSubstr("in a plane"));
  EXPECT_REFUSED(plan_unsheared("f", grid_of_size({2, 2, 1000}),
                                {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0.7, 0.7, 0.2}}),
                 HasSubstr("can be resampled"));
}

}  // namespace
}  // namespace mesamis
