// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/metric_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/base/sym3.h"
#include "support/expect_near.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

const Box kBox{{-1, 0, 2}, {3, 2, 5}};

/// The logarithm of a metric that varies linearly, so that both interpolations are exact.
Sym3 linear_log(const Vec3& p) {
  return {p.x, 0.25 * p.y, -0.5, 1 - p.z, 0.125 * p.x, 0.5 * p.y + 0.25};
}

void expect_close(const Sym3& a, const Sym3& b, double relative) {
  expect_near(a, b, relative * trace(b));
}

GridMetricField linear_grid(const std::array<Index, 3>& size) {
  std::vector<std::array<float, 6>> logs;
  const Vec3 extent = kBox.extent();
  for (Index k = 0; k < size[2]; ++k) {
    for (Index j = 0; j < size[1]; ++j) {
      for (Index i = 0; i < size[0]; ++i) {
        const Sym3 log =
            linear_log(kBox.lo + Vec3{extent.x * i / (size[0] - 1), extent.y * j / (size[1] - 1),
                                      extent.z * k / (size[2] - 1)});
        logs.push_back({static_cast<float>(log.xx), static_cast<float>(log.xy),
                        static_cast<float>(log.xz), static_cast<float>(log.yy),
                        static_cast<float>(log.yz), static_cast<float>(log.zz)});
      }
    }
  }
  return {kBox, size, std::move(logs)};
}

MeshMetricField linear_mesh() {
  TetMesh mesh = perturbed_box(kBox, {3, 2, 4}, 0.2);
  std::vector<Sym3> metrics;
  for (const Vec3& p : mesh.points) metrics.push_back(exp_sym(linear_log(p)));
  return {std::move(mesh), metrics};
}

void expect_linear(const MetricField& field, double relative) {
  Index hint = 0;
  for (double s = 0; s <= 1; s += 0.05) {
    const Vec3 p{-1 + 4 * s, 2 * std::fmod(3 * s, 1), 2 + 3 * std::fmod(7 * s, 1)};
    expect_close(field.at(p, hint), exp_sym(linear_log(p)), relative);
  }
  // Outside: the nearest point of the box. The far corner is nearest for what lies beyond it.
  expect_close(field.at({30, 20, 50}, hint), exp_sym(linear_log(kBox.hi)), relative);
}

TEST(GridMetricField, ReproducesALinearLogarithm) {
  expect_linear(linear_grid({2, 2, 2}), 1e-6);
  expect_linear(linear_grid({5, 3, 4}), 1e-6);
}

TEST(MeshMetricField, ReproducesALinearLogarithm) { expect_linear(linear_mesh(), 1e-9); }

TEST(ScaledMetricField, MultipliesSizes) {
  const GridMetricField field = linear_grid({2, 2, 2});
  const ScaledMetricField twice(field, 2);
  Index hint = 0;
  const Vec3 p{0, 1, 3};
  expect_close(4.0 * twice.at(p, hint), field.at(p, hint), 1e-12);
}

TEST(MetricFields, RefuseWhatIsNoMetric) {
  using Logs = std::vector<std::array<float, 6>>;
  EXPECT_THROW(GridMetricField(kBox, {2, 2, 2}, Logs(7)), InputError);
  EXPECT_THROW(GridMetricField(kBox, {1, 2, 2}, Logs(4)), InputError);
  Logs broken(8);
  broken[3][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(GridMetricField(kBox, {2, 2, 2}, broken), InputError);

  const TetMesh mesh = box_mesh(kBox, {1, 1, 1});
  std::vector<Sym3> metrics(8, kIdentity3);
  EXPECT_NO_THROW(MeshMetricField(mesh, metrics));
  metrics[5].zz = -1;
  EXPECT_THROW(MeshMetricField(mesh, metrics), InputError);
  metrics[5] = {1, 0, 0, 1, 0, std::numeric_limits<double>::infinity()};
  EXPECT_THROW(MeshMetricField(mesh, metrics), InputError);
  metrics.pop_back();
  EXPECT_THROW(MeshMetricField(mesh, metrics), InputError);
}

}  // namespace
}  // namespace mesamis
