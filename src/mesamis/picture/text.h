// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "mesamis/picture/raster.h"

namespace mesamis::detail::picture {

/// How letters look.
struct Lettering {
  double height = 12;  ///< of the font: from one line to the next, pixels, > 0
  bool bold = false;
  Colour colour{};
};

/// The width of a line of text, pixels.
/// @param text  UTF-8; what is none, or has no letter in the font, is drawn as a box.
double text_width(std::string_view text, const Lettering& lettering);

/// Draws a line of text onto a coloured picture, from left to right.
/// @param start  the left end of the text, at half the height of a capital.
/// @param text   as of text_width().
void draw_text(Raster& on, const Place& start, std::string_view text, const Lettering& lettering);

}  // namespace mesamis::detail::picture
