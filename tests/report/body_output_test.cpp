// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/body_output.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesamis/base/error.h"
#include "mesamis/body/rim.h"
#include "support/solids.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

constexpr double kRadius = 8;

/// A scan of 24 mm whose grey value rises along the grid's first axis: 100 at 0, 10 per mm.
Volume ramp(const Mat3& direction = {}) {
  Volume volume;
  volume.size = {25, 25, 25};
  volume.direction = direction;
  volume.origin = {3, -5, 7};
  for (std::size_t n = 0; n < volume.voxel_count(); ++n) {
    volume.samples.push_back(100 + 10 * static_cast<float>(volume.voxel(n)[0]));
  }
  return volume;
}

/// A ball in the scan's middle, turned outward in the world.
TriMesh ball_in(const Volume& volume) {
  TriMesh surface = ball_surface(kRadius, 48);
  const bool mirrors = determinant(volume.direction) < 0;
  for (Vec3& p : surface.points) p = volume.to_world(p + Vec3{12, 12, 12});
  if (mirrors) {
    for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
  }
  return surface;
}

const Mat3 kTurned{{Vec3{0.8, -0.6, 0}, Vec3{0.6, 0.8, 0}, Vec3{0, 0, 1}}};
const Mat3 kMirrored{{Vec3{0.8, -0.6, 0}, Vec3{0.6, 0.8, 0}, Vec3{0, 0, -1}}};

BodyRequest of_size(double size) {
  BodyRequest request;
  request.elements.element_size = size;
  request.elements.tolerance = 0.2;
  return request;
}

BodyOutput body_of(const Volume& volume, const BodyRequest& request) {
  const TriMesh surface = ball_in(volume);
  const FoundObject object{surface, {"left femur (2)", 5, 0, {}}};
  return make_body_output({&object, 1}, volume, request);
}

double volume_of(const FiniteElements& elements) {
  const TetMesh mesh{elements.points, elements.cells};
  double sum = 0;
  for (Index c = 0; c < std::ssize(mesh.cells); ++c) sum += cell_volume(mesh, c);
  return sum;
}

TEST(BodyOutput, FillsTheBallInAnyGrid) {
  const double exact = 4.0 / 3 * std::numbers::pi * kRadius * kRadius * kRadius;
  for (const Mat3& direction : {Mat3{}, kTurned, kMirrored}) {
    const Volume volume = ramp(direction);
    const BodyOutput body = body_of(volume, of_size(3));
    EXPECT_NEAR(volume_of(body.elements), exact, 0.03 * exact);
    for (const Vec3& p : body.elements.points) {
      EXPECT_LT(norm(volume.to_grid(p) - Vec3{12, 12, 12}), kRadius + 0.2);
    }
    EXPECT_EQ(body.facts.quality.elements, std::ssize(body.elements.cells));
    EXPECT_EQ(body.facts.parts, 1);
  }
}

/// Each mid-side node lies nearest to the middle of its own edge.
TEST(BodyOutput, MidSideNodesBelongToTheirEdges) {
  for (const Mat3& direction : {kTurned, kMirrored}) {
    BodyRequest request = of_size(3);
    request.elements.quadratic = true;
    const FiniteElements elements = body_of(ramp(direction), request).elements;
    ASSERT_EQ(elements.mid_nodes.size(), elements.cells.size());
    for (std::size_t c = 0; c < elements.cells.size(); ++c) {
      for (std::size_t e = 0; e < 6; ++e) {
        const auto at = [&](int i) {
          return elements.points[elements.cells[c][static_cast<std::size_t>(i)]];
        };
        const Vec3 a = at(kMidNodeEdges[e][0]), b = at(kMidNodeEdges[e][1]);
        const Vec3 node = elements.points[elements.mid_nodes[c][e]];
        ASSERT_LT(norm(node - 0.5 * (a + b)), 0.2 * norm(b - a));
      }
    }
  }
}

