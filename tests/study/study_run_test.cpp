// SPDX-License-Identifier: Apache-2.0
#include "mesamis/study/study_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesamis/method/mes_amis.h"
#include "mesamis/surface/unused_points.h"
#include "study/made_up_runs.h"
#include "support/ball_volume.h"
#include "support/shapes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr BallVolume kBall{.size = 20, .radius = 6};
const std::vector<int> kEverySlice{1};

Settings fast() {
  Settings settings;
  settings.max_tets = 3000;
  settings.adaptations = 2;
  return settings;
}

TEST(SegmentPlanned, OnEverySliceIsThePlainRun) {
  const Volume scan = make_ball(kBall);
  const Experiment experiment = subsampling_experiment(scan, fast(), kEverySlice);
  const StudyRun run = segment_planned(experiment, experiment.runs[0]);
  const Result plain = mes_amis(scan, fast());
  EXPECT_EQ(run.surface.points, plain.surface.points);
  EXPECT_EQ(run.surface.triangles, plain.surface.triangles);
  ASSERT_TRUE(run.summary);
  EXPECT_EQ(run.summary->tets, static_cast<std::int64_t>(plain.mesh.cells.size()));
  EXPECT_EQ(run.summary->iterations.back().energy.total(), plain.iterations.back().energy.total());
  EXPECT_EQ(run.converged(), plain.converged);
  EXPECT_EQ(run.outcome == VerdictKind::kKept, run.remark.empty());
  EXPECT_TRUE(run.grid.samples.empty());
  EXPECT_EQ(run.grid.size, scan.size);
}

TEST(SegmentPlanned, WithoutASurfaceIsRefused) {
  Settings settings = fast();
  settings.adaptations = 1;
  settings.min_volume = 1e9;  // mm^3
  const Experiment experiment = subsampling_experiment(make_ball(kBall), settings, kEverySlice);
  EXPECT_REFUSED(segment_planned(experiment, experiment.runs[0]), HasSubstr("there is no surface"));
}

TEST(SegmentPlanned, StopsWhenProgressSaysSo) {
  const Experiment experiment = subsampling_experiment(make_ball(kBall), fast(), kEverySlice);
  EXPECT_THROW(segment_planned(experiment, experiment.runs[0],
                               [](std::string_view, double) { return false; }),
               Cancelled);
}

TEST(FailedRun, IsMarked) {
  const StudyRun run = failed_run({"s3", 3, {1, 1, 3}}, "no memory");
  EXPECT_EQ(run.plan.name, "s3");
  EXPECT_EQ(run.outcome, VerdictKind::kNotConverged);
  EXPECT_EQ(run.remark, "no memory");
  EXPECT_EQ(run.failure, "no memory");
  EXPECT_FALSE(run.converged());
  EXPECT_TRUE(run.surface.triangles.empty());
}

/// A run whose surface is given, on a volume of 10 x 10 x 10 voxels of 1 mm.
struct Case {
  explicit Case(TriMesh surface, bool cropped = true) {
    run.plan.name = "s1";
    run.grid.size = experiment.volume.size = {10, 10, 10};
    run.surface = std::move(surface);
    experiment.cropped = cropped;
  }
  Experiment experiment;
  StudyRun run;
};

TEST(WithComparison, MeasuresFromEitherSurface) {
  const Case given(cube({3, 3, 3}, 3), false);
  const StudyRun run = with_comparison(cube({2, 2, 2}, 5), given.experiment, given.run);
  ASSERT_TRUE(run.comparison);
  EXPECT_NEAR(run.comparison->reference_to_surface.vertices.mean, std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(run.comparison->surface_to_reference.vertices.mean, 1, 1e-12);
  EXPECT_EQ(run.comparison->distances.name, "s1");
  EXPECT_EQ(run.comparison->distances.from_vertices.size(), 8u);
  EXPECT_DOUBLE_EQ(run.comparison->triangle_reduction_percent(), 0);
}

TEST(WithComparison, OfACroppedVolumeLeavesItsFacesOut) {
  const TriMesh object = cube({3, 3, 3}, 3);
  const TriMesh cap = cube({0.2, 0.2, 0.2}, 0.5);  // nearer than a voxel to the faces
  const Case given(joined(object, cap));
  const StudyRun run = with_comparison(object, given.experiment, given.run);
  ASSERT_TRUE(run.comparison);
  EXPECT_EQ(run.comparison->triangles, 12);
  EXPECT_EQ(run.comparison->surface_to_reference.area.max, 0);
  const Case whole(joined(object, cap), false);
  const StudyRun all = with_comparison(object, whole.experiment, whole.run);
  EXPECT_EQ(all.comparison->triangles, 24);
  EXPECT_GT(all.comparison->surface_to_reference.area.max, 1);
  EXPECT_DOUBLE_EQ(all.comparison->triangle_reduction_percent(), -100) << "twice as many";
}

TEST(WithComparison, MarksARunWithNothingInside) {
  const Case given(cube({0, 0, 0}, 0.5));
  const StudyRun run = with_comparison(cube({3, 3, 3}, 3), given.experiment, given.run);
  EXPECT_FALSE(run.comparison);
  EXPECT_EQ(run.outcome, VerdictKind::kNotConverged);
  EXPECT_THAT(run.failure, HasSubstr("inside the region"));
  EXPECT_TRUE(run.surface.triangles.empty());
}

TEST(WithComparison, LeavesAFailedRunAsItIs) {
  const StudyRun failed = failed_run({"s3", 3, {1, 1, 3}}, "why");
  EXPECT_EQ(with_comparison(cube(), Case(cube()).experiment, failed).failure, "why");
}

TEST(RequireInside, RefusesAReferenceElsewhere) {
  Case given(cube());
  EXPECT_NO_THROW(require_inside(cube({3, 3, 3}, 3), given.experiment));
  EXPECT_REFUSED(require_inside(cube({30, 3, 3}, 3), given.experiment),
                 HasSubstr("inside the region, a voxel away from its faces, found none of 12"));
  given.experiment.cropped = false;
  EXPECT_REFUSED(require_inside(cube({0, 0, 0}, 1), given.experiment), HasSubstr("the scan"));
}

TEST(DistanceVariations, ArePercentOfTheBaseline) {
  std::vector<StudyRun> runs{made_up_run({"region_full", 1, {1, 1, 1}, true}, 0.5),
                             made_up_run({"region_s1", 1, {2, 2, 1}}, 0.6),
                             failed_run({"region_s2", 2, {2, 2, 2}}, "why"),
                             made_up_run({"region_s4", 4, {2, 2, 4}}, 0.25)};
  runs = with_distance_variations(std::move(runs));
  EXPECT_FALSE(runs[0].comparison->variation_percent);
  EXPECT_NEAR(runs[1].comparison->variation_percent.value(), 20, 1e-9);
  EXPECT_FALSE(runs[2].comparison);
  EXPECT_NEAR(runs[3].comparison->variation_percent.value(), -50, 1e-9);
}

TEST(DistanceVariations, NeedABaselineWithDistances) {
  const PlannedRun plan{"s2", 2, {1, 1, 2}}, full{"region_full", 1, {1, 1, 1}, true};
  for (const StudyRun& first :
       {made_up_run(plan, 0.5), failed_run(full, "why"), made_up_run(full, 0)}) {
    const auto runs = with_distance_variations({first, made_up_run(plan, 0.5)});
    EXPECT_FALSE(runs[1].comparison->variation_percent) << first.plan.name << first.failure;
  }
}

}  // namespace
}  // namespace mesamis
