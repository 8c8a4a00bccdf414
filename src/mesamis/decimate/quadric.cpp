// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/quadric.h"

#include <Eigen/Dense>

namespace mesamis::detail::decimate {

Vec3 minimum(const Quadric& q, const Vec3& near, double pull, const std::array<bool, 3>& stays) {
  const double w = pull * q.weight;
  if (!(w > 0)) return near;
  Eigen::Matrix3d a;
  a << q.xx + w, q.xy, q.xz, q.xy, q.yy + w, q.yz, q.xz, q.yz, q.zz + w;
  const Vec3 down = q.linear - q.product(near);
  Eigen::Vector3d b(down.x, down.y, down.z);
  for (int axis = 0; axis < 3; ++axis) {
    if (!stays[static_cast<std::size_t>(axis)]) continue;
    a.row(axis).setZero();
    a.col(axis).setZero();
    a(axis, axis) = 1;
    b[axis] = 0;
  }
  const Eigen::Vector3d step = a.llt().solve(b);
  return near + Vec3{step[0], step[1], step[2]};
}

}  // namespace mesamis::detail::decimate
