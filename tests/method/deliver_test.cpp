// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/deliver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/base/error.h"
#include "mesamis/surface/extract.h"
#include "support/ball_volume.h"

namespace mesamis {
namespace {

struct Ball {
  explicit Ball(const Settings& given, bool mirrored = false) : settings(given) {
    scan = make_ball({.size = 18, .radius = 5});
    scan.origin = {10, 20, 30};
    if (mirrored) scan.direction.rows[0] = {-1, 0, 0};
    settings.max_tets = 3000;
    settings.adaptations = 1;
    prepared = prepare_image(scan, settings);
  }
  Result delivered(const Progress& progress = {}) const {
    const RunInput run(prepared);
    Result result;
    result.parameters = prepared.parameters;
    deliver_loop(run, run_loop(run, {}), progress, result);
    return result;
  }
  Settings settings;
  Volume scan;
  Prepared prepared;
};

Vec3 center_of(const Volume& scan) { return scan.to_world(0.5 * scan.box().extent()); }

TEST(DeliverLoop, SurfaceAndMeshLieInTheWorldWithTheirOutsideOut) {
  for (const bool mirrored : {false, true}) {
    const Ball ball({}, mirrored);
    const Result result = ball.delivered();
    EXPECT_EQ(solid_flaws_of(check_surface(result.surface)), "");
    const Vec3 center = center_of(ball.scan);
    for (const Vec3& p : result.surface.points) EXPECT_NEAR(norm(p - center), 5, 0.6);
    double volume = 0;
    for (std::size_t c = 0; c < result.mesh.cells.size(); ++c) {
      volume += cell_volume(result.mesh, static_cast<Index>(c));
    }
    EXPECT_NEAR(volume, 17.0 * 17 * 17, 1e-6);
    EXPECT_EQ(result.u.size(), result.mesh.points.size());
    EXPECT_EQ(result.iterations.size(), 2U);
  }
}

TEST(DeliverLoop, ABandIsDeliveredAsItIs) {
  Settings settings;
  settings.surface = SurfaceKind::kBand;
  const Ball ball(settings);
  Result result = ball.delivered();
  ASSERT_FALSE(result.surface.triangles.empty());
  const TriMesh before = result.surface;
  finish_surface(RunInput(ball.prepared), {}, result);
  EXPECT_TRUE(result.surface.points == before.points);
  EXPECT_TRUE(result.surface.triangles == before.triangles);
  EXPECT_EQ(result.printable.triangles_extracted, std::ssize(before.triangles));
}

TEST(DeliverLoop, StopsWhereProgressSays) {
  EXPECT_THROW(Ball({}).delivered([](std::string_view, double) { return false; }), Cancelled);
}

TEST(DeliverSurface, MovesPointsOnlyIfAsked) {
  for (const auto& [follow, fit] : {std::pair{false, false}, {true, false}, {false, true}}) {
    Settings settings;
    settings.follow = follow;
    settings.fit = fit;
    const Ball ball(settings);
    const RunInput run(ball.prepared);
    const Parameters& p = ball.prepared.parameters;
    // A cube around the level set: what follows the image moves towards it.
    const TetMesh mesh = box_mesh(run.box, {6, 6, 6});
    std::vector<double> u;
    for (const Vec3& point : mesh.points) {
      const double r = norm(p.unit_mm * point - 0.5 * ball.scan.box().extent());
      u.push_back(p.grey.to_grey(p.level) + 10 * (5.3 - r));
    }
    const TriMesh extracted = extract_solid(mesh, u, p.grey.to_grey(p.level));
    Result result;
    deliver_surface(run, extracted, result);
    EXPECT_GT(result.seconds.surface, 0);
    TriMesh in_world = extracted;
    bring_to_world(run, in_world.points);
    EXPECT_EQ(result.surface.points == in_world.points, !follow && !fit);
  }
}

TEST(FinishSurface, SetsTheToleranceThatIsLeftOpen) {
  const Ball open({});
  const Result extracted = open.delivered();
  Result result = extracted;
  finish_surface(RunInput(open.prepared), {}, result);
  ASSERT_TRUE(result.parameters.tolerance);
  EXPECT_GT(*result.parameters.tolerance, 0);
  EXPECT_LT(result.surface.triangles.size(), extracted.surface.triangles.size());
  EXPECT_EQ(result.printable.triangles_extracted, std::ssize(extracted.surface.triangles));
  EXPECT_TRUE(result.printable.within(*result.parameters.tolerance));
  EXPECT_EQ(result.expected_error.size(), result.surface.points.size());

  Settings settings;
  settings.tolerance = 0.3;
  const Ball given(settings);
  Result other = given.delivered();
  finish_surface(RunInput(given.prepared), {}, other);
  EXPECT_EQ(other.parameters.tolerance, 0.3);
}

}  // namespace
}  // namespace mesamis
