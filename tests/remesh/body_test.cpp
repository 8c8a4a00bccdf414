// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/body.h"

#include <gtest/gtest.h>

#include <bitset>
#include <cmath>
#include <numbers>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/region.h"
#include "support/body_shapes.h"
#include "support/metric_fields.h"
#include "support/perturbed_box.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

const FormulaMetric kMetric = uniform_metric(0.12);
const RoundShape kBall({0.5, 0.5, 0.5}, 0.4);
TetMesh start() { return perturbed_box(kUnitBox, {8, 8, 8}, 0.2); }

/// The cells of one material; of all for 0.
TetMesh part_of(const BodyMesh& body, Material material) {
  TetMesh part{body.mesh.points, {}};
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c) {
    if (material == kOutside || body.materials[c] == material)
      part.cells.push_back(body.mesh.cells[c]);
  }
  return part;
}

void expect_sound_body(const BodyMesh& body) {
  ASSERT_EQ(body.materials.size(), body.mesh.cells.size());
  for (Index c = 0; c < std::ssize(body.mesh.cells); ++c) {
    ASSERT_GT(cell_volume(body.mesh, c), 0);
    ASSERT_NE(body.materials[c], kOutside);
  }
}

/// Points of faces between a material and another, or the outside, that are not on the box.
void expect_skin_near(const BodyMesh& body, const FormulaShape& shape, double tolerance) {
  const auto neighbors = cell_neighbors(body.mesh);
  int faces = 0;
  for (std::size_t c = 0; c < neighbors.size(); ++c) {
    for (std::size_t f = 0; f < 4; ++f) {
      const Index n = neighbors[c][f];
      if (n != kNoIndex && body.materials[n] == body.materials[c]) continue;
      unsigned planes = 0x3f;
      Vec3 middle;
      for (const int i : kCellFaces[f]) {
        const Vec3& p = body.mesh.points[body.mesh.cells[c][i]];
        planes &= planes_of(kUnitBox, p);
        middle += 1.0 / 3 * p;
      }
      if (n == kNoIndex && planes != 0) continue;
      ++faces;
      for (const int i : kCellFaces[f]) {
        EXPECT_LE(std::abs(shape.distance(body.mesh.points[body.mesh.cells[c][i]])), tolerance);
      }
      EXPECT_LE(std::abs(shape.distance(middle)), tolerance);
    }
  }
  EXPECT_GT(faces, 20);
}

TEST(RemeshBody, ABallIsFilled) {
  const BodyMesh body = remesh_body(start(), kMetric, kBall);
  expect_sound_body(body);
  EXPECT_EQ(boundary_flaws(body.mesh), "");
  expect_skin_near(body, kBall, FormulaShape::kTolerance);
  const double volume = 4.0 / 3 * std::numbers::pi * 0.064;
  EXPECT_NEAR(mesh_volume(body.mesh), volume, 0.05 * volume);
  EXPECT_TRUE(body.report.converged);
}

/// A plane that cuts the box askew: its skin is exactly flat, and the rest is the box's.
TEST(RemeshBody, APlanesSkinIsFlat) {
  const PlaneShape plane({1, 2, 3}, 0.8, 1, kOutside);
  const BodyMesh body = remesh_body(start(), kMetric, plane);
  expect_sound_body(body);
  EXPECT_EQ(boundary_flaws(body.mesh), "");
  expect_skin_near(body, plane, FormulaShape::kTolerance);
  for (const Vec3& p : body.mesh.points) EXPECT_TRUE(kUnitBox.contains(p));
}

TEST(RemeshBody, TwoMaterialsFillTheBoxAndShareTheirSkin) {
  const RoundShape ball({0.5, 0.5, 0.5}, 0.35, 1, 2);
  const BodyMesh body = remesh_body(start(), kMetric, ball);
  expect_sound_body(body);
  EXPECT_EQ(find_flaw(body.mesh, kUnitBox), "");
  EXPECT_EQ(boundary_flaws(part_of(body, 1)), "");
  EXPECT_EQ(boundary_flaws(part_of(body, 2)), "");
  expect_skin_near(body, ball, FormulaShape::kTolerance);
}

