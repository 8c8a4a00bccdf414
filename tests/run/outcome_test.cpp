// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/outcome.h"

#include <gtest/gtest.h>

#include "run/small_request.h"

namespace mesamis {
namespace {

TEST(Outcome, OneObjectIsAListOfOne) {
  const Outcome& found = ball_outcome();
  const auto objects = found.objects();
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(&objects[0].surface, &found.one->surface);
  EXPECT_EQ(objects[0].segment.name, "object");
  EXPECT_EQ(found.checks.size(), 1U);
  EXPECT_EQ(found.expected_error(0).size(), objects[0].surface.points.size());
}

TEST(Outcome, ListsTheObjectsOfLabelsInTheirOrder) {
  const Outcome& found = halves_outcome();
  const auto objects = found.objects();
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].segment.name, "left");
  EXPECT_EQ(objects[1].segment.name, "right");
  EXPECT_EQ(found.checks.size(), 2U);
  EXPECT_EQ(found.expected_error(1).size(), objects[1].surface.points.size());
}

TEST(Outcome, HasTheImageAndTheMeshOfEitherKind) {
  for (const Outcome* found : {&ball_outcome(), &halves_outcome()}) {
    EXPECT_EQ(found->image().size, found->grid.size);
    ASSERT_NE(found->mesh(), nullptr);
    EXPECT_EQ(found->mesh()->u.size(), found->mesh()->mesh.points.size());
    EXPECT_GT(found->parameters().level, 120);
  }
}

}  // namespace
}  // namespace mesamis
