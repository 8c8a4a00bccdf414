// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/surface_piece.h"

#include <gtest/gtest.h>

#include "support/throws.h"

namespace mesamis {
namespace {

/// Two triangles over the square from (x, 0) to (x + 1, 1), moved up.
SurfacePiece square(double x) {
  SurfacePiece piece;
  for (const auto& [dx, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
    piece.points.push_back({{x + dx, y, 0}, {x + dx, y, 1}});
  }
  piece.triangles = {{0, 1, 2}, {0, 2, 3}};
  return piece;
}

TEST(SurfacePiece, JoinsPointsOfTheSameKey) {
  SurfacePiece left = square(0), right = square(1);
  right.points[0].at = {1, 0, 2};  // the first piece's place stays
  right.points[3].settled = true;
  const SurfacePiece both = join({left, right});
  ASSERT_EQ(both.points.size(), 6u);
  EXPECT_EQ(both.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}));
  EXPECT_TRUE(both.points[1].at == (Vec3{1, 0, 1}));
  EXPECT_FALSE(both.points[1].settled);
  EXPECT_TRUE(both.points[2].settled) << "one of them says so";
}

TEST(SurfacePiece, SelectsTrianglesAndTheirPoints) {
  const SurfacePiece some = select(square(0), {0, 1});
  ASSERT_EQ(some.points.size(), 3u);
  EXPECT_TRUE(some.points[1].key == (Vec3{1, 1, 0}));
  EXPECT_EQ(some.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(SurfacePiece, TellsItsRim) {
  SurfacePiece fan = square(0);
  fan.points.push_back({{0.5, 0.5, 0}, {0.5, 0.5, 1}});
  fan.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  EXPECT_EQ(rim_of(fan), (std::vector<char>{1, 1, 1, 1, 0}));
  EXPECT_EQ(mesh_of(fan, &SurfacePoint::key).points[4].z, 0);
  EXPECT_EQ(mesh_of(fan, &SurfacePoint::at).points[4].z, 1);
}

TEST(SurfacePiece, ComesBackFromAnArchive) {
  SurfacePiece piece = square(3);
  piece.points[2].settled = true;
  ArchiveWriter writer;
  add_surface(writer, piece);
  ArchiveReader reader(std::string(writer.bytes()), "file");
  const SurfacePiece read = next_surface(reader);
  EXPECT_EQ(read.triangles, piece.triangles);
  ASSERT_EQ(read.points.size(), 4u);
  EXPECT_TRUE(read.points[2].settled);
  EXPECT_TRUE(read.points[1].at == piece.points[1].at);
  EXPECT_REFUSED(next_surface(reader), testing::HasSubstr("file"));
}

}  // namespace
}  // namespace mesamis
