// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/shapes.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// A run that kept every promise, and the pieces to break one.
struct Case {
  Case() {
    result.surface = cube();
    result.converged = true;
    result.parameters.tolerance = 0.1;
    result.parameters.adaptations = 2;
    result.iterations.resize(3);
  }
  Verdict verdict() const { return judge(result, check_surface(result.surface)); }
  Result result;
};

TEST(Verdict, ARunThatKeptItsPromisesHasNothingToSay) {
  const Verdict verdict = Case().verdict();
  EXPECT_EQ(verdict.kind, VerdictKind::kKept);
  EXPECT_EQ(verdict.message, "");
}

TEST(Verdict, AnOpenSurfaceIsTheWorst) {
  Case broken;
  broken.result.surface.triangles.pop_back();
  broken.result.converged = false;
  EXPECT_EQ(broken.verdict().kind, VerdictKind::kNotClosed);
  EXPECT_THAT(broken.verdict().message, HasSubstr("expected a closed 2-manifold surface"));
}

TEST(Verdict, AnUnmetToleranceCountsForSolidsAlone) {
  Case far;
  far.result.printable.extracted_to_result = 0.2;
  EXPECT_EQ(far.verdict().kind, VerdictKind::kNotConverged);
  EXPECT_THAT(far.verdict().message, HasSubstr("tolerance: expected distances of 0.1 mm"));
  far.result.parameters.surface = SurfaceKind::kBand;
  EXPECT_EQ(far.verdict().kind, VerdictKind::kKept);
}

TEST(Verdict, MoreTrianglesThanAskedForHaveAReason) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  EXPECT_EQ(triangles_unmet(0, 500, 0.1), "");
  EXPECT_EQ(triangles_unmet(500, 500, 0.1), "");
  EXPECT_EQ(
      triangles_unmet(500, 502, 0.1),
      "triangles: expected 500 at most, found 502: the tolerance of 0.1 mm was reached first");
  EXPECT_THAT(triangles_unmet(4, 8, kNone), testing::HasSubstr("triangles would intersect"));
}

TEST(Verdict, ARunThatWasStoppedSaysWhere) {
  Case stopped;
  stopped.result.stopped = true;
  stopped.result.converged = false;
  stopped.result.parameters.adaptations = 8;
  EXPECT_EQ(stopped.verdict().kind, VerdictKind::kNotConverged);
  EXPECT_THAT(stopped.verdict().message, HasSubstr("time limit after 2 of at most 8 adaptations"));
  stopped.result.parameters.preview = true;
  EXPECT_THAT(stopped.verdict().message, HasSubstr("the surface is a preview"));
}

TEST(Verdict, AnAccuracyThatTheScanDoesNotPermitIsUnmet) {
  Case coarse;
  coarse.result.expected_error.assign(coarse.result.surface.points.size(), 0.3);
  EXPECT_EQ(coarse.verdict().kind, VerdictKind::kKept) << "none was asked for";
  coarse.result.parameters.accuracy = 0.5;
  EXPECT_EQ(coarse.verdict().kind, VerdictKind::kKept);
  coarse.result.parameters.accuracy = 0.2;
  EXPECT_EQ(coarse.verdict().kind, VerdictKind::kNotConverged);
  EXPECT_THAT(coarse.verdict().message,
              HasSubstr("expected 0.2 mm in the mean at most, found 0.3"));
}

TEST(Verdict, AnAccuracyOfWhichNothingIsKnownIsUnmet) {
  const TriMesh surface = cube();
  EXPECT_THAT(accuracy_unmet(0.2, surface, {}), HasSubstr("not known"));
  EXPECT_EQ(accuracy_unmet(0, surface, {}), "");
  EXPECT_EQ(accuracy_unmet(0.2, {}, {}), "") << "nothing that could be inaccurate";
}

TEST(Verdict, TakesWhatElseWasMissed) {
  Verdict verdict;
  add_unmet(verdict, "");
  EXPECT_EQ(verdict.kind, VerdictKind::kKept);
  add_unmet(verdict, "a");
  EXPECT_EQ(verdict.kind, VerdictKind::kNotConverged);
  verdict.kind = VerdictKind::kNotClosed;
  add_unmet(verdict, "b");
  EXPECT_EQ(verdict.kind, VerdictKind::kNotClosed) << "the worst stays";
  EXPECT_EQ(verdict.message, "a; b");
}

TEST(Verdict, SaysWhyARunHasNotConverged) {
  Case unsettled;
  unsettled.result.converged = false;
  unsettled.result.iterations[1].surface_change = 0.7;
  unsettled.result.iterations[1].surface_tolerance = 0.4;
  EXPECT_THAT(
      unsettled.verdict().message,
      HasSubstr("a mesh still moved the surface by 0.700000 mm, expected at most 0.400000"));
  unsettled.result.parameters.surface = SurfaceKind::kBand;
  EXPECT_THAT(unsettled.verdict().message, HasSubstr("the cell count changed by")) << "no solid";
  unsettled.result.parameters.surface = SurfaceKind::kSolid;
  unsettled.result.parameters.until = StopRule::kEnergy;
  unsettled.result.iterations[1].mesh_change = 0.3;
  EXPECT_EQ(unsettled.verdict().kind, VerdictKind::kNotConverged);
  EXPECT_THAT(unsettled.verdict().message, HasSubstr("the cell count changed by 0.3"));
  unsettled.result.parameters.adaptations = 1;
  EXPECT_THAT(unsettled.verdict().message, HasSubstr("expected 2 or more"));
  unsettled.result.iterations[1].amis.solver_converged = false;
  EXPECT_THAT(unsettled.verdict().message, HasSubstr("a linear solve ended"));
}

}  // namespace
}  // namespace mesamis
