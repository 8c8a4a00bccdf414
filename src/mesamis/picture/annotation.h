// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mesamis/picture/color_scale.h"
#include "mesamis/picture/scene.h"

/// Text, scale bar and colour bar over a picture, in pixels from the lower left corner.
namespace mesamis::detail::picture {

enum class Align { kLeft, kCenter, kRight };

struct Label {
  std::string text;
  std::array<double, 2> at{0, 0};  ///< left, centre or right end of the text, half its height
  Align align = Align::kLeft;
  double height = 17;  ///< font size, in units of the scene
  bool bold = false;
};
void add_label(Scene& scene, const Label& label);

/// Adds a line of text in the lower left corner.
void add_corner_label(Scene& scene, const std::string& text);

/// Adds a bar of a round length, labelled in mm, in the lower right corner.
void add_scale_bar(Scene& scene);

/// Adds a mark with its text at a side of a picture.
/// @param at     where the mark touches the side.
/// @param below  the mark goes down from there and the text stands below; else to the left.
void add_tick(Scene& scene, const std::array<double, 2>& at, bool below, const std::string& text);

struct ColorBar {
  std::string title;
  ValueRange range;                   ///< values at its lower and upper end
  Colour (*color)(double) = viridis;  ///< of a share of the range, 0 to 1
};
/// Adds a vertical colour bar with labelled ticks at the right edge, within kColorBarMargin.
void add_color_bar(Scene& scene, const ColorBar& bar);
inline constexpr double kColorBarMargin = 0.17;

/// At most four significant digits, without trailing zeros.
std::string short_number(double value);

}  // namespace mesamis::detail::picture
