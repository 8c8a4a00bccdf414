// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

/// Spectral functions of symmetric 3x3 matrices.
namespace mesamis::detail::base {

/// A symmetric matrix in single precision, xx xy xz yy yz zz: for fields on every voxel.
using PackedSym3 = std::array<float, 6>;

/// Rounds a matrix of any unit to single precision.
inline PackedSym3 pack(const Sym3& a) noexcept {
  return {static_cast<float>(a.xx), static_cast<float>(a.xy), static_cast<float>(a.xz),
          static_cast<float>(a.yy), static_cast<float>(a.yz), static_cast<float>(a.zz)};
}
/// Converts a matrix of any unit to double precision, without rounding: the inverse of pack().
inline Sym3 unpack(const PackedSym3& a) noexcept { return {a[0], a[1], a[2], a[3], a[4], a[5]}; }

/// Eigenpairs, largest eigenvalue first; the vectors are orthonormal.
struct SymEigen {
  std::array<double, 3> values;
  std::array<Vec3, 3> vectors;
};

/// Decomposes a symmetric matrix. The error of each eigenvalue is relative to the largest.
/// @param a  finite, of any unit.
/// @return values in the unit of a; vectors of no unit.
///
/// O(1), iterative.
SymEigen eigen_decompose(const Sym3& a);

/// Composes a matrix from eigenpairs: sum_i value_i v_i v_i^T.
/// @param values   of any unit.
/// @param vectors  orthonormal, no unit.
/// @return in the unit of the values.
Sym3 compose(const std::array<double, 3>& values, const std::array<Vec3, 3>& vectors);

/// The matrix logarithm of a symmetric positive definite matrix.
/// @param a  numbers in any unit; the unit must be known to whoever applies exp_sym().
/// @return infinite or NaN where an eigenvalue is not positive.
Sym3 log_spd(const Sym3& a);

/// The matrix exponential of a symmetric matrix; the inverse of log_spd(). Needs no eigenvectors:
/// scaling and squaring of a Taylor polynomial, after the trace is taken out.
/// @param a  finite; no unit.
/// @return positive definite; numbers in the unit that log_spd() was given.
Sym3 exp_sym(const Sym3& a);

/// The inverse of a matrix, by cofactors.
/// @param a  invertible, of any unit.
/// @return in the reciprocal of that unit; infinite or NaN where the determinant is zero.
Sym3 inverse(const Sym3& a);

}  // namespace mesamis::detail::base
