// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/skin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/remesh/collapse.h"
#include "remesh/small_body.h"
#include "support/expect_near.h"

namespace mesamis {
namespace {

/// Below the plane z = 0.5 one material, above it another; or nothing.
const FormulaMetric kMetric = uniform_metric(0.5);
const PlaneShape kTwoHalves({0, 0, 1}, 0.5, 1, 2), kLowerHalf({0, 0, 1}, 0.5, 1, kOutside);

TEST(Skin, IsBetweenTwoMaterials) {
  const TetMesh pair{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}},
                     {{0, 1, 2, 3}, {4, 2, 1, 3}}};
  SmallMesh small(pair, kMetric);
  small.mesh.shape = &kTwoHalves;
  auto skin_faces = [&] {
    int count = 0;
    for (Index c = 0; c < 2; ++c) {
      for (int f = 0; f < 4; ++f) {
        if (!is_skin(small.mesh, c, f)) continue;
        // The one face that both share, opposite the first point of each.
        EXPECT_EQ(f, 0);
        ++count;
      }
    }
    return count;
  };
  EXPECT_EQ(skin_faces(), 0) << "faces of the box are none";
  small.mesh.cells[1].material = 2;
  EXPECT_EQ(skin_faces(), 2);
}

TEST(Skin, FacesAreThoseOfTheBorder) {
  SmallBody body(box_mesh(kUnitBox, {4, 4, 4}), kMetric, kTwoHalves);
  int count = 0;
  for (Index c = 0; c < std::ssize(body.mesh.cells); ++c) {
    for (int f = 0; f < 4; ++f) {
      if (!is_skin(body.mesh, c, f)) continue;
      ++count;
      for (const int i : kCellFaces[f]) {
        EXPECT_EQ(body.mesh.vertices[body.mesh.cells[c].points[i]].position.z, 0.5);
      }
    }
  }
  EXPECT_EQ(count, 2 * 2 * 4 * 4);  // two triangles per square, seen from both sides
}

TEST(Skin, VerticesKnowWhatMeetsThere) {
  SmallBody body(box_mesh(kUnitBox, {4, 4, 4}), kMetric, kTwoHalves);
  auto features = [&](const Vec3& p) {
    const Index v = body.vertex_at(p);
    return vertex_features(body.mesh, body.ball(v), v);
  };
  EXPECT_EQ(features({0.5, 0.5, 0.25}).freedom(), 3);
  EXPECT_FALSE(features({0.5, 0.5, 0.25}).on_skin());
  EXPECT_EQ(features({0, 0.5, 0.25}).freedom(), 2);
  EXPECT_EQ(features({0, 0, 0.25}).freedom(), 1);
  EXPECT_EQ(features({0, 0, 0}).freedom(), 0);
  const Features middle = features({0.5, 0.5, 0.5});
  EXPECT_TRUE(middle.on_skin());
  EXPECT_TRUE(middle.materials[1] && middle.materials[2] && !middle.materials[kOutside]);
  EXPECT_EQ(middle.freedom(), 2);
  EXPECT_EQ(features({0, 0.5, 0.5}).freedom(), 1);
  EXPECT_EQ(features({0, 0, 0.5}).freedom(), 0);
}

TEST(Skin, TheOutsideIsAMaterial) {
  SmallBody body(box_mesh(kUnitBox, {4, 4, 4}), kMetric, kLowerHalf);
  auto features = [&](const Vec3& p) {
    const Index v = body.vertex_at(p);
    return vertex_features(body.mesh, body.ball(v), v);
  };
  EXPECT_TRUE(features({0.5, 0.5, 0.5}).materials[kOutside]);
  EXPECT_EQ(features({0.5, 0.5, 0.5}).freedom(), 2);
  EXPECT_FALSE(features({0.5, 0.5, 0}).materials[kOutside]) << "the box is no skin";
  EXPECT_EQ(features({0.5, 0.5, 0}).freedom(), 2);
}

