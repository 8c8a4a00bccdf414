// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/text.h"

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesamis/picture/fonts.h"

namespace mesamis::detail::picture {
namespace {

constexpr int kReplacement = 0xFFFD;

struct Character {
  int code = kReplacement;
  std::size_t bytes = 1;
};

/// The first character of a text that is not empty; what is not UTF-8 counts byte by byte.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return {};
  int code = lead & (0x7F >> length);
  for (std::size_t n = 1; n < length; ++n) {
    if ((byte(n) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(n) & 0x3F);
  }
  return {code, length};
}

class Font {
 public:
  explicit Font(const Lettering& lettering) : colour_(lettering.colour) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(font_bytes(lettering.bold).data());
    stbtt_InitFont(&info_, bytes, 0);
    scale_ = stbtt_ScaleForMappingEmToPixels(&info_, static_cast<float>(lettering.height));
  }

  const stbtt_fontinfo& info() const { return info_; }
  float scale() const { return scale_; }
  const Colour& colour() const { return colour_; }
  /// Half the height of a capital, pixels.
  double half_capital() const {
    int left = 0, low = 0, right = 0, high = 0;
    stbtt_GetCodepointBox(&info_, 'H', &left, &low, &right, &high);
    return 0.5 * static_cast<double>(scale_) * high;
  }

  /// Calls visit(glyph, x) for each letter, x being the pixels from the start to its origin.
  /// @return the width of the text.
  template <class Visit>
  double walk(std::string_view text, const Visit& visit) const {
    double x = 0;
    int before = 0;
    while (!text.empty()) {
      const Character character = first_character(text);
      text.remove_prefix(character.bytes);
      const int glyph = stbtt_FindGlyphIndex(&info_, character.code);
      if (before != 0) {
        x += static_cast<double>(scale_) * stbtt_GetGlyphKernAdvance(&info_, before, glyph);
      }
      visit(glyph, x);
      int advance = 0, bearing = 0;
      stbtt_GetGlyphHMetrics(&info_, glyph, &advance, &bearing);
      x += static_cast<double>(scale_) * advance;
      before = glyph;
    }
    return x;
  }

 private:
  stbtt_fontinfo info_{};
  float scale_ = 1;
  Colour colour_;
};

/// The bounds of a letter whose origin lies so far within a pixel: left, top, right, bottom.
std::array<int, 4> bounds_of(const Font& font, int glyph, const std::array<float, 2>& within) {
  std::array<int, 4> b{};
  stbtt_GetGlyphBitmapBoxSubpixel(&font.info(), glyph, font.scale(), font.scale(), within[0],
                                  within[1], &b[0], &b[1], &b[2], &b[3]);
  return b;
}

/// @param origin  of the letter on its base line.
void draw_glyph(Raster& on, const Font& font, int glyph, const Place& origin) {
  const Place whole{std::floor(origin[0]), std::floor(origin[1])};
  const std::array<float, 2> within{static_cast<float>(origin[0] - whole[0]),
                                    static_cast<float>(origin[1] - whole[1])};
  const auto [left, top, right, bottom] = bounds_of(font, glyph, within);
  const int width = right - left, height = bottom - top;
  if (width <= 0 || height <= 0) return;
  const auto columns = static_cast<std::size_t>(width);
  std::vector<unsigned char> covered(columns * static_cast<std::size_t>(height));
  stbtt_MakeGlyphBitmapSubpixel(&font.info(), covered.data(), width, height, width, font.scale(),
                                font.scale(), within[0], within[1], glyph);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double x = whole[0] + left + column, y = whole[1] + top + row;
      const double share =
          covered[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] /
          255.0;
      if (share == 0 || x < 0 || y < 0 || x >= on.width || y >= on.height) continue;
      mix(on, {static_cast<int>(x), static_cast<int>(y)}, font.colour(), share);
    }
  }
}

}  // namespace

double text_width(std::string_view text, const Lettering& lettering) {
  return Font(lettering).walk(text, [](int, double) {});
}

void draw_text(Raster& on, const Place& start, std::string_view text, const Lettering& lettering) {
  const Font font(lettering);
  const double base = start[1] + font.half_capital();
  font.walk(text, [&](int glyph, double x) { draw_glyph(on, font, glyph, {start[0] + x, base}); });
}

}  // namespace mesamis::detail::picture
