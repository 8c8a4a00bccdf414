// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/single_precision.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mesamis {
namespace {

/// Whether 24 binary digits hold it; found without a conversion, which is what might be left out.
bool is_single(double x) {
  int exponent = 0;
  const double digits = std::ldexp(std::frexp(x, &exponent), 24);
  return digits == std::trunc(digits);
}

TEST(SinglePrecision, HoldsOnEveryAxis) {
  for (int i = 1; i < 200; ++i) {
    const Vec3 exact{i / 30.0, i / -7.0, i / 3.0}, p = rounded(exact);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_TRUE(is_single(p[axis])) << p[axis];
      EXPECT_NEAR(p[axis], exact[axis], std::abs(exact[axis]) * 6e-8);
    }
  }
}

TEST(SinglePrecision, HasNoNegativeZero) {
  const Vec3 p = rounded(Vec3{-0.0, 0.0, -1e-60});
  for (int axis = 0; axis < 3; ++axis) EXPECT_FALSE(std::signbit(p[axis])) << axis;
}

}  // namespace
}  // namespace mesamis
