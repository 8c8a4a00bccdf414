// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/body_skin.h"

#include <gtest/gtest.h>

#include <tuple>

#include "support/shapes.h"
#include "support/solids.h"

namespace mesamis {
namespace {

/// A brick of two materials: what of it lies at x < 1 is 1, the rest 2.
BodyMesh two_halves() {
  BodyMesh body{box_mesh({{0, 0, 0}, {2, 1, 1}}, {4, 2, 2}), {}};
  for (const Cell& cell : body.mesh.cells) {
    double sum = 0;
    for (const Vec3& p : cell_corners(body.mesh, cell)) sum += p.x;
    body.materials.push_back(sum < 4 ? 1 : 2);
  }
  return body;
}

TEST(BodySkin, OfABoxMeshIsItsBoundary) {
  const BodyMesh body = two_halves();
  for (const auto& [object, volume, area] :
       {std::tuple{0, 2.0, 10.0}, std::tuple{1, 1.0, 6.0}, std::tuple{2, 1.0, 6.0}}) {
    const auto check = check_surface(body_skin(body, static_cast<Material>(object)));
    EXPECT_EQ(solid_flaws_of(check), "");
    EXPECT_NEAR(check.volume, volume, 1e-12);
    EXPECT_NEAR(check.area, area, 1e-12);
  }
  EXPECT_TRUE(body_skin(body, 3).triangles.empty());
  EXPECT_TRUE(body_skin(body, 3).points.empty());
}

TEST(BodySkins, AreThoseOfEachObject) {
  const BodyMesh body = two_halves();
  const auto skins = body_skins(body, 3);
  ASSERT_EQ(skins.size(), 3u);
  for (Material object = 1; object <= 3; ++object) {
    const TriMesh one = body_skin(body, object);
    EXPECT_EQ(skins[object - 1U].points, one.points);
    EXPECT_EQ(skins[object - 1U].triangles, one.triangles);
  }
}

}  // namespace
}  // namespace mesamis