/// The scan of a ball of 1 g/cm^3 that is blurred: its rim is dim, unless it is filled.
TEST(BodyOutput, MaterialsAtTheRimAreThoseBelow) {
  Volume volume = ramp();
  for (std::size_t n = 0; n < volume.voxel_count(); ++n) {
    const auto [i, j, k] = volume.voxel(n);
    const double depth = kRadius - norm(Vec3(i, j, k) - Vec3{12, 12, 12});
    volume.samples[n] = static_cast<float>(500 * std::erfc(-depth / (0.7 * std::numbers::sqrt2)));
  }
  BodyRequest request = of_size(3);
  request.material.emplace();
  request.material->law = parse_material_law("E=1000*rho_qct^1");
  request.material->calibration = parse_calibration("0,0.001");
  request.material->gap = 0;
  const auto least = [&] {
    double modulus = 1e9;
    for (const auto& bin : body_of(volume, request).elements.materials) {
      modulus = std::min(modulus, bin.modulus);
    }
    return modulus;
  };
  EXPECT_LT(least(), 900);
  request.rim = rim_depth(volume, {0.7, 0.7, 0.7});
  EXPECT_GT(least(), 975);  // at this depth 2.3 % are left of the surroundings
}

TEST(BodyOutput, PartsHaveNamesForSolvers) {
  const BodyOutput body = body_of(ramp(), of_size(4));
  ASSERT_EQ(body.elements.parts.size(), 1U);
  EXPECT_EQ(body.elements.parts[0].name, "PART_1_left_femur__2_");
  EXPECT_EQ(body.elements.parts[0].note, "left femur (2)");
  EXPECT_EQ(std::count(body.elements.part_of_cell.begin(), body.elements.part_of_cell.end(), 0),
            std::ssize(body.elements.cells));
}

TEST(BodyOutput, SetsLieInTheWorld) {
  const Volume volume = ramp(kMirrored);
  BodyRequest request = of_size(3);
  request.sets = {parse_face_query("up=top:z,3"), parse_face_query("down=bottom:z,3")};
  const FiniteElements elements = body_of(volume, request).elements;
  const double middle = volume.to_world({12, 12, 12}).z;
  ASSERT_EQ(elements.sets.size(), 2U);
  for (const Index node : elements.sets[0].nodes) EXPECT_GT(elements.points[node].z, middle + 4);
  for (const Index node : elements.sets[1].nodes) EXPECT_LT(elements.points[node].z, middle - 4);
  for (const auto& [cell, face] : elements.sets[0].faces) {
    for (const Index node : face_nodes(elements, cell, face)) {
      if (node == kNoIndex) continue;
      EXPECT_TRUE(
          std::binary_search(elements.sets[0].nodes.begin(), elements.sets[0].nodes.end(), node));
    }
  }
}

TEST(BodyOutput, MaterialsFollowTheScan) {
  BodyRequest request = of_size(3);
  request.material = MaterialOptions{};
  request.material->law = parse_material_law("E=1000*rho_qct^1");
  request.material->calibration = parse_calibration("0,0.001");
  request.material->gap = 5;
  const BodyOutput body = body_of(ramp(kTurned), request);
  const FiniteElements& elements = body.elements;
  const Volume volume = ramp(kTurned);
  ASSERT_EQ(elements.material_of_cell.size(), elements.cells.size());
  for (std::size_t c = 0; c < elements.cells.size(); ++c) {
    Vec3 sum;
    for (const Index p : elements.cells[c]) sum += elements.points[p];
    const double expected = 100 + 10 * volume.to_grid(0.25 * sum).x;  // linear: exact at centroids
    const double modulus = elements.materials[elements.material_of_cell[c]].modulus;
    EXPECT_GE(modulus, expected - 0.1);
    EXPECT_LE(modulus, expected + 5.1);
  }
  ASSERT_TRUE(body.material);
  EXPECT_EQ(body.material->share_below_min, 0);
}

