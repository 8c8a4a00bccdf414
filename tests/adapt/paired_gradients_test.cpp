// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/paired_gradients.h"

#include <gtest/gtest.h>

#include <random>

#include "support/expect_near.h"

namespace mesamis {
namespace {

/// Sums of one field, one after the other.
struct DirectSums {
  double weights = 0;
  Vec3 gradient;
  Sym3 product;
  void add(const Vec3& g, double weight) {
    weights += weight;
    gradient += weight * g;
    product += weight * outer(g);
  }
};

TEST(PairedSums, AreThoseOfEachFieldAlone) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-3, 3);
  const auto random = [&] {
    return Vec3{uniform(generator), uniform(generator), uniform(generator)};
  };
  PairedSums pairs;
  DirectSums u, v;
  for (int n = 0; n < 30; ++n) {
    const Vec3 gu = random(), gv = random();
    const double weight = n % 3 == 0 ? 1 : 4 + uniform(generator);
    if (weight == 1) {
      pairs.add({gu, gv});
    } else {
      pairs.add({gu, gv}, weight);
    }
    u.add(gu, weight), v.add(gv, weight);
  }
  constexpr double kVolume = 0.25;
  for (const auto& [found, expected] :
       {std::pair{pairs.of_u(kVolume), u}, std::pair{pairs.of_v(kVolume), v}}) {
    EXPECT_NEAR(found.volume, kVolume * expected.weights, 1e-12);
    expect_near(found.gradient, kVolume * expected.gradient, 1e-11);
    expect_near(found.gradient_outer, kVolume * expected.product, 1e-10);
  }
}

TEST(PairedSums, AddUp) {
  const PairedGradients a({1, 2, 3}, {-1, 0, 2}), b({4, 1, 3}, {-1, 5, 2}), c({0, 1, 0}, {2, 2, 1});
  PairedSums some, others, all;
  some.add(a), others.add(b), others.add(c, 2);
  some.add(others);
  all.add(a), all.add(b), all.add(c, 2);
  for (const auto& [found, expected] :
       {std::pair{some.of_u(), all.of_u()}, std::pair{some.of_v(), all.of_v()}}) {
    EXPECT_EQ(found.volume, expected.volume);
    expect_near(found.gradient, expected.gradient, 1e-14);
    expect_near(found.gradient_outer, expected.gradient_outer, 1e-14);
  }
}

TEST(SetJumps, IsTheJumpOfTheNormalDerivatives) {
  CellData cell;
  cell.grad_u = {1, 2, 3}, cell.grad_v = {-1, 0, 2};
  const Vec3 normal{0, 0.6, 0.8};
  const PairedGradients beyond({4, 1, 3}, {-1, 5, 2});
  set_jumps(2, normal, &beyond, cell);
  EXPECT_NEAR(cell.jump_u[2], 0.6, 1e-12);
  EXPECT_NEAR(cell.jump_v[2], 3, 1e-12);
  EXPECT_EQ(cell.jump_u[0], 0);
}

TEST(SetJumps, IsTwiceTheNormalDerivativeOnTheBoundary) {
  CellData cell;
  cell.grad_u = {1, 2, 3}, cell.grad_v = {-1, 0, 2};
  set_jumps(1, {0, 0.6, 0.8}, nullptr, cell);
  EXPECT_NEAR(cell.jump_u[1], 2 * (0.6 * 2 + 0.8 * 3), 1e-12);
  EXPECT_NEAR(cell.jump_v[1], 2 * 0.8 * 2, 1e-12);
}

TEST(SetJumps, VanishesAcrossTheSameGradients) {
  CellData cell;
  cell.grad_u = {1, 2, 3}, cell.grad_v = {-1, 0, 2};
  const PairedGradients same(cell.grad_u, cell.grad_v);
  set_jumps(3, {1, 0, 0}, &same, cell);
  EXPECT_EQ(cell.jump_u[3], 0);
  EXPECT_EQ(cell.jump_v[3], 0);
}

}  // namespace
}  // namespace mesamis
