// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/outcome_details.h"

#include <gmock/gmock.h>

#include "run/small_request.h"
#include "support/shapes.h"

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

TEST(OutcomeDetails, CountTheTrianglesThatObjectsShare) {
  const TriMesh lower = cube(), upper = cube({0, 0, 1}), far = cube({5, 0, 0});
  EXPECT_EQ(shared_triangles(std::vector<FoundObject>{{lower, {}}, {upper, {}}, {far, {}}}), 2);
  EXPECT_EQ(shared_triangles(std::vector<FoundObject>{{lower, {}}}), 0);
  EXPECT_GT(shared_triangles(halves_outcome().details().objects()), 0);
}

TEST(OutcomeDetails, TellOfATriangleNumberThatIsUnmetWithSharedOnesCountedOnce) {
  for (const bool halves : {false, true}) {
    const auto warnings = [&](std::int64_t triangles, std::optional<double> tolerance) {
      Request request = ball_request();
      if (halves) request.labels = LabelChoice{half_balls()};
      request.mesh = false;
      request.settings.preview = !halves;
      request.settings.triangles = triangles;
      request.settings.tolerance = tolerance;
      std::vector<std::string> heard;
      Listener listener;
      listener.warning = [&](const std::string& line) { heard.push_back(line); };
      const Outcome outcome = segment(std::move(request), listener);
      EXPECT_EQ(outcome.warnings(), heard);
      return heard;
    };
    EXPECT_THAT(warnings(200, {}), testing::IsEmpty());
    EXPECT_THAT(warnings(20, 0.02),
                testing::ElementsAre(testing::AllOf(
                    testing::StartsWith("triangles: expected 20 at most, found "),
                    testing::EndsWith(": the tolerance of 0.02 mm was reached first"))));
  }
}

}  // namespace
}  // namespace mesamis
