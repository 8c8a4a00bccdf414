// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/exact_predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mesamis::detail::surface {
namespace {

/// A sum of doubles that do not overlap, smallest first, none of them zero: its exact value. The
/// longest here has 3 * 64 terms.
struct Expansion {
  std::size_t size = 0;
  std::array<double, 192> terms;

  Expansion() = default;
  Expansion(const Expansion& other) { *this = other; }
  /// Copies the terms there are, not the room for them.
  Expansion& operator=(const Expansion& other) {
    size = other.size;
    std::copy_n(other.terms.begin(), size, terms.begin());
    return *this;
  }

  void append(double x) {
    if (x != 0) terms[size++] = x;
  }
  int sign() const { return size == 0 ? 0 : terms[size - 1] > 0 ? 1 : -1; }
};

struct Pair {
  double high, low;  // their sum is exact
};

Pair two_sum(double a, double b) {
  const double x = a + b, part = x - a;
  return {x, (a - (x - part)) + (b - part)};
}

Pair two_product(double a, double b) {
  const double x = a * b;
  return {x, std::fma(a, b, -x)};
}

Expansion difference(double a, double b) {
  const Pair d = two_sum(a, -b);
  Expansion e;
  e.append(d.low);
  e.append(d.high);
  return e;
}

/// Both merged by magnitude, then summed (fast_expansion_sum_zeroelim).
Expansion sum(const Expansion& e, const Expansion& f) {
  if (e.size == 0) return f;
  if (f.size == 0) return e;
  std::size_t i = 0, j = 0;
  auto next = [&] {
    const bool from_e = j == f.size || (i < e.size && std::abs(e.terms[i]) < std::abs(f.terms[j]));
    return from_e ? e.terms[i++] : f.terms[j++];
  };
  Expansion result;
  double total = next();
  while (i < e.size || j < f.size) {
    const Pair s = two_sum(total, next());
    result.append(s.low);
    total = s.high;
  }
  result.append(total);
  return result;
}

Expansion scaled(const Expansion& e, double b) {
  Expansion result;
  if (e.size == 0 || b == 0) return result;
  Pair carry = two_product(e.terms[0], b);
  result.append(carry.low);
  for (std::size_t i = 1; i < e.size; ++i) {
    const Pair product = two_product(e.terms[i], b);
    const Pair low = two_sum(carry.high, product.low);
    result.append(low.low);
    carry = two_sum(product.high, low.high);
    result.append(carry.low);
  }
  result.append(carry.high);
  return result;
}

/// @param f  at most two terms.
Expansion product(const Expansion& e, const Expansion& f) {
  if (f.size == 1) return scaled(e, f.terms[0]);
  Expansion result;
  for (std::size_t i = 0; i < f.size; ++i) result = sum(result, scaled(e, f.terms[i]));
  return result;
}

Expansion negated(Expansion e) {
  for (std::size_t i = 0; i < e.size; ++i) e.terms[i] = -e.terms[i];
  return e;
}

using Differences = std::array<Expansion, 3>;

Differences differences(const Vec3& a, const Vec3& b) {
  return {difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z)};
}

Expansion minor(const Differences& p, const Differences& q, std::size_t i, std::size_t j) {
  return sum(product(p[i], q[j]), negated(product(p[j], q[i])));
}

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Differences p = differences(b, a), q = differences(c, a), r = differences(d, a);
  const Expansion x = product(minor(q, r, 1, 2), p[0]);
  const Expansion y = product(minor(q, r, 2, 0), p[1]);
  const Expansion z = product(minor(q, r, 0, 1), p[2]);
  return sum(sum(x, y), z).sign();
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  constexpr double kErrorFactor = 8e-16;  // (7 + 56 eps) eps, rounded up
  const Vec3 p = b - a, q = c - a, r = d - a;
  const double qyrz = q.y * r.z, qzry = q.z * r.y;
  const double qzrx = q.z * r.x, qxrz = q.x * r.z;
  const double qxry = q.x * r.y, qyrx = q.y * r.x;
  const double det = p.x * (qyrz - qzry) + p.y * (qzrx - qxrz) + p.z * (qxry - qyrx);
  const double permanent = std::abs(p.x) * (std::abs(qyrz) + std::abs(qzry)) +
                           std::abs(p.y) * (std::abs(qzrx) + std::abs(qxrz)) +
                           std::abs(p.z) * (std::abs(qxry) + std::abs(qyrx));
  if (std::abs(det) > kErrorFactor * permanent) return det > 0 ? 1 : -1;
  if (permanent == 0) return 0;  // each product has a factor that is exactly zero
  return exact_orientation(a, b, c, d);
}

int orientation_along(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kErrorFactor = 3.4e-16;  // (3 + 16 eps) eps, rounded up
  const int s = (axis + 1) % 3, t = (axis + 2) % 3;
  const double left = (b[s] - a[s]) * (c[t] - a[t]), right = (b[t] - a[t]) * (c[s] - a[s]);
  const double det = left - right, permanent = std::abs(left) + std::abs(right);
  if (std::abs(det) > kErrorFactor * permanent) return det > 0 ? 1 : -1;
  if (permanent == 0) return 0;
  const Expansion e = product(difference(b[s], a[s]), difference(c[t], a[t]));
  const Expansion f = product(difference(b[t], a[t]), difference(c[s], a[s]));
  return sum(e, negated(f)).sign();
}

}  // namespace mesamis::detail::surface