TEST(BodyOutput, AnObjectThatTheScanCutsOffEndsInAFlatFace) {
  const Volume volume = ramp(kTurned);
  TriMesh surface = ball_above(-3, kRadius, 48);  // the part of a ball above z = -3
  double lowest = 0;
  for (const Vec3& p : surface.points) lowest = std::min(lowest, p.z);
  for (Vec3& p : surface.points) p = volume.to_world(p + Vec3{12, 12, -lowest});
  const FoundObject object{surface, {"half", 1, 0, {}}};
  const BodyOutput body = make_body_output({&object, 1}, volume, of_size(3));
  std::size_t in_plane = 0;
  for (const Vec3& p : body.elements.points) {
    const double z = volume.to_grid(p).z;
    EXPECT_GT(z, -1e-9);
    in_plane += std::abs(z) < 1e-9;
  }
  EXPECT_GT(in_plane, 20U);
}

/// Surfaces come in single precision, which the border of a scan need not be.
TEST(BodyOutput, AFlatEndSurvivesSinglePrecision) {
  Volume volume = ramp();
  const double scale = 0.0195;
  volume.spacing = {scale, scale, scale};
  TriMesh surface = ball_above(-3, kRadius, 48);
  double lowest = 0;
  for (const Vec3& p : surface.points) lowest = std::min(lowest, p.z);
  for (Vec3& p : surface.points) {  // hangs from the highest layer
    p = volume.to_world(scale * Vec3{12 + p.x, 12 - p.y, 24 + lowest - p.z});
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(p[axis]);
  }
  const FoundObject object{surface, {"half", 1, 0, {}}};
  BodyRequest request = of_size(3 * scale);
  request.elements.tolerance *= scale;
  const FiniteElements elements = make_body_output({&object, 1}, volume, request).elements;
  std::size_t in_plane = 0;
  for (const Vec3& p : elements.points) {
    const double below = 24 * scale - volume.to_grid(p).z;
    EXPECT_GT(below, -1e-12);
    in_plane += std::abs(below) < 1e-12;
  }
  EXPECT_GT(in_plane, 20U);
}

TEST(BodyOutput, TellsWhatIsMissing) {
  BodyRequest request = of_size(3);
  request.sets = {parse_face_query("up=top:z,3"), parse_face_query("hole=inner")};
  BodyOutput body = body_of(ramp(), request);
  EXPECT_EQ(unmet(body), "set 'hole' has no face, it is left out");
  EXPECT_EQ(body.elements.sets.size(), 1U);
  body.facts.quality.least_angle = 5;
  body.facts.fit.surface_to_skin = 0.5;
  EXPECT_THAT(
      unmet(body),
      testing::StartsWith(
          "expected dihedral angles of at least 10.7, found 5; expected a "
          "distance to the surface, mm, of at most 0.2, found 0.5, with elements down to 0.75 mm; "
          "set"));
  body.tolerance = 0.1 + 0.2;
  body.facts.fit.surface_to_skin = 0.5123456789;
  EXPECT_THAT(unmet(body),
              testing::HasSubstr("at most 0.3, found 0.5123, with elements down to 0.75 mm; set"));
  body.facts.parts_dropped = 1;
  EXPECT_THAT(unmet(body), testing::HasSubstr("found 0.5123, with 1 part of the objects that was "
                                              "dropped and elements down to 0.75 mm; set"));
  body.facts.parts_dropped = 2;
  EXPECT_THAT(unmet(body),
              testing::HasSubstr("with 2 parts of the objects that were dropped and "));
  body.facts.quality.least_angle = 10.6999996;
  EXPECT_THAT(unmet(body), testing::HasSubstr("at least 10.7, found 10.6999996; "));
  request.sets.clear();
  EXPECT_EQ(unmet(body_of(ramp(), request)), "");
}

TEST(BodyOutput, NamesOfSetsDiffer) {
  BodyRequest request = of_size(3);
  request.sets = {parse_face_query("a=top:z,3"), parse_face_query("a=bottom:z,3")};
  EXPECT_REFUSED(body_of(ramp(), request), HasSubstr("'a' twice"));
  request.sets[1].name = "A";
  EXPECT_REFUSED(body_of(ramp(), request), HasSubstr("'A' beside 'a'"));
  request.sets[1].name = "part_1_left_femur__2_";
  EXPECT_REFUSED(body_of(ramp(), request), HasSubstr("parts and materials"));
  request.sets[1].name = "PARTS";
  EXPECT_NO_THROW(require_set_names(request.sets));
}

}  // namespace
}  // namespace mesamis
