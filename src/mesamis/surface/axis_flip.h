// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/surface/tri_mesh.h"

/// Do two surfaces lie in one frame? Files of one object in LPS and in RAS look alike, and every
/// distance between them is nonsense.
namespace mesamis {

/// Axes exchanged and negated: coordinate i becomes sign[i] times coordinate axis[i].
struct AxisFlip {
  std::array<int, 3> axis{0, 1, 2};  ///< a permutation
  std::array<int, 3> sign{1, 1, 1};  ///< 1 or -1 each
  Vec3 operator()(const Vec3& p) const;
  friend bool operator==(const AxisFlip&, const AxisFlip&) = default;
};

/// Between LPS and RAS, both ways: x and y negated.
inline constexpr AxisFlip kLpsRas{{0, 1, 2}, {-1, -1, 1}};

/// "(-x, -y, z)"
std::string to_string(const AxisFlip& flip);

/// How badly two boxes fit: the greater of the distances between their lower and between their
/// upper corners, in shares of the longer diagonal. 0 for equal ones, else > 0.
double box_misfit(const Box& a, const Box& b);

/// A surface that lies on the reference after a flip, and not as it is.
struct FlipFound {
  AxisFlip flip;                   ///< of the surface
  Box reference, surface;          ///< bounding boxes as given, mm
  double misfit = 0;               ///< of the boxes as given, see box_misfit()
  double flipped_misfit = 0;       ///< after the flip
  double distance_mm = 0;          ///< between the surfaces as given, from samples
  double flipped_distance_mm = 0;  ///< after the flip
  /// Whether the boxes are so far apart as given (misfit above 0.2) that distances say nothing.
  bool plain = false;
};

/// Looks for a flip of the surface's axes that explains why it does not lie on the reference.
///
/// Found if all of these hold: the boxes as given do not fit (misfit above 0.02); after the flip
/// they fit twice as well at least; and after it the surfaces themselves are four times as near,
/// and nearer than 5 % of the longer diagonal. How near is the mean distance of 1000 points, even
/// by area, of one to the other, in the direction in which it is less, so that a part fits into
/// its whole. Tried are LPS to RAS and, of all 47 flips, that whose boxes fit best, which is
/// preferred only if it brings the surfaces twice as near as LPS to RAS does.
///
/// @return none for surfaces that can be compared as they are, or that no flip helps.
/// @throws InputError  if a surface is not sound or has no area.
std::optional<FlipFound> find_axis_flip(const TriMesh& reference, const TriMesh& surface);

}  // namespace mesamis
