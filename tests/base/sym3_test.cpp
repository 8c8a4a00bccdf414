// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/sym3.h"

#include <gtest/gtest.h>

#include <random>

#include "support/expect_near.h"

namespace mesamis {
namespace {

Sym3 random_spd(std::mt19937& generator, double largest_log) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Sym3 log;
  for (double* entry : {&log.xx, &log.xy, &log.xz, &log.yy, &log.yz, &log.zz}) {
    *entry = largest_log * uniform(generator);
  }
  return exp_sym(log);
}

TEST(Sym3, EigenpairsComposeTheMatrix) {
  std::mt19937 generator(1);
  for (int i = 0; i < 1000; ++i) {
    const Sym3 a = random_spd(generator, 2);
    const SymEigen e = eigen_decompose(a);
    EXPECT_GE(e.values[0], e.values[1]);
    EXPECT_GE(e.values[1], e.values[2]);
    expect_near(compose(e.values, e.vectors), a, 1e-13 * e.values[0]);
  }
}

TEST(Sym3, ExpUndoesLog) {
  std::mt19937 generator(2);
  for (int i = 0; i < 1000; ++i) {
    const Sym3 a = random_spd(generator, 3);
    expect_near(exp_sym(log_spd(a)), a, 1e-11 * trace(a));
  }
}

TEST(Sym3, ExpOfLargeAnisotropyKeepsTheDeterminant) {
  // det exp(A) = exp(trace A), for condition numbers up to 1e12 (sizes 1 : 1e6).
  const Sym3 log{13.8, 0, 0, -6.9, 0, -6.9};
  EXPECT_NEAR(determinant(exp_sym(log)), 1, 1e-9);
}

TEST(Sym3, InverseTimesMatrixIsIdentity) {
  std::mt19937 generator(3);
  for (int i = 0; i < 100; ++i) {
    const Sym3 a = random_spd(generator, 1);
    const Sym3 b = inverse(a);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 unit;
      unit[axis] = 1;
      EXPECT_NEAR(norm(a * (b * unit) - unit), 0, 1e-10);
    }
  }
}

}  // namespace
}  // namespace mesamis
