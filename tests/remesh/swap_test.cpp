// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/swap.h"

#include "remesh/small_mesh.h"

namespace mesamis {
namespace {

/// A metric in which a Kuhn mesh is bad.
const FormulaMetric kSkew([](const Vec3&) {
  return 40 * outer(Vec3{1, 1, 0}) + 4 * outer(Vec3{1, -1, 0}) + 9 * outer(Vec3{0, 0, 1});
});

TEST(Swap, EveryPassLowersTheEnergyByItsGain) {
  SmallMesh small(perturbed_box(kUnitBox, {4, 4, 4}, 0.3), kSkew);
  const SwapRule rule{.quality3_max = 1, .gain = 0.05};
  std::int64_t total = 0;
  for (int pass = 0; pass < 10; ++pass) {
    const double before = total_energy(small.mesh);
    const std::int64_t vertices = small.mesh.vertex_count();
    const std::int64_t swaps = swap_bad_cells(small.bench, rule);
    total += swaps;
    EXPECT_LE(total_energy(small.mesh),
              before - 0.049 * static_cast<double>(swaps) + 1e-3 * before);
    EXPECT_EQ(small.mesh.vertex_count(), vertices);
    expect_sound(small.mesh);
  }
  EXPECT_GT(total, 50);
}

TEST(Swap, EndsWhenNothingIsToGain) {
  SmallMesh small(perturbed_box(kUnitBox, {4, 4, 4}, 0.3), kSkew);
  const SwapRule rule{.quality3_max = 1, .gain = 0.05};
  int passes = 0;
  while (swap_bad_cells(small.bench, rule) > 0) ASSERT_LT(++passes, 50);
  // The list of what was tried must not have hidden a swap.
  for (WorkCell& cell : small.mesh.cells) cell.tried = 0;
  for (Index c = 0; c < std::ssize(small.mesh.cells); ++c) {
    if (small.mesh.cells[c].alive()) {
      EXPECT_FALSE(swap_around_cell(small.bench, c, 0.05));
    }
  }
}

TEST(Swap, TurnsTheDiagonalOfAFlatQuad) {
  // Eight cells of one brick layer under a metric that favours the other diagonals.
  SmallMesh small(box_mesh({{0, 0, 0}, {1, 1, 0.2}}, {3, 3, 1}), kSkew);
  const double before = worst_quality3(small.mesh);
  while (swap_bad_cells(small.bench, {.quality3_max = 1}) > 0) {
  }
  expect_sound(small.mesh);
  EXPECT_GT(worst_quality3(small.mesh), before);
}

}  // namespace
}  // namespace mesamis
