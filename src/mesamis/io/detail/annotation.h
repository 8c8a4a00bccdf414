// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mesamis/io/detail/color_scale.h"
#include "mesamis/io/detail/scene.h"

/// What is written and drawn flat over a picture, in rendered pixels from the lower left corner.
namespace mesamis::detail {

enum class Align { kLeft, kCenter, kRight };

struct Label {
  std::string text;
  std::array<double, 2> at{0, 0};  ///< of the text's vertical middle
  Align align = Align::kLeft;
  double height = 17;  ///< letters, in units of the scene
  bool bold = false;
};
void add_label(Scene& scene, const Label& label);

/// A bar of a round length and that length, in the lower right corner.
void add_scale_bar(Scene& scene);

struct ColorBar {
  std::string title;
  ValueRange range;
  Rgb (*color)(double) = viridis;
};
/// A vertical bar at the right edge; it needs kColorBarMargin there.
void add_color_bar(Scene& scene, const ColorBar& bar);
inline constexpr double kColorBarMargin = 0.17;

/// 3 significant digits or what the step needs, no needless zeros.
std::string short_number(double value);

}  // namespace mesamis::detail