TEST(Skin, EdgesKnowWhatMeetsThere) {
  SmallBody two(box_mesh(kUnitBox, {4, 4, 4}), kMetric, kTwoHalves);
  EXPECT_TRUE(two.edge({0.5, 0.5, 0.5}, {0.75, 0.5, 0.5}).on_skin());
  EXPECT_FALSE(two.edge({0.5, 0.5, 0.5}, {0.5, 0.5, 0.75}).on_skin());
  EXPECT_EQ(two.edge({0, 0.5, 0.5}, {0, 0.75, 0.5}).planes, 1u);
  EXPECT_TRUE(two.edge({0, 0.5, 0.5}, {0, 0.75, 0.5}).on_skin());
  EXPECT_EQ(two.edge({0, 0.5, 0.5}, {0.25, 0.5, 0.5}).planes, 0u);
  SmallBody one(box_mesh(kUnitBox, {4, 4, 4}), kMetric, kLowerHalf);
  EXPECT_TRUE(one.edge({0.5, 0.5, 0.5}, {0.75, 0.5, 0.5}).materials[kOutside]);
  EXPECT_FALSE(one.edge({0.5, 0.5, 0.25}, {0.75, 0.5, 0.25}).on_skin());
  EXPECT_FALSE(one.edge({0.5, 0.5, 0}, {0.75, 0.5, 0}).on_skin());
}

TEST(Skin, PlacesAreTakenToTheBorderAndTheBox) {
  SmallBody body(box_mesh(kUnitBox, {4, 4, 4}), kMetric, kTwoHalves);
  const auto features = body.edge({0, 0.5, 0.5}, {0, 0.75, 0.5});
  expect_near(onto_features(body.mesh, {0.1, 0.6, 0.58}, features), {0, 0.6, 0.5});
  expect_near(onto_features(body.mesh, {0.1, 0.6, 0.58}, {}), {0.1, 0.6, 0.58});
}

TEST(Skin, NormalIsThatOfTheBorder) {
  SmallBody body(box_mesh(kUnitBox, {4, 4, 4}), kMetric, kTwoHalves);
  const Index v = body.vertex_at({0.5, 0.5, 0.5});
  expect_near(skin_normal(body.mesh, body.ball(v), v), {0, 0, 1});
}

TEST(Skin, DeviationIsInTolerances) {
  SmallBody body(box_mesh(kUnitBox, {4, 4, 4}), kMetric, kTwoHalves);
  EXPECT_NEAR(deviation(body.mesh, {0.3, 0.3, 0.5 + 3 * PlaneShape::kTolerance}), 3, 1e-12);
}

TEST(Skin, TurnedTrianglesAreRefused) {
  SmallBody body(box_mesh(kUnitBox, {4, 4, 4}), kMetric, kTwoHalves);
  const Corners3 flat{Vec3{0, 0, 0.5}, Vec3{1, 0, 0.5}, Vec3{0, 1, 0.5}};
  const Corners3 turned{flat[0], flat[2], flat[1]};
  const Corners3 without_area{flat[0], flat[1], flat[0]};
  auto may = [&](const Corners3& before, const Corners3& after) {
    return may_replace_skin(body.mesh, std::span(&before, 1), std::span(&after, 1));
  };
  EXPECT_TRUE(may(flat, flat));
  EXPECT_TRUE(may(flat, {flat[0], flat[1], Vec3{0.3, 0.7, 0.5}}));
  EXPECT_FALSE(may(flat, turned));
  EXPECT_FALSE(may(flat, without_area));
}

