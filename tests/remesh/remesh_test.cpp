// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/remesh.h"

#include <gtest/gtest.h>

#include <ostream>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/metric.h"
#include "support/metric_fields.h"
#include "support/perturbed_box.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using ::testing::HasSubstr;

MeshFit fit_of(const TetMesh& mesh, const MetricField& metric) {
  return measure_fit(mesh, metrics_at_nodes(mesh, metric));
}

TEST(Remesh, UniformMetricGivesRegularCells) {
  const FormulaMetric metric = uniform_metric(0.1);
  RemeshReport report;
  const TetMesh mesh = remesh(box_mesh(kUnitBox, {1, 1, 1}), metric, {}, &report);
  EXPECT_EQ(find_flaw(mesh, kUnitBox), "");
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.size_factor, 1);
  const MeshFit fit = fit_of(mesh, metric);
  EXPECT_GT(fit.unit_edge_fraction, 0.98);
  EXPECT_GT(fit.quality_mean, 0.88);
  EXPECT_GT(fit.quality_min, 0.3);
  EXPECT_NEAR(static_cast<double>(mesh.cells.size()), 9000, 1500);
}

struct UgawgBound {
  Ugawg which;
  double unit_edges, quality_mean, quality_min;
};

/// What the test is called.
void PrintTo(const UgawgBound& bound, std::ostream* out) {
  constexpr const char* kNames[]{"linear", "polar-1", "polar-2"};
  *out << kNames[static_cast<int>(bound.which)];
}

class RemeshUgawg : public testing::TestWithParam<UgawgBound> {};

