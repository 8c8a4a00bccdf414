// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "mesamis/adapt/estimator.h"

namespace mesamis::detail::adapt {

/// A cell's gradients of u and v, side by side: one instruction serves both.
struct PairedGradients {
  Eigen::Array2d x, y, z;

  PairedGradients() = default;
  PairedGradients(const Vec3& u, const Vec3& v) : x(u.x, v.x), y(u.y, v.y), z(u.z, v.z) {}
  Vec3 u() const { return {x[0], y[0], z[0]}; }
  Vec3 v() const { return {x[1], y[1], z[1]}; }
};

/// Sets the jumps across face i of a cell whose own gradients are set.
/// @param beyond  of the cell across the face; null on the boundary, where the jump is twice the
///                normal derivative: the face is shared by nobody.
inline void set_jumps(std::size_t i, const Vec3& normal, const PairedGradients* beyond,
                      CellData& data) {
  const Vec3 jump_u = beyond ? data.grad_u - beyond->u() : 2.0 * data.grad_u;
  const Vec3 jump_v = beyond ? data.grad_v - beyond->v() : 2.0 * data.grad_v;
  data.jump_u[i] = std::abs(dot(jump_u, normal));
  data.jump_v[i] = std::abs(dot(jump_v, normal));
}

/// What a patch adds up: gradients and their outer products, each with its cell's weight.
class PairedSums {
 public:
  /// Of weight one, without the products: on grids this is the innermost loop.
  void add(const PairedGradients& g) {
    ++weights_;
    x_ += g.x, y_ += g.y, z_ += g.z;
    xx_ += g.x * g.x, xy_ += g.x * g.y, xz_ += g.x * g.z;
    yy_ += g.y * g.y, yz_ += g.y * g.z, zz_ += g.z * g.z;
  }
  void add(const PairedGradients& g, double weight) {
    weights_ += weight;
    x_ += weight * g.x, y_ += weight * g.y, z_ += weight * g.z;
    xx_ += weight * (g.x * g.x), xy_ += weight * (g.x * g.y), xz_ += weight * (g.x * g.z);
    yy_ += weight * (g.y * g.y), yz_ += weight * (g.y * g.z), zz_ += weight * (g.z * g.z);
  }

  /// The sums of other cells.
  void add(const PairedSums& other) {
    weights_ += other.weights_;
    x_ += other.x_, y_ += other.y_, z_ += other.z_;
    xx_ += other.xx_, xy_ += other.xy_, xz_ += other.xz_;
    yy_ += other.yy_, yz_ += other.yz_, zz_ += other.zz_;
  }

  PatchSums of_u(double volume_per_weight = 1) const { return of(0, volume_per_weight); }
  PatchSums of_v(double volume_per_weight = 1) const { return of(1, volume_per_weight); }

 private:
  PatchSums of(int field, double scale) const {
    const Vec3 gradient{x_[field], y_[field], z_[field]};
    const Sym3 outer_product{xx_[field], xy_[field], xz_[field],
                             yy_[field], yz_[field], zz_[field]};
    return {scale * weights_, scale * gradient, scale * outer_product};
  }

  double weights_ = 0;
  Eigen::Array2d x_{0, 0}, y_{0, 0}, z_{0, 0};
  Eigen::Array2d xx_{0, 0}, xy_{0, 0}, xz_{0, 0}, yy_{0, 0}, yz_{0, 0}, zz_{0, 0};
};

}  // namespace mesamis::detail::adapt
