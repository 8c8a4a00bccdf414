// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/shown_run.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "page/sample_run.h"
#include "support/throws.h"

namespace mesamis {
namespace {

TEST(ShownRun, HasThreeSlicesInTheWindowOfTheRun) {
  const SampleRun sample;
  const RunPage page = sample.page();
  const ShownRun run = shown_run(page);
  ASSERT_EQ(run.slices.size(), 3u);
  EXPECT_EQ(run.slices[0].name, "axial");
  EXPECT_EQ(run.window.low, 100);
  EXPECT_EQ(run.window.high, 240);
  EXPECT_FALSE(run.is_empty());
  for (const SliceView& slice : run.slices) EXPECT_EQ(slice.outlines[0].size(), 1u) << slice.name;
}

TEST(ShownRun, IsDrawnWithoutAScanToo) {
  const SampleRun sample;
  RunPage page = sample.page();
  page.scan = nullptr;
  const ShownRun run = shown_run(page);
  EXPECT_TRUE(run.slices.empty());
  EXPECT_EQ(cut_picture(run, 100).width, 100);
  EXPECT_TRUE(shown_run({nlohmann::json::object()}).is_empty());
}

TEST(ShownRun, SeveralObjectsKeepTheirColours) {
  const SampleRun sample;
  RunPage page = sample.page();
  page.surfaces.push_back({&sample.surface, "two", {1, 2, 3}});
  const ShownRun run = shown_run(page);
  EXPECT_EQ(run.surfaces[0].outline, (Colour{200, 100, 50}));
  EXPECT_EQ(run.surfaces[1].colour, (Colour{1, 2, 3}));
}

TEST(ShownRun, RefusesWhatDoesNotFit) {
  const SampleRun sample;
  RunPage page = sample.page();
  page.grey = page.grey.subspan(1);
  EXPECT_REFUSED(shown_run(page), testing::HasSubstr("expected a grey value per node"));
  const std::vector<double> few{1, 2};
  page = sample.page();
  page.surfaces[0].error = few;
  EXPECT_REFUSED(shown_run(page), testing::HasSubstr("expected an error per point"));
  TriMesh broken = sample.surface;
  broken.triangles[0][0] = 1'000'000;
  page = sample.page();
  page.surfaces = {{&broken, "", {}}};
  EXPECT_REFUSED(shown_run(page), testing::HasSubstr("point"));
}

}  // namespace
}  // namespace mesamis
