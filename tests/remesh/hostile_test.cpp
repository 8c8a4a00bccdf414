// SPDX-License-Identifier: Apache-2.0
// Whatever the metric, the mesh stays valid and the work ends.
#include <gtest/gtest.h>

#include <random>

#include "mesamis/base/sym3.h"
#include "mesamis/remesh/remesh.h"
#include "support/metric_fields.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

void expect_valid(const TetMesh& start, const MetricField& metric, RemeshOptions options = {}) {
  options.max_cells = options.max_cells > 0 ? options.max_cells : 2000;
  const Box box = bounding_box(start.points);
  const TetMesh mesh = remesh(start, metric, options);
  EXPECT_EQ(find_flaw(mesh, box), "");
  EXPECT_LT(std::ssize(mesh.cells), 3 * options.max_cells);
}

/// Sizes from `smallest` to 1000 times as much, in directions of their own, at every node.
std::vector<Sym3> random_metrics(std::size_t nodes, double smallest, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1), power(0, 3);
  std::vector<Sym3> metrics;
  while (metrics.size() < nodes) {
    const SymEigen frame =
        eigen_decompose({uniform(generator), uniform(generator), uniform(generator),
                         uniform(generator), uniform(generator), uniform(generator)});
    std::array<double, 3> values{};
    for (double& value : values) value = std::pow(smallest * std::pow(10, power(generator)), -2);
    metrics.push_back(compose(values, frame.vectors));
  }
  return metrics;
}

TEST(Hostile, WhiteNoiseMetricsWithAspectsTo1000) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const TetMesh background = perturbed_box(kUnitBox, {4, 4, 4}, 0.2, seed);
    const MeshMetricField metric(background, random_metrics(background.points.size(), 0.003, seed));
    expect_valid(background, metric);
    expect_valid(box_mesh(kUnitBox, {1, 1, 1}), metric);
  }
}

TEST(Hostile, NoiseWithoutAnyContinuity) {
  auto size = [](const Vec3& p, double salt) {
    const double x = 1e4 * std::sin(12.9898e3 * p.x + 78.233e3 * p.y + 37.719e3 * p.z + salt);
    return 0.01 + 0.99 * (x - std::floor(x));
  };
  const FormulaMetric metric([size](const Vec3& p) {
    const double a = size(p, 1), b = size(p, 2), c = size(p, 3);
    return Sym3{1 / (a * a), 0, 0, 1 / (b * b), 0, 1 / (c * c)};
  });
  expect_valid(box_mesh(kUnitBox, {3, 3, 3}), metric);
}

TEST(Hostile, SizeJumpsOfAHundred) {
  const FormulaMetric metric([](const Vec3& p) {
    const double h = p.x + 0.3 * p.y < 0.6 ? 0.02 : 2;
    return 1 / (h * h) * kIdentity3;
  });
  expect_valid(box_mesh(kUnitBox, {2, 2, 2}), metric);
}

TEST(Hostile, SizesFarLargerThanTheBox) {
  for (const double size : {10.0, 1e6, 1e200}) {
    const FormulaMetric metric = uniform_metric(size);
    const TetMesh mesh = remesh(perturbed_box(kUnitBox, {5, 5, 5}, 0.2), metric);
    EXPECT_EQ(find_flaw(mesh, kUnitBox), "");
    EXPECT_LT(mesh.cells.size(), 60u);
  }
}

TEST(Hostile, SizesAtRoundOff) {
  const FormulaMetric everywhere = uniform_metric(1e-15);
  expect_valid(box_mesh(kUnitBox, {2, 2, 2}), everywhere);
  const FormulaMetric at_one_plane([](const Vec3& p) {
    const double h = std::abs(p.x - 0.5) < 1e-3 ? 1e-15 : 0.3;
    return Sym3{1 / (h * h), 0, 0, 10, 0, 10};
  });
  expect_valid(box_mesh(kUnitBox, {2, 2, 2}), at_one_plane);
  const FormulaMetric point_like([](const Vec3& p) {
    const double h = std::max(1e-17, 0.5 * norm(p - Vec3{0.5, 0.5, 0.5}));
    return 1 / (h * h) * kIdentity3;
  });
  expect_valid(box_mesh(kUnitBox, {2, 2, 2}), point_like);
}

TEST(Hostile, BoxesOfOneToAThousand) {
  for (const Vec3 hi : {Vec3{1000, 1, 1}, Vec3{1, 1000, 1000}, Vec3{1e-6, 1e-3, 1e-4}}) {
    const Box box{{0, 0, 0}, hi};
    const double h = std::cbrt(box.volume() / 300);
    expect_valid(box_mesh(box, {2, 2, 2}), uniform_metric(h));
    expect_valid(box_mesh({{-hi.x, 5, 7}, {hi.x, 5 + hi.y, 7 + hi.z}}, {1, 1, 1}),
                 uniform_metric(h));
  }
}

TEST(Hostile, BoxFarFromTheOrigin) {
  const Box box{{1e6, -1e6, 1e6}, {1e6 + 1, -1e6 + 1, 1e6 + 1}};
  expect_valid(box_mesh(box, {2, 2, 2}), uniform_metric(0.15));
}

TEST(Hostile, MetricsThatAreNoneDoNoHarm) {
  for (const double bad :
       {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY), 1e300}) {
    const FormulaMetric metric(
        [bad](const Vec3& p) { return p.x < 0.5 ? bad * kIdentity3 : Sym3{25, 0, 0, 25, 0, 25}; });
    expect_valid(box_mesh(kUnitBox, {3, 3, 3}), metric);
  }
}

TEST(Hostile, StretchedStartMeshes) {
  // Slivers of 1:1000 on the start, an isotropic metric.
  expect_valid(perturbed_box(kUnitBox, {1, 1, 200}, 0.3), uniform_metric(0.2));
  expect_valid(perturbed_box(kUnitBox, {40, 1, 2}, 0.3), uniform_metric(0.2));
}

TEST(Hostile, TinyPartsAndOneRound) {
  RemeshOptions options;
  options.part_cells = 1;
  options.max_rounds = 3;
  expect_valid(box_mesh(kUnitBox, {8, 8, 8}), ugawg_metric(Ugawg::kPolar1, 0.8), options);
  options.max_rounds = 0;
  options.polish_rounds = 0;
  const TetMesh start = box_mesh(kUnitBox, {2, 2, 2});
  EXPECT_EQ(remesh(start, uniform_metric(1), options).cells.size(), start.cells.size());
}

}  // namespace
}  // namespace mesamis
