// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/body_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mesamis/body/make_body.h"
#include "support/metric_fields.h"

namespace mesamis {
namespace {

constexpr double kTolerance = 0.1;

/// The unit box in cells, of two materials below and above its middle where asked.
BodyMesh bricks(int along, bool halved) {
  BodyMesh body;
  body.mesh = box_mesh(kUnitBox, {along, along, along});
  for (Index c = 0; c < std::ssize(body.mesh.cells); ++c) {
    Vec3 sum;
    for (const Index p : body.mesh.cells[c]) sum += body.mesh.points[p];
    body.materials.push_back(halved && sum.z > 2 ? 2 : 1);
  }
  return body;
}

TEST(BodyFit, OfItsOwnSkinIsExact) {
  const BodyMesh body = bricks(4, true);
  const std::vector<TriMesh> skins{body_skin(body, 1), body_skin(body, 2)};
  const BodyFit fit = measure_fit(body, skins, kTolerance);
  EXPECT_LE(fit.skin_to_surface, 0.01 * kTolerance);
  EXPECT_LE(fit.surface_to_skin, 0.01 * kTolerance);
  EXPECT_NEAR(fit.volume_ratio, 1, 1e-12);
}

TEST(BodyFit, DistancesAreThoseOfAMovedFace) {
  const BodyMesh body = bricks(4, false);
  TriMesh taller = body_skin(body, 1);
  for (Vec3& p : taller.points) {
    if (p.z == 1) p.z = 1.5;
  }
  const BodyFit fit = measure_fit(body, std::vector{taller}, kTolerance);
  EXPECT_NEAR(fit.surface_to_skin, 0.5, 0.01 * kTolerance);
  EXPECT_NEAR(fit.skin_to_surface, 0.5, 0.01 * kTolerance);
  EXPECT_NEAR(fit.volume_ratio, 1 / 1.5, 1e-12);
}

TEST(BodyFit, AnObjectWithoutElementsIsInfinitelyFar) {
  const BodyMesh body = bricks(2, false);
  const TriMesh skin = body_skin(body, 1);
  EXPECT_EQ(measure_fit(body, std::vector{skin, skin}, kTolerance).surface_to_skin, INFINITY);
}

TEST(BodyFit, CountsElementsWhoseCornersAreAllOnTheBoundary) {
  const BodyMesh one = bricks(1, false), four = bricks(4, false);
  const auto count = [](const BodyMesh& body) {
    return measure_fit(body, std::vector{body_skin(body, 1)}, kTolerance).elements_of_skin_only;
  };
  EXPECT_EQ(count(one), std::ssize(one.mesh.cells));
  EXPECT_GT(count(four), 0);  // at the edges of the box
  EXPECT_LT(count(four), std::ssize(four.mesh.cells) / 2);
}

}  // namespace
}  // namespace mesamis
