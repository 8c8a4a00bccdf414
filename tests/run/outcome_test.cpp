// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/outcome.h"

#include <gtest/gtest.h>

#include "run/small_request.h"

namespace mesamis {
namespace {

TEST(Outcome, OneObjectIsAListOfOne) {
  const auto objects = ball_outcome().objects();
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].segment.name, "object");
  EXPECT_TRUE(objects[0].check.closed());
  EXPECT_EQ(objects[0].expected_error.size(), objects[0].surface.points.size());
}

TEST(Outcome, ListsTheObjectsOfLabelsInTheirOrder) {
  const auto objects = halves_outcome().objects();
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].segment.name, "left");
  EXPECT_EQ(objects[1].segment.name, "right");
  EXPECT_EQ(objects[1].expected_error.size(), objects[1].surface.points.size());
}

TEST(Outcome, HasTheMeshOfEitherKindWithItsFields) {
  for (const Outcome* found : {&ball_outcome(), &halves_outcome()}) {
    const auto mesh = found->mesh();
    ASSERT_TRUE(mesh);
    for (const auto field : {mesh->u, mesh->v, mesh->f}) {
      EXPECT_EQ(field.size(), mesh->mesh.points.size());
    }
    EXPECT_EQ(mesh->metric.size(), mesh->mesh.points.size());
    EXPECT_EQ(found->elements(), nullptr);
    EXPECT_EQ(found->flaw(), "");
  }
}

/// The settings that a run has used repeat it.
TEST(Outcome, TellsWhatTheRunHasUsed) {
  Request request = ball_request();
  request.settings = ball_outcome().settings_used();
  ASSERT_TRUE(request.settings.level);
  const Outcome again = segment(std::move(request));
  EXPECT_EQ(again.objects()[0].surface.points, ball_outcome().objects()[0].surface.points);
}

TEST(Outcome, CopiesShareWhatTheyHold) {
  const Outcome copy = ball_outcome();
  EXPECT_EQ(&copy.objects()[0].surface, &ball_outcome().objects()[0].surface);
}

}  // namespace
}  // namespace mesamis