TEST_P(RemeshUgawg, FitsTheMetric) {
  const auto [which, unit_edges, quality_mean, quality_min] = GetParam();
  const FormulaMetric metric = ugawg_metric(which, ugawg_scale(which, 20'000));
  const TetMesh mesh = remesh(box_mesh(kUnitBox, {3, 3, 3}), metric);
  EXPECT_EQ(find_flaw(mesh, kUnitBox), "");
  const MeshFit fit = fit_of(mesh, metric);
  EXPECT_GT(fit.unit_edge_fraction, unit_edges);
  EXPECT_GT(fit.quality_mean, quality_mean);
  EXPECT_GT(fit.quality_min, quality_min);
}

INSTANTIATE_TEST_SUITE_P(Cubes, RemeshUgawg,
                         testing::Values(UgawgBound{Ugawg::kLinear, 0.98, 0.88, 0.3},
                                         UgawgBound{Ugawg::kPolar1, 0.85, 0.65, 0.02},
                                         UgawgBound{Ugawg::kPolar2, 0.96, 0.84, 0.2}));

TEST(Remesh, SameBytesForAnyNumberOfThreads) {
  const FormulaMetric metric = ugawg_metric(Ugawg::kPolar2, ugawg_scale(Ugawg::kPolar2, 7'000));
  const TetMesh background = box_mesh(kUnitBox, {6, 6, 6});
  const MeshMetricField field(background, metrics_at_nodes(background, metric));
  RemeshOptions options;
  options.part_cells = 1000;
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 4, 8}) {
    const TetMesh mesh = with_threads(threads, [&] { return remesh(background, field, options); });
    EXPECT_EQ(find_flaw(mesh, kUnitBox), "");
    EXPECT_GT(mesh.cells.size(), 2000u);
    hashes.push_back(mesh_hash(mesh));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(Remesh, PartsCostLittleQuality) {
  const FormulaMetric metric = ugawg_metric(Ugawg::kLinear, ugawg_scale(Ugawg::kLinear, 20'000));
  RemeshOptions options;
  options.part_cells = 2500;
  const MeshFit fit = fit_of(remesh(box_mesh(kUnitBox, {3, 3, 3}), metric, options), metric);
  EXPECT_GT(fit.unit_edge_fraction, 0.97);
  EXPECT_GT(fit.quality_mean, 0.87);
}

std::int64_t operations(const RemeshReport& report) {
  return report.splits + report.collapses + report.swaps + report.moves;
}

/// Cells that both meshes have, by the bits of their corners.
std::size_t common_cells(const TetMesh& one, const TetMesh& other) {
  using Corners = std::array<std::array<double, 3>, 4>;
  auto sorted_corners = [](const TetMesh& mesh) {
    std::vector<Corners> cells;
    for (const Cell& k : mesh.cells) {
      Corners corners;
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec3& p = mesh.points[k[i]];
        corners[i] = {p.x, p.y, p.z};
      }
      std::sort(corners.begin(), corners.end());
      cells.push_back(corners);
    }
    std::sort(cells.begin(), cells.end());
    return cells;
  };
  const auto a = sorted_corners(one), b = sorted_corners(other);
  std::vector<Corners> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  return common.size();
}

TEST(Remesh, ReadaptingToTheSameMetricIsCheapAndChangesLittle) {
  const FormulaMetric uniform = uniform_metric(0.08);
  const FormulaMetric layer = ugawg_metric(Ugawg::kLinear, ugawg_scale(Ugawg::kLinear, 10'000));
  for (const auto& [metric, most_changes] : {std::pair{&uniform, 0.05}, std::pair{&layer, 0.08}}) {
    RemeshReport first, second;
    const TetMesh mesh = remesh(box_mesh(kUnitBox, {2, 2, 2}), *metric, {}, &first);
    const MeshMetricField same(mesh, metrics_at_nodes(mesh, *metric));
    const TetMesh again = remesh(mesh, same, {}, &second);
    EXPECT_EQ(find_flaw(again, kUnitBox), "");
    EXPECT_LT(second.rounds, first.rounds / 2 + 1);
    EXPECT_LT(2 * operations(second), operations(first));
    EXPECT_LT(static_cast<double>(second.splits + second.collapses),
              most_changes * static_cast<double>(mesh.points.size()));
    EXPECT_GT(2 * common_cells(mesh, again), mesh.cells.size());
    EXPECT_GE(fit_of(again, same).unit_edge_fraction,
              fit_of(mesh, same).unit_edge_fraction - 0.005);
  }
}

/// From a mesh with all sizes twice or half as large, the result is as good as from a coarse box.
TEST(Remesh, RefinesAndCoarsensByTwoAsWellAsFromACoarseBox) {
  const double scale = ugawg_scale(Ugawg::kPolar2, 2'000);
  const FormulaMetric metric = ugawg_metric(Ugawg::kPolar2, scale);
  const TetMesh fresh = remesh(coarse_box_mesh(kUnitBox), metric);
  const MeshFit fresh_fit = fit_of(fresh, metric);
  for (const double factor : {0.5, 2.0}) {
    const FormulaMetric other = ugawg_metric(Ugawg::kPolar2, factor * scale);
    const TetMesh mesh = remesh(remesh(coarse_box_mesh(kUnitBox), other), metric);
    EXPECT_EQ(find_flaw(mesh, kUnitBox), "");
    const MeshFit fit = fit_of(mesh, metric);
    EXPECT_GT(fit.unit_edge_fraction, fresh_fit.unit_edge_fraction - 0.02) << factor;
    EXPECT_GT(fit.quality_mean, fresh_fit.quality_mean - 0.02) << factor;
    EXPECT_NEAR(static_cast<double>(mesh.cells.size()), static_cast<double>(fresh.cells.size()),
                0.1 * static_cast<double>(fresh.cells.size()))
        << factor;
  }
}

TEST(Remesh, ADraftIsCheapAndLeadsToAMeshAsGood) {
  for (const Ugawg which : {Ugawg::kLinear, Ugawg::kPolar1, Ugawg::kPolar2}) {
    const FormulaMetric metric = ugawg_metric(which, ugawg_scale(which, 10'000));
    RemeshOptions options;
    options.draft = true;
    RemeshReport full, quick;
    const TetMesh mesh = remesh(coarse_box_mesh(kUnitBox), metric, {}, &full);
    const TetMesh draft = remesh(coarse_box_mesh(kUnitBox), metric, options, &quick);
    EXPECT_EQ(find_flaw(draft, kUnitBox), "");
    EXPECT_TRUE(quick.converged);
    EXPECT_LT(4 * quick.rounds, 3 * full.rounds);
    EXPECT_LT(operations(quick), operations(full));
    EXPECT_NEAR(static_cast<double>(draft.cells.size()), static_cast<double>(mesh.cells.size()),
                0.2 * static_cast<double>(mesh.cells.size()));
    const MeshFit wanted = fit_of(mesh, metric), found = fit_of(remesh(draft, metric), metric);
    EXPECT_GT(found.unit_edge_fraction, wanted.unit_edge_fraction - 0.02);
    EXPECT_GT(found.quality_mean, wanted.quality_mean - 0.02);
  }
}

TEST(Remesh, MeshMetricIsFollowed) {
  const FormulaMetric metric([](const Vec3& p) {
    const double h = 0.04 + 0.3 * std::abs(p.x - 0.5);
    return 1 / (h * h) * kIdentity3;
  });
  const TetMesh background = box_mesh(kUnitBox, {16, 4, 4});
  const MeshMetricField field(background, metrics_at_nodes(background, metric));
  const TetMesh mesh = remesh(background, field);
  EXPECT_EQ(find_flaw(mesh, kUnitBox), "");
  EXPECT_GT(fit_of(mesh, field).unit_edge_fraction, 0.95);
}

/// The share of the shell's points that lie in cells fit for it.
TEST(Remesh, ThinShellInACoarseBoxIsFound) {
  const FormulaMetric shell([](const Vec3& p) {
    const Vec3 from_center = p - Vec3{0.5, 0.5, 0.5};
    const double distance = std::abs(norm(from_center) - 0.31);
    const double h = distance < 0.01 ? 0.02 : std::min(0.02 + 0.6 * (distance - 0.01), 0.5);
    return 1 / (h * h) * kIdentity3;
  });
  const TetMesh mesh = remesh(box_mesh(kUnitBox, {2, 2, 2}), shell);
  EXPECT_EQ(find_flaw(mesh, kUnitBox), "");
  const auto metrics = metrics_at_nodes(mesh, shell);
  const double wanted = 4 * 3.14159265 * 0.31 * 0.31 * 0.02 / (0.02 * 0.02 * 0.02);
  EXPECT_GT(complexity(mesh, metrics), wanted);
  EXPECT_GT(measure_fit(mesh, metrics).unit_edge_fraction, 0.9);
}

TEST(Remesh, GridMetricWithSmallHiddenFeatures) {
  // Fine balls of 2.5 voxels' radius that sit inside the start's cells.
  constexpr Index n = 40;
  std::vector<std::array<float, 6>> logs;
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const bool inside = std::hypot(i - 7.0, j - 29.0, k - 13.0) < 2.5 ||
                            std::hypot(i - 31.0, j - 11.0, k - 27.0) < 2.5;
        const auto l = static_cast<float>(-2 * std::log(inside ? 0.01 : 0.4));
        logs.push_back({l, 0, 0, l, 0, l});
      }
    }
  }
  const GridMetricField field(kUnitBox, {n, n, n}, logs);
  const TetMesh mesh = remesh(box_mesh(kUnitBox, {2, 2, 2}), field);
  EXPECT_EQ(find_flaw(mesh, kUnitBox), "");
  const double wanted =
      integrated_complexity(field, kUnitBox, {2 * (n - 1), 2 * (n - 1), 2 * (n - 1)});
  EXPECT_NEAR(complexity(mesh, metrics_at_nodes(mesh, field)), wanted, 0.25 * wanted);
  EXPECT_NEAR(static_cast<double>(mesh.cells.size()), 10 * wanted, 4 * wanted);
}

TEST(Remesh, DeliversTheCellsAskedForWhenTheyBind) {
  for (const Ugawg which : {Ugawg::kLinear, Ugawg::kPolar1}) {
    const FormulaMetric metric = ugawg_metric(which, ugawg_scale(which, 100'000));
    for (const std::int64_t most : {3'000, 12'000}) {
      RemeshOptions options;
      options.max_cells = most;
      RemeshReport report;
      const TetMesh mesh = remesh(box_mesh(kUnitBox, {2, 2, 2}), metric, options, &report);
      EXPECT_EQ(find_flaw(mesh, kUnitBox), "");
      EXPECT_NEAR(static_cast<double>(mesh.cells.size()), static_cast<double>(most),
                  0.1 * static_cast<double>(most));
      EXPECT_GT(report.size_factor, 1.5);
      const ScaledMetricField scaled(metric, report.size_factor);
      EXPECT_GT(fit_of(mesh, scaled).unit_edge_fraction, 0.8);
    }
  }
}

TEST(Remesh, LeavesTheMetricAloneWhenItNeedsFewerCells) {
  const FormulaMetric metric = uniform_metric(0.2);
  RemeshOptions options;
  options.max_cells = 1'000'000;
  RemeshReport report;
  const TetMesh mesh = remesh(box_mesh(kUnitBox, {2, 2, 2}), metric, options, &report);
  EXPECT_EQ(report.size_factor, 1);
  EXPECT_EQ(mesh_hash(mesh), mesh_hash(remesh(box_mesh(kUnitBox, {2, 2, 2}), metric)));
}

TEST(Remesh, TellsProgressAndCanBeCancelled) {
  const FormulaMetric metric = uniform_metric(0.2);
  std::vector<double> fractions;
  RemeshOptions options;
  options.progress = [&](std::string_view, double fraction) {
    fractions.push_back(fraction);
    return true;
  };
  remesh(box_mesh(kUnitBox, {2, 2, 2}), metric, options);
  ASSERT_GT(fractions.size(), 3u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0);
  EXPECT_LE(fractions.back(), 1);
  options.progress = [](std::string_view, double fraction) { return fraction < 0.3; };
  EXPECT_THROW(remesh(box_mesh(kUnitBox, {2, 2, 2}), metric, options), Cancelled);
}

TEST(Remesh, RefusesAStartThatIsNotAMeshOfItsBox) {
  const FormulaMetric metric = uniform_metric(0.5);
  TetMesh hole = box_mesh(kUnitBox, {2, 2, 2});
  hole.cells.erase(hole.cells.begin() + 20);
  EXPECT_REFUSED(remesh(hole, metric), HasSubstr("has one cell"));
  TetMesh inverted = box_mesh(kUnitBox, {2, 2, 2});
  std::swap(inverted.cells[3][0], inverted.cells[3][1]);
  EXPECT_REFUSED(remesh(inverted, metric), HasSubstr("cell 3"));
  TetMesh not_finite = box_mesh(kUnitBox, {2, 2, 2});
  not_finite.points[13].y = NAN;
  EXPECT_REFUSED(remesh(not_finite, metric), HasSubstr("point 13"));
  EXPECT_REFUSED(remesh(TetMesh{}, metric), HasSubstr("start mesh"));
  TetMesh stray = box_mesh(kUnitBox, {2, 2, 2});
  stray.points.push_back({0.5, 0.5, 0.4});
  EXPECT_REFUSED(remesh(stray, metric), HasSubstr("belongs to no cell"));
  TetMesh single{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  EXPECT_REFUSED(remesh(single, metric), HasSubstr("start mesh"));
}

/// A box of volume 8 in a metric of size 1/4: the complexity is 8 * 4^3.
TEST(PredictedCells, AreTheComplexityTimesTheCellsOfOne) {
  const FormulaMetric metric = uniform_metric(0.25);
  EXPECT_NEAR(cells_for_metric(metric, {{0, 0, 0}, {2, 2, 2}}), kCellsPerComplexity * 8 * 64, 1e-3);
}

TEST(Remesh, RefusesAMetricThatAsksForMoreCellsThanFit) {
  const FormulaMetric metric = uniform_metric(1e-6);
  EXPECT_REFUSED(remesh(box_mesh(kUnitBox, {2, 2, 2}), metric), HasSubstr("or a limit of cells"));
}

}  // namespace
}  // namespace mesamis
