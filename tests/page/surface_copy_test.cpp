// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/surface_copy.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "mesamis/surface/tri_mesh.h"
#include "page/unpacked.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace mesamis {
namespace {

template <class T>
T at(const std::string& bytes, std::size_t place) {
  T value;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

TEST(Mz3, HoldsTheTrianglesAndThePointsInRas) {
  const TriMesh box = cube({1, 2, 3}, 4);
  const std::string file = unpacked(mz3_gz({box, {}}));
  ASSERT_EQ(file.size(), 16u + 12 * 12 + 8 * 12);
  EXPECT_EQ(file.substr(0, 2), "MZ");
  EXPECT_EQ(at<std::uint16_t>(file, 2), 3) << "faces and points";
  EXPECT_EQ(at<std::uint32_t>(file, 4), 12u);
  EXPECT_EQ(at<std::uint32_t>(file, 8), 8u);
  EXPECT_EQ(at<std::int32_t>(file, 16 + 4), box.triangles[0][1]);
  EXPECT_NEAR(at<float>(file, 16 + 144), -1, 1e-3);
  EXPECT_NEAR(at<float>(file, 16 + 148), -2, 1e-3);
  EXPECT_NEAR(at<float>(file, 16 + 152), 3, 1e-3);
}

TEST(Mz3, HoldsAValueAtEachPoint) {
  const TriMesh box = cube({1, 2, 3}, 4);
  const std::vector<double> values{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
  const std::string file = unpacked(mz3_gz({box, values}));
  ASSERT_EQ(file.size(), 16u + 12 * 12 + 8 * 12 + 8 * 4);
  EXPECT_EQ(at<std::uint16_t>(file, 2), 3 | 8) << "faces, points and scalars";
  for (std::size_t n = 0; n < values.size(); ++n) {
    EXPECT_NEAR(at<float>(file, 16 + 144 + 96 + 4 * n), values[n], 0.8 / 256);
  }
}

TEST(CoarseSurface, HasFewerTrianglesNearTheSurface) {
  const TriMesh ball = ball_surface(10, 200);
  const SurfaceCopy copy =
      coarse_surface({ball, std::vector<double>(ball.points.size(), 0.5)}, 2000);
  const TriMesh& coarse = copy.surface;
  ASSERT_EQ(copy.values.size(), coarse.points.size());
  for (const double value : copy.values) EXPECT_NEAR(value, 0.5, 1e-12);
  EXPECT_LE(coarse.triangles.size(), 2000u);
  EXPECT_GT(coarse.triangles.size(), 500u);
  EXPECT_NO_THROW(require_sound(coarse));
  for (const Vec3& p : coarse.points) EXPECT_NEAR(norm(p), 10, 0.3);
}

TEST(CoarseSurface, LeavesASmallSurface) {
  const TriMesh box = cube();
  EXPECT_EQ(coarse_surface({box, {}}, 12).surface.triangles, box.triangles);
  const TriMesh flat{{{1, 1, 1}}, {{0, 0, 0}, {0, 0, 0}}};
  EXPECT_EQ(coarse_surface({flat, {}}, 1).surface.triangles.size(), 2u) << "no area";
}

}  // namespace
}  // namespace mesamis
