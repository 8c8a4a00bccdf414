// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {

/// A Kuhn box mesh whose inner points are moved at random by up to `amount` of the spacing.
inline TetMesh perturbed_box(const Box& box, const std::array<Index, 3>& n, double amount,
                             unsigned seed = 1) {
  TetMesh mesh = box_mesh(box, n);
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-amount, amount);
  const Vec3 extent = box.extent();
  for (Vec3& p : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) {
      const double shift = uniform(generator) * extent[axis] / n[axis];
      if (p[axis] != box.lo[axis] && p[axis] != box.hi[axis]) p[axis] += shift;
    }
  }
  return mesh;
}

}  // namespace mesamis