/// Below a height there is 1; above it 2 on the left of a plane, and 3 on its right.
class ThreeRooms : public BodyShape {
 public:
  static constexpr double kHeight = 0.47, kWall = 0.53;
  Material material_at(const Vec3& p) const override {
    if (p.z < kHeight) return 1;
    return p.x < kWall ? 2 : 3;
  }
  double crossing(const Vec3& a, const Vec3& b) const override {
    const bool floor = material_at(a) == 1 || material_at(b) == 1;
    return floor ? (kHeight - a.z) / (b.z - a.z) : (kWall - a.x) / (b.x - a.x);
  }
  std::optional<double> hidden_crossing(const Vec3&, const Vec3&) const override {
    return std::nullopt;
  }
  BorderPoint nearest_border(const Vec3& p) const override {
    const Vec3 wall{kWall, p.y, std::max(p.z, kHeight)}, floor{p.x, p.y, kHeight};
    return {norm(wall - p) < norm(floor - p) ? wall : floor, FormulaShape::kTolerance};
  }
  std::optional<JunctionPoint> nearest_junction(const Vec3& p,
                                                const MaterialTriple& materials) const override {
    if (materials != MaterialTriple{1, 2, 3}) return std::nullopt;
    return JunctionPoint{{kWall, p.y, kHeight}, {0, 1, 0}};
  }
};

TEST(RemeshBody, ThreeMaterialsMeetInTheirLine) {
  const BodyMesh body = remesh_body(start(), kMetric, ThreeRooms());
  expect_sound_body(body);
  std::vector<std::bitset<4>> met(body.mesh.points.size());
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c) {
    for (const Index p : body.mesh.cells[c]) met[p].set(body.materials[c]);
  }
  int on_line = 0;
  for (std::size_t p = 0; p < met.size(); ++p) {
    if (met[p].count() < 3) continue;
    ++on_line;
    EXPECT_NEAR(body.mesh.points[p].x, ThreeRooms::kWall, 0.1 * FormulaShape::kTolerance);
    EXPECT_NEAR(body.mesh.points[p].z, ThreeRooms::kHeight, 0.1 * FormulaShape::kTolerance);
  }
  EXPECT_GE(on_line, 6);  // edges of 0.12
  EXPECT_NEAR(mesh_volume(part_of(body, 2)), ThreeRooms::kWall * (1 - ThreeRooms::kHeight), 1e-3);
  EXPECT_NEAR(mesh_volume(part_of(body, 1)), ThreeRooms::kHeight, 1e-3);
}

TEST(RemeshBody, IsTheSameForAnyNumberOfThreads) {
  RemeshOptions options;
  options.part_cells = 1000;
  const FormulaMetric fine = uniform_metric(0.07);
  const TetMesh begin = box_mesh(kUnitBox, {12, 12, 12});
  auto make = [&] { return remesh_body(begin, fine, kBall, options); };
  const BodyMesh once = with_threads(1, make);
  EXPECT_FALSE(once.report.part_seconds.empty()) << "there was only one part";
  expect_sound_body(once);
  EXPECT_EQ(boundary_flaws(once.mesh), "");
  expect_skin_near(once, kBall, FormulaShape::kTolerance);
  for (const int threads : {2, 4}) {
    const BodyMesh again = with_threads(threads, make);
    EXPECT_EQ(mesh_hash(again.mesh), mesh_hash(once.mesh)) << threads;
    EXPECT_EQ(again.materials, once.materials);
  }
}

TEST(RemeshBody, RefusesWhatIsNoMeshOfABoxOrHoldsNothing) {
  TetMesh broken = start();
  broken.cells.pop_back();
  EXPECT_REFUSED(remesh_body(broken, kMetric, kBall), HasSubstr("the start mesh is not valid"));
  const RoundShape elsewhere({5, 5, 5}, 1);
  EXPECT_REFUSED(remesh_body(start(), kMetric, elsewhere),
                 HasSubstr("expected an object that fills at least one element"));
}

TEST(RemeshBody, ProgressStopsIt) {
  RemeshOptions options;
  options.progress = [](std::string_view, double) { return false; };
  EXPECT_THROW(remesh_body(start(), kMetric, kBall, options), Cancelled);
}

}  // namespace
}  // namespace mesamis
