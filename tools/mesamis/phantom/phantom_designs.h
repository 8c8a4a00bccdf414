// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

/// The phantoms in a box of their own, in mm, the origin in the middle of the box.
namespace mesamis::detail::phantom {

/// Between two planes across an axis, grid lines are denser.
struct FineSlab {
  int axis;
  double lo, hi, step;
};

struct PhantomDesign {
  const char* name;
  const char* description;
  std::array<Index, 3> size;  ///< of the box, mm
  double step;                ///< of the grid that tells the parts of the object from each other
  std::vector<FineSlab> fine;
  double (*inside)(const Vec3&);                ///< as Phantom::inside
  double (*grey)(const Vec3& p, double depth);  ///< null: kBone
  double constant_below = 0;                    ///< as Phantom::constant_below
};

inline constexpr double kBone = 230, kSoftTissue = 120;

const std::vector<PhantomDesign>& phantom_designs();

/// The bone that is too long for phantom_designs.cpp.
double hemipelvis_inside(const Vec3& p);
double hemipelvis_grey(const Vec3& p, double depth);

}  // namespace mesamis::detail::phantom
