// SPDX-License-Identifier: Apache-2.0
#include "mesamis/study/study_diagrams.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "study/made_up_runs.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const PlannedRun kFull{"region_full", 1, {1, 1, 1}, true}, kSparse{"region_s2", 2, {2, 2, 2}};

const Diagram& named(const std::vector<Diagram>& diagrams, const std::string& name) {
  for (const Diagram& diagram : diagrams) {
    if (diagram.name == name) return diagram;
  }
  throw std::runtime_error(name + " is missing");
}

TEST(StudyDiagrams, TheBaselineIsNotAPointOverS) {
  const auto diagrams =
      study_diagrams(std::vector{made_up_run(kFull, 0.25), made_up_run(kSparse, 0.5)});
  for (const PlotSeries& series : named(diagrams, "distance.svg").series) {
    EXPECT_THAT(series.x, ElementsAre(2)) << series.name;
    EXPECT_THAT(series.y, ElementsAre(0.5)) << series.name;
  }
}

TEST(StudyDiagrams, CurvesHaveAPointPerIteration) {
  const auto diagrams = study_diagrams(std::vector{made_up_run(kSparse, 0.5)});
  const PlotSeries& energy = named(diagrams, "energy.svg").series.at(0);
  EXPECT_EQ(energy.name, "region_s2");
  EXPECT_THAT(energy.x, ElementsAre(1, 2, 3));
  EXPECT_THAT(energy.y, ElementsAre(64, 48, 32)) << "in mm^3: the length unit is 2 mm";
  EXPECT_THAT(named(diagrams, "cells.svg").series.at(0).y, ElementsAre(1000, 2000, 3000));
}

TEST(StudyDiagrams, TheSharesOfTheHistogramAddUpToAll) {
  const auto diagrams = study_diagrams(std::vector{made_up_run(kSparse, 0.5)});
  const PlotSeries& stairs = named(diagrams, "histogram.svg").series.at(0);
  EXPECT_NEAR(std::accumulate(stairs.y.begin(), stairs.y.end(), 0.0), 2 * 100, 1e-9)
      << "each stair has two ends";
  for (std::size_t i = 1; i < stairs.x.size(); ++i) {
    EXPECT_GE(stairs.x[i], stairs.x[i - 1] - 1e-12) << "but for round-off";
  }
  EXPECT_NEAR(stairs.x.back(), 0.5, 1e-12) << "the longest distance";
}

TEST(StudyDiagrams, WithoutAPointAreLeftOut) {
  EXPECT_TRUE(study_diagrams(std::vector{failed_run(kSparse, "why")}).empty());
  StudyRun uncompared = made_up_run(kSparse, 0.5);
  uncompared.comparison.reset();
  std::vector<std::string> names;
  for (const Diagram& d : study_diagrams(std::vector{uncompared})) names.push_back(d.name);
  EXPECT_THAT(names, ElementsAre("energy.svg", "cells.svg"));
}

TEST(DrawDiagrams, NamesTheFilesItWrote) {
  const TempFolder folder;
  const auto names = draw_diagrams(folder.path(), "a_", std::vector{made_up_run(kSparse, 0.5)});
  EXPECT_THAT(names,
              ElementsAre("a_distance.svg", "a_histogram.svg", "a_energy.svg", "a_cells.svg"));
  for (const auto& name : names) {
    EXPECT_THAT(read_bytes(folder / name), HasSubstr("class=\"series\"")) << name;
  }
}

}  // namespace
}  // namespace mesamis
