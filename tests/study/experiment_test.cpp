// SPDX-License-Identifier: Apache-2.0
#include "mesamis/study/experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/ball_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

const std::vector<int> kSteps{1, 3};

Volume small_ball() { return make_ball({.size = 12, .radius = 4}); }

TEST(SubsamplingExperiment, HasARunForEachStep) {
  const Volume scan = small_ball();
  const Experiment experiment = subsampling_experiment(scan, {}, kSteps);
  ASSERT_EQ(experiment.runs.size(), 2u);
  EXPECT_EQ(experiment.runs[0].name, "s1");
  EXPECT_EQ(experiment.runs[1].name, "s3");
  EXPECT_EQ(experiment.runs[1].stride, (std::array<Index, 3>{1, 1, 3}));
  EXPECT_EQ(experiment.volume.samples, scan.samples);
  EXPECT_FALSE(experiment.cropped);
  for (const PlannedRun& run : experiment.runs) EXPECT_FALSE(run.baseline) << run.name;
}

TEST(SubsamplingExperiment, CropsOnce) {
  Settings settings;
  settings.crop = {{2, 2, 2}, {10, 11, 12}};
  const Experiment experiment = subsampling_experiment(small_ball(), settings, kSteps);
  EXPECT_EQ(experiment.volume.size, (std::array<Index, 3>{8, 9, 10}));
  EXPECT_TRUE(experiment.cropped);
  EXPECT_EQ(experiment.settings.crop, CropRange{}) << "a second crop would leave the volume";
}

TEST(RegionExperiment, BeginsWithTheBaselineAtFullResolution) {
  Settings settings;
  settings.stride = std::array<Index, 3>{2, 2, 2};
  settings.crop = {{0, 0, 0}, {3, 3, 3}};
  const CropRange region{{1, 1, 1}, {11, 11, 11}};
  const Experiment experiment = region_experiment(small_ball(), region, settings, kSteps);
  EXPECT_EQ(experiment.volume.size, (std::array<Index, 3>{10, 10, 10})) << "the region alone";
  EXPECT_TRUE(experiment.cropped);
  EXPECT_EQ(experiment.settings.stride, (std::array<Index, 3>{1, 1, 1}));
  ASSERT_EQ(experiment.runs.size(), 3u);
  EXPECT_TRUE(experiment.runs[0].baseline);
  EXPECT_EQ(experiment.runs[0].stride, (std::array<Index, 3>{1, 1, 1}));
  EXPECT_FALSE(experiment.runs[2].baseline);
  EXPECT_EQ(experiment.runs[2].name, "region_s3");
  EXPECT_EQ(experiment.runs[2].stride, (std::array<Index, 3>{2, 2, 3}));
}

TEST(Experiments, RefuseARunThatCannotStart) {
  const Volume scan = small_ball();
  const std::vector<int> wide{1, 12};
  EXPECT_REFUSED(subsampling_experiment(scan, {}, wide), HasSubstr("s12: subsample"));
  EXPECT_REFUSED(region_experiment(scan, {{0, 0, 0}, {2, 2, 2}}, {}, kSteps),
                 HasSubstr("region_s1"));
  EXPECT_REFUSED(region_experiment(scan, {{0, 0, 0}, {13, 2, 2}}, {}, kSteps), HasSubstr("0:13"));
}

}  // namespace
}  // namespace mesamis
