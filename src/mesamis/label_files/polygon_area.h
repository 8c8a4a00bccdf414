// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

/// How much of each pixel lies inside of a polygon.
namespace mesamis::detail::label_files {

/// A point in a plane of pixels: pixel (i, j) is the square of side 1 around (i, j).
struct PlanePoint {
  double x = 0, y = 0;
};

/// A rectangle of pixels.
struct PixelWindow {
  Index left = 0, top = 0;      ///< of the first pixel
  Index columns = 0, rows = 0;  ///< 0: none
  std::size_t pixels() const noexcept {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
};

/// The pixels of a plane that a polygon may touch. O(points).
/// @param plane  the result is cut off at it.
PixelWindow window_of(std::span<const PlanePoint> polygon, const PixelWindow& plane);

/// The share of each pixel's area that lies inside of a closed polygon, exact to rounding. Inside
/// is where the winding number is not 0, which leaves open the hole of a polygon that goes around
/// it in the other direction (keyhole); where the polygon overlaps itself within one pixel the
/// share may be too large, up to 1.
/// @param polygon  the last point is joined to the first.
/// @return 0 to 1 for each pixel of the window, row by row.
///
/// O(pixels of the window + pixels that the edges cross).
std::vector<float> pixel_shares(std::span<const PlanePoint> polygon, const PixelWindow& window);

}  // namespace mesamis::detail::label_files
