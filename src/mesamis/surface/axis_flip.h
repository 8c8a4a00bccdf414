// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

/// Finds out whether two surfaces lie in one frame. Files of one object in LPS and in RAS look
/// alike, but the distances between them mean nothing.
namespace mesamis::detail::surface {

/// Axes exchanged and negated: coordinate i becomes sign[i] times coordinate axis[i].
struct AxisFlip {
  std::array<int, 3> axis{0, 1, 2};  ///< a permutation
  std::array<int, 3> sign{1, 1, 1};  ///< 1 or -1 each
  /// The point with its coordinates exchanged and negated, in the unit of p (mm).
  Vec3 operator()(const Vec3& p) const noexcept;
  friend bool operator==(const AxisFlip&, const AxisFlip&) = default;
};

/// Between LPS and RAS, both ways: x and y negated.
inline constexpr AxisFlip kLpsRas{{0, 1, 2}, {-1, -1, 1}};

/// The flip as text: "(-x, -y, z)".
std::string to_string(const AxisFlip& flip);

/// How badly two boxes fit: the greater of the distances between their lower and between their
/// upper corners, divided by the longer diagonal.
/// @param a, b  mm.
/// @return no unit; 0 for equal boxes, else > 0.
double box_misfit(const Box& a, const Box& b);

/// A surface that lies on the reference after a flip, and not as it is.
struct FlipFound {
  AxisFlip flip;                   ///< of the surface
  Box reference, surface;          ///< bounding boxes as given, mm
  double misfit = 0;               ///< of the boxes as given, see box_misfit()
  double flipped_misfit = 0;       ///< after the flip
  double distance_mm = 0;          ///< between the surfaces as given, from samples
  double flipped_distance_mm = 0;  ///< after the flip
  /// Whether the boxes as given are so far apart (misfit above 0.2) that distances mean nothing.
  bool plain = false;
};

/// Looks for a flip of the surface's axes that explains why it does not lie on the reference.
///
/// A flip is found if all of these hold: the boxes as given do not fit (misfit above 0.02); after
/// the flip their misfit is at most half; and the distance between the surfaces is at most a
/// quarter, and less than 5 % of the longer diagonal. The distance is the mean one of 1000 points,
/// even by area, of one surface to the other, in the direction in which it is less, so that a part
/// fits into its whole. Two flips are tried: LPS to RAS and, of all 47 flips, the one whose boxes
/// fit best. The second is preferred only if it halves the distance of the first.
///
/// @param reference, surface  mm.
/// @return none for surfaces that can be compared as they are, or if no flip is found.
/// @throws InputError  if a surface is not sound or has no area.
///
/// O(m log m) for m triangles of both.
std::optional<FlipFound> find_axis_flip(const TriMesh& reference, const TriMesh& surface);

}  // namespace mesamis::detail::surface
