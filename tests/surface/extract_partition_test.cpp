// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/extract.h"
#include "mesamis/surface/partition.h"
#include "support/partition_laws.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

constexpr Box kUnit{{0, 0, 0}, {1, 1, 1}};

using Fields = std::vector<std::vector<double>>;
using Function = std::function<double(const Vec3&)>;

Fields sampled(const TetMesh& mesh, const std::vector<Function>& functions) {
  Fields fields;
  for (const Function& f : functions) {
    fields.emplace_back();
    for (const Vec3& p : mesh.points) fields.back().push_back(f(p));
  }
  return fields;
}

/// Values of a generator at each node, for each material.
template <class Distribution>
Fields random_fields(const TetMesh& mesh, std::size_t materials, Distribution values,
                     unsigned seed) {
  std::mt19937 generator(seed);
  Fields fields(materials, std::vector<double>(mesh.points.size()));
  for (auto& field : fields) {
    for (double& value : field) value = values(generator);
  }
  return fields;
}

double volume_of(const PartitionSurface& partition, Index material) {
  return check_surface(object_surface(partition, material)).volume;
}

TEST(ExtractPartition, KeepsItsLawsForRandomMemberships) {
  const Box box{{-3, 2, 0}, {5, 3, 9}};
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TetMesh mesh = perturbed_box(box, {5, 4, 6}, 0.2, seed);
    const auto fields =
        random_fields(mesh, 2 + seed % 6, std::uniform_real_distribution<double>(-1, 1), seed);
    expect_partition_laws(extract_partition(mesh, fields), box.volume(),
                          "seed " + std::to_string(seed));
  }
}

TEST(ExtractPartition, KeepsItsLawsForManyTies) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TetMesh mesh = box_mesh(kUnit, {4, 4, 4});
    std::uniform_int_distribution<int> few(0, 1 + static_cast<int>(seed % 3));
    const auto fields = random_fields(mesh, 3 + seed % 4, few, seed);
    expect_partition_laws(extract_partition(mesh, fields), 1, "seed " + std::to_string(seed));
  }
}

TEST(ExtractPartition, KeepsItsLawsForAllMaterialsOfACell) {
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  for (unsigned code = 0; code < 256; ++code) {
    Fields fields(4, std::vector<double>(4, 0));
    for (unsigned i = 0; i < 4; ++i) fields[code >> (2 * i) & 3][i] = 1;
    const PartitionSurface open = extract_partition(mesh, fields, {.close_at_box = false});
    for (std::size_t t = 0; t < open.triangles.size(); ++t) {
      // The first material's corners lie behind each triangle, the second's before it.
      const auto& [a, b, c] = open.triangles[t];
      const auto [behind, before] = open.sides[t];
      EXPECT_LT(behind, before);
      for (unsigned i = 0; i < 4; ++i) {
        const auto material = static_cast<Index>(code >> (2 * i) & 3);
        const double side = (material == before) - (material == behind);
        EXPECT_GT(side * six_volume(open.points[a], open.points[b], open.points[c], mesh.points[i]),
                  -1e-15)
            << code;
      }
    }
  }
}

TEST(ExtractPartition, IsTheSolidWhereThereAreTwoMaterials) {
  const TetMesh mesh = perturbed_box(kUnit, {6, 5, 4}, 0.2);
  const auto fields = random_fields(mesh, 2, std::uniform_real_distribution<double>(-1, 1), 3);
  std::vector<double> u;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) u.push_back(fields[1][n] - fields[0][n]);
  const TriMesh solid = extract_solid(mesh, u, 0);
  const TriMesh object = object_surface(extract_partition(mesh, fields), 1);
  ASSERT_EQ(object.points.size(), solid.points.size());
  EXPECT_EQ(object.triangles.size(), solid.triangles.size());
  for (std::size_t i = 0; i < solid.points.size(); ++i) {
    EXPECT_LT(norm(object.points[i] - solid.points[i]), 1e-13);
  }
  EXPECT_NEAR(check_surface(object).volume, check_surface(solid).volume, 1e-13);
}

TEST(ExtractPartition, SlabsAreExact) {
  const TetMesh mesh = box_mesh(kUnit, {4, 4, 4});
  const auto fields =
      sampled(mesh, {[](const Vec3& p) { return 9 * (0.31 - p.z); }, [](const Vec3&) { return 0; },
                     [](const Vec3& p) { return p.z - 0.64; }});
  const PartitionSurface partition = extract_partition(mesh, fields);
  expect_partition_laws(partition, 1, "slabs");
  EXPECT_EQ(materials_of(partition), (std::vector<Index>{0, 1, 2}));
  EXPECT_NEAR(volume_of(partition, 0), 0.31, 1e-14);
  EXPECT_NEAR(volume_of(partition, 1), 0.33, 1e-14);
  EXPECT_NEAR(volume_of(partition, 2), 0.36, 1e-14);
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    const auto [behind, before] = partition.sides[t];
    if (before == kNoIndex) continue;
    EXPECT_EQ(before, behind + 1);
    for (const Index p : partition.triangles[t]) {
      EXPECT_NEAR(partition.points[static_cast<std::size_t>(p)].z, behind == 0 ? 0.31 : 0.64,
                  1e-15);
    }
  }
}

struct Sharing {
  double distance = 0, volume = 0;  // worst
};

