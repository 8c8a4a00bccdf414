// SPDX-License-Identifier: Apache-2.0
// Whatever the metric, the mesh stays valid and the work ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "mesamis/base/parallel.h"
#include "mesamis/base/sym3.h"
#include "mesamis/remesh/remesh.h"
#include "support/metric_fields.h"
#include "support/perturbed_box.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void expect_box_kept(const TetMesh& mesh, const Box& box) {
  EXPECT_EQ(find_flaw(mesh, box), "");
  EXPECT_EQ(bounding_box(mesh.points), box);
  const TetMesh corners = box_mesh(box, {1, 1, 1});
  for (const Vec3& p : corners.points) {
    EXPECT_NE(std::find(mesh.points.begin(), mesh.points.end(), p), mesh.points.end());
  }
}

void expect_valid(const TetMesh& start, const MetricField& metric, RemeshOptions options = {}) {
  options.max_cells = options.max_cells > 0 ? options.max_cells : 2000;
  const Box box = bounding_box(start.points);
  const TetMesh mesh = remesh(start, metric, options);
  expect_box_kept(mesh, box);
  EXPECT_LT(std::ssize(mesh.cells), 3 * options.max_cells);
}

/// As valid, and the same, whether one thread works on many small parts or four do.
void expect_valid_for_any_threads(const TetMesh& start, const MetricField& metric) {
  RemeshOptions options;
  options.max_cells = 5000;
  options.part_cells = 1000;
  options.max_rounds = 12;
  const Box box = bounding_box(start.points);
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 4}) {
    const TetMesh mesh = with_threads(threads, [&] { return remesh(start, metric, options); });
    expect_box_kept(mesh, box);
    EXPECT_GT(std::ssize(mesh.cells), 2 * options.part_cells);
    EXPECT_LT(std::ssize(mesh.cells), 3 * options.max_cells);
    hashes.push_back(mesh_hash(mesh));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

std::array<Vec3, 3> random_frame(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return eigen_decompose({uniform(generator), uniform(generator), uniform(generator),
                          uniform(generator), uniform(generator), uniform(generator)})
      .vectors;
}

/// Sizes from `smallest` to 1000 times as much, in directions of their own, at every node.
std::vector<Sym3> random_metrics(std::size_t nodes, double smallest, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> power(0, 3);
  std::vector<Sym3> metrics;
  while (metrics.size() < nodes) {
    const std::array<Vec3, 3> frame = random_frame(generator);
    std::array<double, 3> values{};
    for (double& value : values) value = std::pow(smallest * std::pow(10, power(generator)), -2);
    metrics.push_back(compose(values, frame));
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

TEST(Hostile, WhiteNoiseIsTheSameForAnyNumberOfThreads) {
  const TetMesh background = perturbed_box(kUnitBox, {4, 4, 4}, 0.2, 4);
  const MeshMetricField metric(background, random_metrics(background.points.size(), 0.003, 4));
  expect_valid_for_any_threads(background, metric);
}

/// From corner to corner the size across turns by a right angle and the aspect is 1000.
TEST(Hostile, TurningMetricOfAspect1000) {
  const FormulaMetric metric([](const Vec3& p) {
    const double angle = 0.5 * (p.x + p.y + p.z);
    const Vec3 across{std::cos(angle), std::sin(angle) * 0.6, std::sin(angle) * 0.8};
    return kIdentity3 + 1e6 * outer(across);
  });
  expect_valid_for_any_threads(box_mesh(kUnitBox, {2, 2, 2}), metric);
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

TEST(Hostile, JumpsOfAThousandAcrossATiltedPlane) {
  const Vec3 normal{0.61, 0.37, 0.7};
  const FormulaMetric sizes(
      [normal](const Vec3& p) { return (dot(normal, p) < 0.8 ? 1e6 : 1) * kIdentity3; });
  expect_valid_for_any_threads(perturbed_box(kUnitBox, {3, 3, 3}, 0.2), sizes);
  // As fine along one axis on this side of the plane as along another on that side.
  const FormulaMetric axes([normal](const Vec3& p) {
    return dot(normal, p) < 0.8 ? Sym3{1e6, 0, 0, 1, 0, 1} : Sym3{1, 0, 0, 1, 0, 1e6};
  });
  expect_valid(box_mesh(kUnitBox, {2, 2, 2}), axes);
}

/// One or two eigenvalues of 1e-14 of the others, in directions of their own at every node.
TEST(Hostile, NearlySingularMetrics) {
  const TetMesh background = perturbed_box(kUnitBox, {3, 3, 3}, 0.2);
  auto field_of = [&background](const std::array<double, 3>& values) {
    std::mt19937 generator(7);
    std::vector<Sym3> metrics;
    while (metrics.size() < background.points.size()) {
      metrics.push_back(compose(values, random_frame(generator)));
    }
    return MeshMetricField(background, metrics);
  };
  expect_valid(box_mesh(kUnitBox, {2, 2, 2}), field_of({1e8, 1e-6, 1e-6}));
  expect_valid_for_any_threads(background, field_of({1e8, 1e8, 1e-6}));
}

TEST(Hostile, SizesFarLargerThanTheBox) {
  for (const double size : {10.0, 1e6, 1e200}) {
    const FormulaMetric metric = uniform_metric(size);
    const TetMesh mesh = remesh(perturbed_box(kUnitBox, {5, 5, 5}, 0.2), metric);
    expect_box_kept(mesh, kUnitBox);
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
  for (const Vec3 hi :
       {Vec3{1000, 1, 1}, Vec3{1, 1, 1000}, Vec3{1, 1000, 1000}, Vec3{1e-6, 1e-3, 1e-4}}) {
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

TEST(Hostile, FlatAndLongBoxesFarFromTheOrigin) {
  for (const double offset : {1e4, 1e9}) {
    for (const Vec3 extent : {Vec3{1, 1, 1}, Vec3{1000, 1, 1}, Vec3{1000, 1, 1000}}) {
      const Vec3 lo{-offset, 3 * offset, 0.7 * offset};
      const Box box{lo, lo + extent};
      expect_valid(box_mesh(box, {3, 1, 2}), uniform_metric(std::cbrt(box.volume() / 300)));
    }
  }
}

TEST(Hostile, MetricsThatAreNoneDoNoHarm) {
  for (const double bad :
       {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY), 1e300}) {
    const FormulaMetric metric(
        [bad](const Vec3& p) { return p.x < 0.5 ? bad * kIdentity3 : Sym3{25, 0, 0, 25, 0, 25}; });
    expect_valid(box_mesh(kUnitBox, {3, 3, 3}), metric);
  }
}

TEST(Hostile, AMeshMetricThatIsNoneIsRefusedWithItsNode) {
  const TetMesh mesh = box_mesh(kUnitBox, {2, 2, 2});
  const Sym3 not_finite[]{{kNan, 0, 0, 1, 0, 1},      {1, 0, 0, 1, kNan, 1},
                          {1, 0, 0, 1, 0, kInfinity}, {1, -kInfinity, 0, 1, 0, 1},
                          kNan * kIdentity3,          kInfinity * kIdentity3};
  const Sym3 not_definite[]{{},                      // zero
                            -1 * kIdentity3,         // negative
                            {1, 0, 0, 0, 0, 1},      // singular
                            {1, 0, 0, 1, 0, -1e-9},  // one negative size
                            {1, 2, 0, 1, 0, 1},      // indefinite, its diagonal positive
                            {1e12, 0, 0, 1, 1.001, 1}};
  auto field_with = [&mesh](const Sym3& bad, std::size_t node) {
    std::vector<Sym3> metrics(mesh.points.size(), 4.0 * kIdentity3);
    metrics[node] = bad;
    return MeshMetricField(mesh, metrics);
  };
  for (const std::size_t node : {0u, 13u, 26u}) {
    const std::string name = "node " + std::to_string(node) + " (the first is 0) ";
    for (const Sym3& bad : not_finite) {
      EXPECT_REFUSED(field_with(bad, node), HasSubstr(name + "is not finite"));
    }
    for (const Sym3& bad : not_definite) {
      EXPECT_REFUSED(field_with(bad, node), HasSubstr(name + "is not positive definite"));
    }
  }
}

/// Any finite logarithm is that of a metric: there is no other way for a grid to hold none.
TEST(Hostile, AGridMetricThatIsNotFiniteIsRefusedWithItsNode) {
  constexpr float kHuge = 3e38f;
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (std::size_t entry = 0; entry < 6; ++entry) {
      std::vector<PackedSym3> logs(27);
      logs[5 + entry][entry] = static_cast<float>(bad);
      EXPECT_REFUSED(
          GridMetricField(kUnitBox, {3, 3, 3}, logs),
          HasSubstr("node " + std::to_string(5 + entry) + " (the first is 0) is not finite"));
    }
  }
  std::vector<PackedSym3> logs(27);
  logs[3] = {kHuge, 0, 0, kHuge, 0, kHuge};
  logs[13] = {-kHuge, 0, kHuge, 1, 0, 1};
  logs[26] = {0, kHuge, -kHuge, kHuge, kHuge, 0};
  expect_valid(box_mesh(kUnitBox, {2, 2, 2}), GridMetricField(kUnitBox, {3, 3, 3}, logs));
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
