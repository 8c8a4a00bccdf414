// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/base/types.h"

/// Spectral functions of symmetric 3x3 matrices.
namespace mesamis {

/// A symmetric matrix in single precision, xx xy xz yy yz zz: for fields on every voxel.
using PackedSym3 = std::array<float, 6>;

inline PackedSym3 pack(const Sym3& a) {
  return {static_cast<float>(a.xx), static_cast<float>(a.xy), static_cast<float>(a.xz),
          static_cast<float>(a.yy), static_cast<float>(a.yz), static_cast<float>(a.zz)};
}
inline Sym3 unpack(const PackedSym3& a) { return {a[0], a[1], a[2], a[3], a[4], a[5]}; }

/// Eigenpairs, largest eigenvalue first; the vectors are orthonormal.
struct SymEigen {
  std::array<double, 3> values;
  std::array<Vec3, 3> vectors;
};

/// Any finite symmetric matrix; relative accuracy is that of the largest eigenvalue.
SymEigen eigen_decompose(const Sym3& a);

/// sum_i value_i v_i v_i^T
Sym3 compose(const std::array<double, 3>& values, const std::array<Vec3, 3>& vectors);

/// Matrix logarithm of a symmetric positive definite matrix.
Sym3 log_spd(const Sym3& a);

/// Matrix exponential of a symmetric matrix; the inverse of log_spd. Needs no eigenvectors:
/// scaling and squaring of a Taylor polynomial, after the trace is taken out.
Sym3 exp_sym(const Sym3& a);

/// Inverse of an invertible matrix.
Sym3 inverse(const Sym3& a);

}  // namespace mesamis
