// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::body {

/// Visits points spread evenly over a triangle, its corners among them.
/// @param corners   any unit.
/// @param distance  of neighbours along the sides, at most, same unit, > 0; a side has at most 1000.
/// @param visit     gets the point and the weights of the corners.
template <class Visit>
void visit_lattice(const std::array<Vec3, 3>& corners, double distance, Visit&& visit) {
  constexpr double kMostSteps = 1000;
  const auto& [a, b, c] = corners;
  const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
  const int n = static_cast<int>(std::ceil(std::clamp(longest / distance, 1.0, kMostSteps)));
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      const double u = double(i) / n, v = double(j) / n, w = 1 - u - v;
      visit(w * a + u * b + v * c, std::array{w, u, v});
    }
  }
}

}  // namespace mesamis::detail::body
