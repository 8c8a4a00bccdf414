// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/label_output.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

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

/// A box between two corners, in the axes of a grid, mm.
TriMesh block(const VoxelGrid& grid, const Vec3& lo, const Vec3& hi) {
  TriMesh mesh = level_set({lo, hi}, {3, 3, 3}, [](const Vec3&) { return 1.0; });
  for (Vec3& p : mesh.points) p = grid.to_world(p);
  return mesh;
}

/// As a file of single precision has it.
TriMesh rounded(TriMesh mesh) {
  for (Vec3& p : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(p[axis]);
  }
  return mesh;
}

Vec3 centre(const VoxelGrid& grid, double i, double j, double k) {
  return {i * grid.spacing.x, j * grid.spacing.y, k * grid.spacing.z};
}

/// Grids of 9 x 8 x 7 voxels: plain, anisotropic, oblique, left-handed, far from the origin.
std::vector<VoxelGrid> grids() {
  const double c = std::cos(0.3), s = std::sin(0.3);
  VoxelGrid plain{.size = {9, 8, 7}}, uneven = plain, oblique = plain, left = plain, far = plain;
  uneven.spacing = {0.3, 0.7, 2.9};
  uneven.origin = {0.1, 0.2, 0.3};
  oblique.spacing = {0.33, 0.47, 1.1};
  oblique.origin = {-211.7, 95.3, 1021.9};
  oblique.direction.rows = {{{c, -s, 0}, {s * c, c * c, -s}, {s * s, c * s, c}}};
  left.direction.rows = {{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  left.origin = {8.1, 0, 0};
  far.spacing = {0.01, 0.01, 0.01};
  far.origin = {512.3, -1999.9, 77.7};
  return {plain, uneven, oblique, left, far};
}

TEST(LabelOutput, CentresOnTheSurfaceAreInside) {
  for (const VoxelGrid& grid : grids()) {
    const Vec3 end = grid.box().hi;
    struct Case {
      Vec3 lo, hi;
      std::ptrdiff_t voxels;
    };
    const std::vector<Case> cases{
        {{0, 0, 0}, end, 9 * 8 * 7},  // the border of the scan on all sides
        {centre(grid, 2.5, 0, 2.5), centre(grid, 4.5, 7, 4.5), 2 * 8 * 2},  // on two sides
        {centre(grid, 0, 2.4, 2.4), centre(grid, 3.6, 4.6, 4.6), 4 * 2 * 2},
        {centre(grid, 1, 2, 3), centre(grid, 6, 5, 5), 6 * 4 * 3}};  // that of a crop
    for (const Case& c : cases) {
      const TriMesh exact = block(grid, c.lo, c.hi), file = rounded(exact);
      for (const TriMesh* surface : {&exact, &file}) {
        const FoundObject object{*surface, {"box", 1, 0, {}}};
        const LabelMap map = label_map_of(grid, {&object, 1});
        EXPECT_EQ(std::count(map.layers[0].begin(), map.layers[0].end(), 1), c.voxels);
        EXPECT_EQ(labels_of_surfaces(grid, {&object, 1}).map.layers, map.layers);
      }
    }
  }
}

TEST(LabelOutput, CentresBetweenTouchingObjectsAreTheFirstOnes) {
  for (const VoxelGrid& grid : grids()) {
    // Along each axis two boxes from border to border that meet on centres.
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 middle = grid.box().hi, start{};
      middle[axis] = start[axis] = 3 * grid.spacing[axis];
      const TriMesh a = rounded(block(grid, {0, 0, 0}, middle));
      const TriMesh b = rounded(block(grid, start, grid.box().hi));
      const std::vector<FoundObject> objects{{a, {"a", 1, 0, {}}}, {b, {"b", 2, 0, {}}}};
      const auto size = static_cast<std::size_t>(grid.size[static_cast<std::size_t>(axis)]);
      const std::size_t slice = grid.voxel_count() / size;
      for (const LabelMap& map :
           {label_map_of(grid, objects), labels_of_surfaces(grid, objects).map}) {
        ASSERT_EQ(map.layers.size(), 1u);
        const auto counts = voxel_counts(map);
        EXPECT_EQ(counts[0] + counts[1], grid.voxel_count());
        EXPECT_EQ(counts[0], 4 * slice);
      }
    }
  }
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

/// Noise is told of, a stack of sheets and a solid object are not.
TEST(NoiseWarnings, AreOfNoiseAlone) {
  LabelMap map;
  map.size = {40, 40, 40};
  map.segments = {{"a", 1, 0, {}}, {"b", 2, 0, {}}};
  const auto warnings_of = [&](const auto& label_at) {
    map.layers.assign(1, {});
    for (std::size_t n = 0; n < map.voxel_count(); ++n) {
      map.layers[0].push_back(static_cast<std::uint16_t>(label_at(n)));
    }
    return noise_warnings(map);
  };
  std::mt19937 random(1);
  EXPECT_THAT(warnings_of([&](std::size_t) { return random() % 3; }),
              testing::ElementsAre(testing::HasSubstr("as in noise")));
  EXPECT_THAT(warnings_of([](std::size_t n) { return n / 1600 % 2; }), testing::IsEmpty());
  EXPECT_THAT(warnings_of([](std::size_t n) { return n > 20'000 ? 1 : 0; }), testing::IsEmpty());
  EXPECT_THAT(warnings_of([](std::size_t) { return 0; }), testing::IsEmpty());
}

TEST(ChangedVolumes, AreToldOfSurfacesThatHoldMuchLessOrMoreThanTheirLabels) {
  LabelMap map;
  map.size = {10, 10, 10};
  map.spacing = {1, 2, 0.5};
  map.segments = {{"hip", 4, 0, {}}, {"bone", 5, 0, {}}};
  const TriMesh box = level_set({{0, 0, 0}, {4, 5, 6}}, {3, 3, 3}, [](const Vec3&) { return 1.0; });
  // Voxels of 1 mm^3 and a surface of 120: 72 and 200 are the limits.
  for (const int voxels : {26, 71, 73, 199, 201}) {
    map.layers = {std::vector<std::uint16_t>(1000, 0)};
    std::fill_n(map.layers[0].begin(), voxels, std::uint16_t{4});
    LabelResult result;
    result.objects.push_back({map.segments[0], box, {}, 0});
    const auto warnings = changed_volumes(result, map);
    ASSERT_EQ(warnings.size(), voxels == 71 || voxels == 201 ? 1U : 0U) << voxels;
    if (voxels == 201) {
      EXPECT_EQ(warnings[0],
                "labels: the surface of 'hip' holds 0.12 cm^3, the voxels of its label 0.201 cm^3");
    }
  }
}

}  // namespace
}  // namespace mesamis