TEST(Skin, TrianglesOffTheBorderAreRefusedUnlessTheOldOnesWereToo) {
  SmallBody body(box_mesh(kUnitBox, {4, 4, 4}), kMetric, kTwoHalves);
  auto at_height = [](double z) { return Corners3{Vec3{0, 0, z}, Vec3{1, 0, z}, Vec3{0, 1, z}}; };
  auto may = [&](double before, double after) {
    const Corners3 old_one = at_height(before), new_one = at_height(after);
    return may_replace_skin(body.mesh, std::span(&old_one, 1), std::span(&new_one, 1));
  };
  constexpr double kOff = PlaneShape::kTolerance;
  EXPECT_TRUE(may(0.5, 0.5 + 0.9 * kOff));
  EXPECT_FALSE(may(0.5, 0.5 + 1.1 * kOff));
  EXPECT_TRUE(may(0.5 + 3 * kOff, 0.5 + 2 * kOff));
  EXPECT_FALSE(may(0.5 + 2 * kOff, 0.5 - 3 * kOff));
}

TEST(Skin, VerticesCollapseAlongIt) {
  SmallBody body(box_mesh(kUnitBox, {4, 4, 4}), kMetric, kTwoHalves);
  auto may = [&](const Vec3& from, const Vec3& onto) {
    const Index vertex = body.vertex_at(from);
    return may_collapse_in_body(body.bench, body.ball(vertex), vertex, body.vertex_at(onto));
  };
  EXPECT_TRUE(may({0.5, 0.5, 0.5}, {0.75, 0.5, 0.5}));
  EXPECT_FALSE(may({0.5, 0.5, 0.5}, {0.5, 0.5, 0.75})) << "off the skin";
  EXPECT_FALSE(may({0, 0.5, 0.5}, {0.25, 0.5, 0.5})) << "off the plane of the box";
  EXPECT_TRUE(may({0, 0.5, 0.5}, {0, 0.75, 0.5}));
}

/// A wall of one layer of cells between two sheets of skin: what joins the sheets is not on the
/// skin, and a collapse along it would make them one.
TEST(Skin, ACollapseThatWouldPinchTheBodyIsRefused) {
  const SlabShape wall(0.25, 0.5);
  SmallBody body(box_mesh(kUnitBox, {4, 4, 4}), kMetric, wall);
  const Index lower = body.vertex_at({0.5, 0.5, 0.25}), upper = body.vertex_at({0.5, 0.5, 0.5});
  ASSERT_NE(cell_with(body.mesh, lower, upper), kNoIndex);
  ASSERT_TRUE(body.mesh.vertices[lower].mask & kOnSkin);
  ASSERT_TRUE(body.mesh.vertices[upper].mask & kOnSkin);
  EXPECT_FALSE(may_collapse_in_body(body.bench, body.ball(lower), lower, upper));
  EXPECT_FALSE(may_collapse_in_body(body.bench, body.ball(upper), upper, lower));
  const auto cells = body.mesh.cell_count();
  EXPECT_FALSE(collapse_vertex(body.bench, lower, upper, {.new_length_max = 100}));
  EXPECT_EQ(body.mesh.cell_count(), cells);
  EXPECT_TRUE(
      may_collapse_in_body(body.bench, body.ball(lower), lower, body.vertex_at({0.75, 0.5, 0.25})));
}

/// Whatever collapses are tried on a wall of one layer, it stays a wall.
TEST(Skin, AWallIsNotCutThrough) {
  const SlabShape wall(0.25, 0.5);
  SmallBody body(box_mesh(kUnitBox, {4, 4, 4}), kMetric, wall);
  std::int64_t collapses = 0;
  for (Index v = 0; v < std::ssize(body.mesh.vertices); ++v) {
    for (Index onto = 0; onto < std::ssize(body.mesh.vertices); ++onto) {
      if (v == onto || body.mesh.vertices[v].cell == kNoIndex) continue;
      if (cell_with(body.mesh, v, onto) == kNoIndex) continue;
      collapses += collapse_vertex(body.bench, v, onto, {.new_length_max = 100});
    }
  }
  EXPECT_GT(collapses, 10);
  expect_sound_body(body.mesh);
  EXPECT_NEAR(volume_of(body.mesh), 0.25, 1e-12);
}

}  // namespace
}  // namespace mesamis
