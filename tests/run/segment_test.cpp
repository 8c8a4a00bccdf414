// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/segment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesamis/base/parallel.h"
#include "mesamis/method/setting_table.h"
#include "run/small_request.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

void expect_same_surfaces(const Outcome& a, const Outcome& b) {
  const auto one = a.objects(), other = b.objects();
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t n = 0; n < one.size(); ++n) {
    EXPECT_EQ(one[n].surface.points, other[n].surface.points);
    EXPECT_EQ(one[n].surface.triangles, other[n].surface.triangles);
  }
}

TEST(Segment, FindsAClosedSurfaceAndKeepsItsPromises) {
  const Outcome& found = ball_outcome();
  EXPECT_TRUE(found.details().checks.front().closed());
  EXPECT_EQ(found.details().verdict.kind, VerdictKind::kKept) << found.details().verdict.message;
}

TEST(Segment, ReadsTheSamplesOfAViewInPlace) {
  const Volume scan = make_ball(small_ball());
  Request request = ball_request();
  request.scan = VolumeView(scan);
  const Outcome found = segment(std::move(request));
  EXPECT_TRUE(found.details().object->volume.samples.empty());
  EXPECT_EQ(found.details().image().samples.data(), scan.samples.data());
  expect_same_surfaces(found, ball_outcome());
}

/// What the user's samples are like afterwards does not depend on what had to be done to them.
TEST(Segment, LeavesTheSamplesOfAViewAsTheyWere) {
  Volume scan = make_ball(small_ball());
  for (std::size_t n = 0; n < 26U * 26 * 4; ++n) scan.samples[n] = -3024;
  const std::vector<float> before = scan.samples;
  Request request = ball_request();
  request.settings.preview = true;
  request.object.padding = parse_padding("-3024");
  request.scan = VolumeView(scan);
  const Outcome found = segment(request);
  EXPECT_EQ(scan.samples, before);
  ASSERT_TRUE(found.details().object->padding);
  EXPECT_NE(found.details().image().samples.data(), scan.samples.data());
  request.scan = scan;
  expect_same_surfaces(segment(request), found);
}

TEST(Segment, TheLevelAndTheCropAreThoseOfTheSettings) {
  Request request = ball_request();
  request.settings.preview = true;
  request.settings.level = 150;
  request.settings.crop.end = {26, 26, 20};
  const Outcome found = segment(std::move(request));
  EXPECT_EQ(found.details().parameters().level, 150);
  EXPECT_EQ(found.details().image().size[2], 20);
  EXPECT_EQ(found.details().grid.size[2], 26) << "that of the whole scan";
}

TEST(Segment, LabelsChooseTheObjectsAndTheImagePlacesThem) {
  const Outcome& found = halves_outcome();
  EXPECT_EQ(found.details().verdict.kind, VerdictKind::kKept) << found.details().verdict.message;
  const double volume = found.details().checks[0].volume + found.details().checks[1].volume;
  EXPECT_NEAR(volume, ball_outcome().details().checks[0].volume, 0.03 * volume);
}

TEST(Segment, LabelsAloneNeedNoScan) {
  Request request;
  request.labels = LabelChoice{half_balls()};
  request.labels->chosen = {request.labels->map.segments[1]};
  request.mesh = false;
  const Outcome found = segment(request);
  ASSERT_EQ(found.objects().size(), 1U);
  EXPECT_EQ(found.objects()[0].segment.name, "right");
  EXPECT_FALSE(found.mesh());
  request.mesh = true;
  EXPECT_REFUSED(segment(request), "mesh: expected a scan beside the labels, found none");
  request.mesh = false;
  request.elements.body = true;
  EXPECT_REFUSED(segment(request), "body: expected a scan beside the labels, found none");
  request.settings.accuracy = 0.5;
  EXPECT_REFUSED(segment(request), "accuracy: expected a scan beside the labels, found none");
  EXPECT_REFUSED(segment({}), "request: expected a scan or labels, found neither");
}

TEST(Segment, SeveralSeedsMakeAnObjectEach) {
  Request request = ball_request();
  request.settings.preview = true;
  request.mesh = false;
  request.object.seeds = {{9, 12.5, 12.5}, {16, 12.5, 12.5}};
  std::vector<Segment> told;
  Listener listener;
  listener.objects = [&](const std::vector<Segment>& wanted) { told = wanted; };
  const Outcome found = segment(std::move(request), listener);
  EXPECT_EQ(found.objects().size(), 2U);
  EXPECT_EQ(told, found.details().wanted);
}

TEST(Segment, SeveralObjectsAreSolidsWhateverSetsTheBand) {
  Request request = ball_request();
  request.settings = preset_settings("paper");
  request.object.seeds = {{9, 12.5, 12.5}, {16, 12.5, 12.5}};
  EXPECT_REFUSED(segment(request), "surface: expected solid for several objects, found band");
  request.object.seeds.clear();
  request.labels = LabelChoice{half_balls()};
  EXPECT_REFUSED(segment(request), "surface: expected solid for several objects, found band");
  request.scan = {};
  request.mesh = false;
  EXPECT_REFUSED(segment(request), "surface: expected solid for several objects, found band");
}

TEST(Segment, ATimeLimitIsForOneObject) {
  Request request = ball_request();
  request.enough = [] { return true; };
  EXPECT_TRUE(segment(request).details().one->stopped);
  request.labels = LabelChoice{half_balls()};
  EXPECT_REFUSED(segment(request), "time limit: expected a run for one object, found several");
}

TEST(Segment, TellsWhatWasDoneAndWhatIsMissing) {
  Request request = ball_request();
  request.settings.preview = true;
  request.mesh = false;
  request.labels = LabelChoice{half_balls()};
  request.labels->map.segments.push_back({"absent", 3, 0, {}});
  std::vector<std::string> warnings;
  Listener listener;
  listener.warning = [&](const std::string& line) { warnings.push_back(line); };
  const Outcome found = segment(request, listener);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], HasSubstr("absent"));
  EXPECT_EQ(found.warnings(), warnings);
  listener.progress = [](std::string_view, double) { return false; };
  EXPECT_THROW(segment(request, listener), Cancelled);
}

TEST(Segment, TheSameBitsForAnyNumberOfThreads) {
  Request request = ball_request();
  request.settings.adaptations = 1;
  const Outcome one = with_threads(1, [&] { return segment(request); });
  const Outcome three = with_threads(3, [&] { return segment(request); });
  expect_same_surfaces(one, three);
}

}  // namespace
}  // namespace mesamis
