// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/run_share.h"

#include <gmock/gmock.h>

#include "mesamis/run/segment.h"
#include "support/ball_volume.h"

namespace mesamis {
namespace {

TEST(RunShare, AddsStagesUpByTheirShares) {
  RunShare run({{"a", 1}, {"b", 2}, {"c", 1}});
  EXPECT_DOUBLE_EQ(run.done("a", 0), 0);
  EXPECT_DOUBLE_EQ(run.done("a", 0.5), 0.125);
  EXPECT_DOUBLE_EQ(run.done("b of 3", 0.5), 0.5);
  EXPECT_DOUBLE_EQ(run.done("c", 1), 1);
}

TEST(RunShare, NeverGoesBack) {
  RunShare run({{"a", 1}, {"b", 2}, {"a", 1}});
  EXPECT_DOUBLE_EQ(run.done("b", 0.5), 0.5) << "the first was passed over";
  EXPECT_DOUBLE_EQ(run.done("b", 0.1), 0.5);
  EXPECT_DOUBLE_EQ(run.done("unknown", 1), 0.5);
  EXPECT_DOUBLE_EQ(run.done("a", 0), 0.75) << "the second of this name";
  EXPECT_DOUBLE_EQ(run.done("b", 1), 0.75) << "it is over";
}

TEST(RunShare, KnowsNothingWithoutStages) {
  RunShare run({});
  EXPECT_FALSE(run.is_known());
  EXPECT_EQ(run.done("a", 1), 0);
}

/// Each stage that segment() tells is in the list of its kind of run, and the list ends with it.
TEST(StageShares, NameTheStagesOfARun) {
  for (const bool preview : {false, true}) {
    const auto stages = stage_shares({.preview = preview});
    RunShare share(stages);
    Request request;
    request.scan = make_ball({});
    request.settings.preview = preview;
    request.settings.adaptations = 2;
    request.settings.max_tets = 3000;
    std::vector<std::string> unknown;
    double before = -1;
    Listener listener;
    listener.progress = [&](std::string_view stage, double fraction) {
      const double done = share.done(stage, fraction);
      EXPECT_GE(done, before);
      before = done;
      const auto named = [&](const StageShare& s) { return stage.starts_with(s.name); };
      if (std::none_of(stages.begin(), stages.end(), named)) unknown.emplace_back(stage);
      return true;
    };
    segment(std::move(request), listener);
    EXPECT_THAT(unknown, testing::IsEmpty());
    EXPECT_GT(before, 0.8);
    EXPECT_LT(before, 1);
    EXPECT_DOUBLE_EQ(share.done("writing", 1), 1);
  }
}

}  // namespace
}  // namespace mesamis
