// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/label_output.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "mesamis/base/parallel.h"
#include "support/level_set.h"
#include "support/throws.h"

namespace mesamis {
namespace {

const Vec3 kCenter{12.3, 11.7, 12.9};

TriMesh ball(double radius) {
  return level_set({{0, 0, 0}, {25, 25, 25}}, {50, 50, 50},
                   [radius](const Vec3& p) { return radius - norm(p - kCenter); });
}

TriMesh turned_inside_out(TriMesh surface) {
  for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
  return surface;
}

TriMesh both(TriMesh a, const TriMesh& b) {
  const auto shift = static_cast<Index>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const Triangle& t : b.triangles) {
    a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  }
  return a;
}

const VoxelGrid kGrid{.size = {26, 26, 26}};

/// Voxels whose mark is not that of a shell between two radii, further than a hair from both.
int wrong_voxels(const LabelMap& map, double inner, double outer) {
  int wrong = 0;
  for (Index k = 0; k < map.size[2]; ++k) {
    for (Index j = 0; j < map.size[1]; ++j) {
      for (Index i = 0; i < map.size[0]; ++i) {
        const Vec3 world = map.to_world({i * map.spacing.x, j * map.spacing.y, k * map.spacing.z});
        const double r = norm(world - kCenter);
        if (std::abs(r - inner) < 0.05 || std::abs(r - outer) < 0.05) continue;
        const bool inside = r > inner && r < outer;
        wrong += (map.layers[0][map.offset(i, j, k)] == 3) != inside ? 1 : 0;
      }
    }
  }
  return wrong;
}

TEST(LabelOutput, MarksTheVoxelsInside) {
  const TriMesh surface = ball(9);
  const FoundObject object{surface, {"ball", 3, 0, {}}};
  const LabelMap map = label_map_of(kGrid, {&object, 1});
  EXPECT_NO_THROW(require_valid(map));
  EXPECT_EQ(wrong_voxels(map, -1, 9), 0);
}

TEST(LabelOutput, LeavesCavitiesOut) {
  const TriMesh surface = both(ball(10), turned_inside_out(ball(5)));
  const FoundObject object{surface, {"shell", 3, 0, {}}};
  EXPECT_EQ(wrong_voxels(label_map_of(kGrid, {&object, 1}), 5, 10), 0);
}

TEST(LabelOutput, FollowsObliqueAndMirroredGrids) {
  const TriMesh surface = ball(9);
  const FoundObject object{surface, {"ball", 3, 0, {}}};
  const double c = std::cos(0.5), s = std::sin(0.5);
  VoxelGrid oblique{.size = {40, 44, 30}, .spacing = {0.9, 0.8, 1.3}, .origin = {2, -8, -5}};
  oblique.direction.rows = {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
  EXPECT_EQ(wrong_voxels(label_map_of(oblique, {&object, 1}), -1, 9), 0);
  VoxelGrid mirrored{.size = {26, 26, 26}, .origin = {25, 0, 0}};
  mirrored.direction.rows = {{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  EXPECT_EQ(wrong_voxels(label_map_of(mirrored, {&object, 1}), -1, 9), 0);
}

TEST(LabelOutput, HandlesCentresOnTheSurface) {
  // A box whose faces pass through centres: each row is marked from one face to the other.
  const TriMesh box = level_set({{0, 0, 0}, {10, 10, 10}}, {10, 10, 10}, [](const Vec3& p) {
    const Vec3 d = p - Vec3{5, 5, 5};
    return 3.0 - std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  });
  const FoundObject object{box, {"box", 1, 0, {}}};
  const LabelMap map = label_map_of({.size = {11, 11, 11}}, {&object, 1});
  const auto marked = std::count(map.layers[0].begin(), map.layers[0].end(), 1);
  EXPECT_GE(marked, 5 * 5 * 5);
  EXPECT_LE(marked, 7 * 7 * 7);
}

TEST(LabelOutput, GivesObjectsTheirLabelsAndLayers) {
  const TriMesh large = ball(9), small = ball(4);
  const std::vector<FoundObject> objects{{large, {"large", 7, 0, {}}},
                                         {small, {"small", 7, 1, {}}}};
  const LabelMap map = label_map_of(kGrid, objects);
  ASSERT_EQ(map.layers.size(), 2U);
  EXPECT_NO_THROW(require_valid(map));
  EXPECT_GT(std::count(map.layers[0].begin(), map.layers[0].end(), 7),
            8 * std::count(map.layers[1].begin(), map.layers[1].end(), 7));
}

TEST(LabelSurfaces, KeepOverlappingObjectsWhole) {
  const TriMesh large = ball(9), small = ball(4);
  TriMesh beside = ball(2);
  for (Vec3& p : beside.points) p.x += 100;
  const std::vector<FoundObject> objects{
      {large, {"a", 1, 0, {}}}, {small, {"b", 2, 5, {}}}, {beside, {"c", 3, 0, {}}}};
  const SurfaceLabels labels = labels_of_surfaces(kGrid, objects);
  EXPECT_NO_THROW(require_valid(labels.map));
  EXPECT_EQ(labels.map.layers.size(), 2u);
  const auto counts = voxel_counts(labels.map);
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(static_cast<double>(counts[0]), 4 * pi / 3 * 729, 20);
  EXPECT_NEAR(static_cast<double>(counts[1]), 4 * pi / 3 * 64, 10);
  EXPECT_EQ(counts[2], 0u);
  EXPECT_THAT(labels.warnings, testing::ElementsAre(testing::HasSubstr("'b' overlaps"),
                                                    testing::HasSubstr("'c' has no voxel")));
  EXPECT_REFUSED(labels_of_surfaces(kGrid, std::span(objects).last(1)),
                 testing::HasSubstr("found none inside"));
}

TEST(MissingObjects, AreNamedAndNoneAtAllIsRefused) {
  LabelResult result;
  const Segment hip{"hip", 2, 0, {}}, femur{"femur", 3, 0, {}};
  EXPECT_REFUSED(missing_objects(result, std::vector{hip}), testing::HasSubstr("found none"));
  result.objects.push_back({hip, ball(5), {}, 0});
  EXPECT_THAT(missing_objects(result, std::vector{hip, femur}),
              testing::ElementsAre("labels: nothing was found of 'femur'"));
  const std::vector<FoundObject> found = found_objects(result);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(&found[0].surface, &result.objects[0].surface);
  EXPECT_EQ(found[0].segment, hip);
}

}  // namespace
}  // namespace mesamis
