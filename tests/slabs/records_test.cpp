// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/records.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

Iteration record(std::int64_t tets, double scale) {
  Iteration r;
  r.tets = tets;
  r.nodes = tets / 5;
  r.energy = {scale, 2 * scale, 3 * scale};
  r.surface_change = scale;
  r.surface_tolerance = 0.5;
  r.estimator = 4 * scale;
  r.predicted_tets = 10 * scale;
  r.aspect_max = {scale, 1, 1};
  r.aspect_mean = {scale, 1, 1};
  r.amis.iterations = static_cast<int>(scale);
  r.amis.converged = r.amis.solver_converged = true;
  r.seconds.amis = scale;
  return r;
}

TEST(SumOfRecords, OfOneSlabIsItsOwn) {
  const Iteration sum = sum_of_records({record(100, 3)});
  EXPECT_EQ(sum.tets, 100);
  EXPECT_EQ(sum.nodes, 20);
  EXPECT_EQ(sum.energy.total(), record(100, 3).energy.total());
  EXPECT_EQ(sum.surface_change, 3);
  EXPECT_EQ(sum.amis.iterations, 3);
  EXPECT_TRUE(sum.amis.converged);
  EXPECT_EQ(sum.aspect_mean[0], 3);
}

TEST(SumOfRecords, AddsCountsAndWeighsMeans) {
  Iteration open = record(300, 5);
  open.amis.converged = false;
  const Iteration sum = sum_of_records({record(100, 1), open});
  EXPECT_EQ(sum.tets, 400);
  EXPECT_EQ(sum.nodes, 80);
  EXPECT_EQ(sum.energy.fidelity, 6);
  EXPECT_EQ(sum.energy.smoothing, 12);
  EXPECT_EQ(sum.energy.edge, 18);
  EXPECT_EQ(sum.surface_change, 0.25 * 1 + 0.75 * 5);
  EXPECT_EQ(sum.surface_tolerance, 0.5);
  EXPECT_EQ(sum.estimator, 24);
  EXPECT_EQ(sum.predicted_tets, 60);
  EXPECT_EQ(sum.aspect_max[0], 5);
  EXPECT_EQ(sum.aspect_mean[0], 4) << "by cells";
  EXPECT_EQ(sum.amis.iterations, 5) << "the worst";
  EXPECT_FALSE(sum.amis.converged);
  EXPECT_TRUE(sum.amis.solver_converged);
  EXPECT_EQ(sum.seconds.amis, 6);
}

TEST(SumOfRecords, WithoutCellsThereIsNoMean) {
  EXPECT_EQ(sum_of_records({record(0, 0), record(0, 0)}).aspect_mean[0], 0);
}

}  // namespace
}  // namespace mesamis
