// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/exact_predicates.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

namespace mesamis {
namespace {

__extension__ using Wide = __int128;
using Lattice = std::array<std::int64_t, 3>;

int sign(Wide x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// The same determinant in integers; exact for coordinates below 2^40.
int exact_orientation(const std::array<Lattice, 4>& p) {
  std::array<std::array<Wide, 3>, 3> e;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) e[i][k] = p[i + 1][k] - p[0][k];
  }
  const Wide x = e[0][1] * e[1][2] - e[0][2] * e[1][1];
  const Wide y = e[0][2] * e[1][0] - e[0][0] * e[1][2];
  const Wide z = e[0][0] * e[1][1] - e[0][1] * e[1][0];
  return sign(x * e[2][0] + y * e[2][1] + z * e[2][2]);
}

Vec3 point(const Lattice& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

double rounded_determinant(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return dot(cross(b - a, c - a), d - a);
}

/// Points within a few units of one plane whose determinants need up to 105 bits.
TEST(Orientation, AgreesWithIntegersWhereDoublesFail) {
  std::mt19937_64 generator(3);
  std::uniform_int_distribution<std::int64_t> wide(-(std::int64_t{1} << 38), std::int64_t{1} << 38);
  std::uniform_int_distribution<std::int64_t> few(-9, 9), one(-1, 1);
  int wrong_in_doubles = 0, flat = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Lattice a{wide(generator), wide(generator), wide(generator)};
    const Lattice u{wide(generator) / 32, wide(generator) / 32, wide(generator) / 32};
    const Lattice v{u[0] + few(generator), u[1] + few(generator), u[2] + few(generator)};
    const std::int64_t s = few(generator), t = few(generator);
    std::array<Lattice, 4> p{a, a, a, a};
    for (std::size_t k = 0; k < 3; ++k) {
      p[1][k] += u[k];
      p[2][k] += v[k];
      p[3][k] += s * u[k] + t * v[k] + (i % 2 == 0 ? one(generator) : 0);
    }
    const Vec3 q[]{point(p[0]), point(p[1]), point(p[2]), point(p[3])};
    const int expected = exact_orientation(p);
    ASSERT_EQ(orientation(q[0], q[1], q[2], q[3]), expected) << i;
    const double guess = rounded_determinant(q[0], q[1], q[2], q[3]);
    wrong_in_doubles += (guess > 0) - (guess < 0) != expected;
    flat += expected == 0;
  }
  EXPECT_GT(wrong_in_doubles, 1000);  // else the points are too easy
  EXPECT_GT(flat, 5000);
}

TEST(OrientationAlong, AgreesWithIntegersWhereDoublesFail) {
  std::mt19937_64 generator(4);
  std::uniform_int_distribution<std::int64_t> wide(-(std::int64_t{1} << 50), std::int64_t{1} << 50);
  std::uniform_int_distribution<std::int64_t> one(-1, 1);
  int wrong_in_doubles = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Lattice a{wide(generator), wide(generator), wide(generator)};
    Lattice b = a, c = a;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t u = wide(generator) / 4;
      b[k] += u;
      c[k] += 2 * u + one(generator);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t s = (axis + 1) % 3, t = (axis + 2) % 3;
      const Wide area = static_cast<Wide>(b[s] - a[s]) * (c[t] - a[t]) -
                        static_cast<Wide>(b[t] - a[t]) * (c[s] - a[s]);
      const Vec3 p = point(a), q = point(b), r = point(c);
      ASSERT_EQ(orientation_along(static_cast<int>(axis), p, q, r), sign(area)) << i;
      const double guess = cross(q - p, r - p)[static_cast<int>(axis)];
      wrong_in_doubles += (guess > 0) - (guess < 0) != sign(area);
    }
  }
  EXPECT_GT(wrong_in_doubles, 0);
}

/// Cassini: F(n+1) F(n-1) - F(n)^2 = (-1)^n, far below the round-off of either product.
TEST(OrientationAlong, OfFibonacciNumbersAlternates) {
  double previous = 1, current = 1, next = 2;  // F(1), F(2), F(3)
  for (int n = 2; n <= 76; ++n) {
    const int expected = n % 2 == 0 ? 1 : -1;
    EXPECT_EQ(orientation_along(2, {0, 0, 9}, {next, current, 7}, {current, previous, 8}), expected)
        << n;
    previous = current;
    current = next;
    next = previous + current;
  }
}

TEST(Orientation, SeesOneUnitInTheLastPlace) {
  // Coplanar in a tilted plane x + y + z = 3 * 2^k, then moved by one ulp.
  for (const double scale : {1.0, 0x1p-10, 0x1p12, 0x1p40}) {
    const Vec3 a{scale, scale, scale}, b{1.5 * scale, 0.5 * scale, scale};
    const Vec3 c{0.25 * scale, scale, 1.75 * scale};
    Vec3 d{0.5 * scale, 1.5 * scale, scale};
    EXPECT_EQ(orientation(a, b, c, d), 0);
    const int up = orientation(a, b, c, {2 * scale, 2 * scale, 2 * scale});
    EXPECT_NE(up, 0);
    d.x = std::nextafter(d.x, 1e300);
    EXPECT_EQ(orientation(a, b, c, d), up);
    d.x = std::nextafter(std::nextafter(d.x, 0), 0);
    EXPECT_EQ(orientation(a, b, c, d), -up);
  }
}

TEST(Orientation, ChangesSignWithEveryExchange) {
  std::mt19937 generator(1);
  // Points on a coarse lattice far away: many are coplanar.
  std::uniform_int_distribution<int> lattice(0, 3);
  auto point = [&] {
    return Vec3{1e8 + 0.1 * lattice(generator), 0.1 * lattice(generator),
                1e-5 * lattice(generator)};
  };
  int flat = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 a = point(), b = point(), c = point(), d = point();
    const int sign = orientation(a, b, c, d);
    flat += sign == 0;
    EXPECT_EQ(orientation(b, a, c, d), -sign);
    EXPECT_EQ(orientation(a, c, b, d), -sign);
    EXPECT_EQ(orientation(a, b, d, c), -sign);
    EXPECT_EQ(orientation(d, b, c, a), -sign);
  }
  EXPECT_GT(flat, 500);
}

TEST(OrientationAlong, SeesOneUnitInTheLastPlace) {
  const Vec3 a{0, 0.1, 0.1}, b{0, 0.2, 0.2}, c{0, 1e9, 1e9};
  EXPECT_EQ(orientation_along(0, a, b, c), 0);
  EXPECT_EQ(orientation_along(0, a, b, {0, 1e9, std::nextafter(1e9, 2e9)}), 1);
  EXPECT_EQ(orientation_along(0, a, b, {0, 1e9, std::nextafter(1e9, 0)}), -1);
}

}  // namespace
}  // namespace mesamis
