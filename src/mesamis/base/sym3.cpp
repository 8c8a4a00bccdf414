// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/sym3.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mesamis::detail::base {
namespace {

/// Product of two symmetric matrices that commute, so that it is symmetric too.
Sym3 commuting_product(const Sym3& a, const Sym3& b) {
  return {a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, a.xx * b.xy + a.xy * b.yy + a.xz * b.yz,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.xy * b.xy + a.yy * b.yy + a.yz * b.yz,
          a.xy * b.xz + a.yy * b.yz + a.yz * b.zz, a.xz * b.xz + a.yz * b.yz + a.zz * b.zz};
}

double largest_entry(const Sym3& a) {
  return std::max({std::abs(a.xx), std::abs(a.xy), std::abs(a.xz), std::abs(a.yy), std::abs(a.yz),
                   std::abs(a.zz)});
}

}  // namespace

SymEigen eigen_decompose(const Sym3& a) {
  Eigen::Matrix3d m;
  m << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
  SymEigen result;
  for (int i = 0; i < 3; ++i) {
    const int ascending = 2 - i;
    const auto v = solver.eigenvectors().col(ascending);
    result.values[static_cast<std::size_t>(i)] = solver.eigenvalues()(ascending);
    result.vectors[static_cast<std::size_t>(i)] = {v(0), v(1), v(2)};
  }
  return result;
}

Sym3 compose(const std::array<double, 3>& values, const std::array<Vec3, 3>& vectors) {
  return values[0] * outer(vectors[0]) + values[1] * outer(vectors[1]) +
         values[2] * outer(vectors[2]);
}

Sym3 log_spd(const Sym3& a) {
  SymEigen e = eigen_decompose(a);
  for (double& value : e.values) value = std::log(value);
  return compose(e.values, e.vectors);
}

Sym3 exp_sym(const Sym3& a) {
  // Taylor to degree 8 on entries of at most 1/16, in the form of Paterson and Stockmeyer: four
  // products instead of eight. This is where a remesher spends a third of its time.
  const double mean = trace(a) / 3;
  Sym3 x = a - mean * kIdentity3;
  int squarings = 0;
  for (double size = largest_entry(x); size > 0.0625 && squarings < 30; size /= 2) ++squarings;
  x = std::ldexp(1.0, -squarings) * x;
  const Sym3 x2 = commuting_product(x, x);
  const Sym3 x3 = commuting_product(x2, x);
  auto quadratic = [&](double c0, double c1, double c2) {
    return c0 * kIdentity3 + c1 * x + c2 * x2;
  };
  Sym3 r = quadratic(1.0 / 720, 1.0 / 5040, 1.0 / 40320);
  r = commuting_product(r, x3) + quadratic(1.0 / 6, 1.0 / 24, 1.0 / 120);
  r = commuting_product(r, x3) + quadratic(1, 1, 0.5);
  for (int s = 0; s < squarings; ++s) r = commuting_product(r, r);
  return std::exp(mean) * r;
}

Sym3 inverse(const Sym3& a) {
  const double d = 1 / determinant(a);
  return {d * (a.yy * a.zz - a.yz * a.yz), d * (a.xz * a.yz - a.xy * a.zz),
          d * (a.xy * a.yz - a.yy * a.xz), d * (a.xx * a.zz - a.xz * a.xz),
          d * (a.xy * a.xz - a.xx * a.yz), d * (a.xx * a.yy - a.xy * a.xy)};
}

}  // namespace mesamis::detail::base
