// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/outcome_details.h"

#include <gtest/gtest.h>

#include "run/small_request.h"

namespace mesamis {
namespace {

TEST(OutcomeDetails, HaveTheImageAndTheMeshOfEitherKind) {
  for (const Outcome* outcome : {&ball_outcome(), &halves_outcome()}) {
    const OutcomeDetails& found = outcome->details();
    EXPECT_EQ(found.image().size, found.grid.size);
    ASSERT_NE(found.mesh(), nullptr);
    EXPECT_EQ(found.mesh()->u.size(), found.mesh()->mesh.points.size());
    EXPECT_GT(found.parameters().level, 120);
    EXPECT_EQ(found.checks.size(), found.objects().size());
  }
}

}  // namespace
}  // namespace mesamis
