// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "mesamis/base/sym3.h"
#include "mesamis/base/types.h"

namespace mesamis {

inline void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-9) {
  EXPECT_LT(norm(a - b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

inline void expect_near(const Sym3& a, const Sym3& b, double tolerance) {
  EXPECT_NEAR(a.xx, b.xx, tolerance);
  EXPECT_NEAR(a.xy, b.xy, tolerance);
  EXPECT_NEAR(a.xz, b.xz, tolerance);
  EXPECT_NEAR(a.yy, b.yy, tolerance);
  EXPECT_NEAR(a.yz, b.yz, tolerance);
  EXPECT_NEAR(a.zz, b.zz, tolerance);
}

}  // namespace mesamis