/// Two balls cut by the plane between them, in a box.
Sharing touching_balls(Index n) {
  const Vec3 a{-0.31, 0.01, 0.02}, b{0.33, -0.01, 0.03};
  const double radius = 0.45;
  const TetMesh mesh = box_mesh({{-1, -1, -1}, {1, 1, 1}}, {n, n, n});
  const auto fields = sampled(
      mesh, {[](const Vec3&) { return 0; }, [&](const Vec3& p) { return radius - norm(p - a); },
             [&](const Vec3& p) { return radius - norm(p - b); }});
  const PartitionSurface partition = extract_partition(mesh, fields);
  expect_partition_laws(partition, 8, "balls");
  Sharing worst;
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    const auto [behind, before] = partition.sides[t];
    if (before == kNoIndex) continue;
    for (const Index p : partition.triangles[t]) {
      const Vec3& x = partition.points[static_cast<std::size_t>(p)];
      const double at_a = radius - norm(x - a), at_b = radius - norm(x - b);
      const double off = behind == 1 ? at_a - at_b : before == 1 ? at_a : at_b;
      worst.distance = std::max(worst.distance, std::abs(off));
    }
  }
  const double height = radius - norm(b - a) / 2, pi = std::acos(-1.0);
  const double cap = pi * height * height * (3 * radius - height) / 3;
  const double exact = 4 * pi / 3 * radius * radius * radius - cap;
  for (const Index k : {1, 2}) {
    worst.volume = std::max(worst.volume, std::abs(volume_of(partition, k) - exact));
  }
  return worst;
}

TEST(ExtractPartition, TouchingBallsConverge) {
  const Sharing coarse = touching_balls(16), fine = touching_balls(32);
  EXPECT_LT(fine.distance, 0.7 * coarse.distance);  // first order, at the ring where three meet
  EXPECT_LT(fine.volume, 0.35 * coarse.volume);
  EXPECT_LT(fine.distance, 0.03);
}

TEST(ExtractPartition, ABoxOfOneMaterialIsTheBox) {
  const TetMesh mesh = box_mesh(kUnit, {2, 3, 2});
  const Fields fields(3, std::vector<double>(mesh.points.size(), 7));
  const PartitionSurface partition = extract_partition(mesh, fields);
  EXPECT_EQ(materials_of(partition), std::vector<Index>{0});  // ties by index
  EXPECT_NEAR(volume_of(partition, 0), 1, 1e-14);
  EXPECT_TRUE(object_surface(partition, 1).triangles.empty());
  EXPECT_TRUE(extract_partition(mesh, fields, {.close_at_box = false}).triangles.empty());
}

TEST(ExtractPartition, ObjectsTogetherAreTheObjectsAlone) {
  const TetMesh mesh = box_mesh(kUnit, {4, 4, 4});
  const PartitionSurface partition =
      extract_partition(mesh, random_fields(mesh, 4, std::uniform_int_distribution<int>(-1, 1), 3));
  const std::vector<Index> materials{2, 9, 0, 3};
  const std::vector<TriMesh> together = object_surfaces(partition, materials);
  ASSERT_EQ(together.size(), materials.size());
  EXPECT_TRUE(together[1].points.empty());
  double volume = 0;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const TriMesh alone = object_surface(partition, materials[m]);
    EXPECT_EQ(together[m].points, alone.points);
    EXPECT_EQ(together[m].triangles, alone.triangles);
    EXPECT_EQ(flaws_of(check_surface(together[m])), "");
    volume += check_surface(together[m]).volume;
  }
  EXPECT_NEAR(volume, 1 - volume_of(partition, 1), 1e-12);
}

TEST(ExtractPartition, OneNodeIsABallAroundIt) {
  const TetMesh mesh = box_mesh(kUnit, {2, 2, 2});
  for (std::size_t node = 0; node < mesh.points.size(); ++node) {
    for (const double value : {1e-300, 1.0, 1e300}) {
      Fields fields(2, std::vector<double>(mesh.points.size(), 0));
      fields[1][node] = value;
      const PartitionSurface partition = extract_partition(mesh, fields);
      expect_partition_laws(partition, 1, "node " + std::to_string(node));
      EXPECT_EQ(check_surface(object_surface(partition, 1)).components, 1);
    }
  }
}

TEST(ExtractPartition, TakesValuesOfAnySize) {
  const TetMesh mesh = box_mesh(kUnit, {3, 3, 3});
  for (const double size :
       {std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min(), 1e-200}) {
    auto fields = random_fields(mesh, 5, std::uniform_int_distribution<int>(-1, 1), 8);
    for (auto& field : fields) {
      for (double& value : field) value *= size;
    }
    expect_partition_laws(extract_partition(mesh, fields), 1, std::to_string(size));
  }
}

TEST(ExtractPartition, HasTheSameBytesForAnyNumberOfThreads) {
  const TetMesh mesh = perturbed_box(kUnit, {12, 12, 12}, 0.2);
  const auto fields = random_fields(mesh, 4, std::uniform_real_distribution<double>(0, 1), 5);
  const auto one = with_threads(1, [&] { return extract_partition(mesh, fields); });
  const auto three = with_threads(3, [&] { return extract_partition(mesh, fields); });
  EXPECT_EQ(one.points, three.points);
  EXPECT_EQ(one.triangles, three.triangles);
  EXPECT_EQ(one.sides, three.sides);
}

TEST(ExtractPartition, RefusesMembershipsThatDoNotFit) {
  const TetMesh mesh = box_mesh(kUnit, {1, 1, 1});
  Fields fields(2, std::vector<double>(8, 1));
  EXPECT_THROW(extract_partition(mesh, Fields{}), InputError);
  fields[1].pop_back();
  EXPECT_THROW(extract_partition(mesh, fields), InputError);
  fields[1].push_back(std::nan(""));
  EXPECT_THROW(extract_partition(mesh, fields), InputError);
}

}  // namespace
}  // namespace mesamis
