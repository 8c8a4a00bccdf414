// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/annotation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mesamis/picture/text.h"
#include "mesamis/picture/ticks.h"

namespace mesamis::detail::picture {
namespace {

constexpr Colour kInk{40, 44, 52};

/// Fills an upright rectangle between two corners, in pixels from the lower left corner.
void fill(Scene& scene, const std::array<double, 2>& lo, const std::array<double, 2>& hi,
          const Colour& colour = kInk) {
  fill_rectangle(scene.canvas(), {scene.on_canvas(lo), scene.on_canvas(hi)}, colour);
}

/// The colours of a scale from below upwards, a row of pixels at a time.
void fill_scale(Scene& scene, const std::array<double, 2>& lo, const std::array<double, 2>& hi,
                Colour (*color)(double)) {
  for (double y = lo[1]; y < hi[1]; ++y) {
    const double top = std::min(y + 1, hi[1]);
    fill(scene, {lo[0], y}, {hi[0], top}, color(((y + top) / 2 - lo[1]) / (hi[1] - lo[1])));
  }
}

/// The largest 1, 2 or 5 times a power of ten that is not above the length.
double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  double result = power;
  for (const double factor : {2.0, 5.0}) {
    if (factor * power <= length) result = factor * power;
  }
  return result;
}

}  // namespace

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", std::abs(value) < 1e-12 ? 0 : value);
  return text;
}

void add_label(Scene& scene, const Label& label) {
  const Lettering lettering{label.height * scene.unit(), label.bold, kInk};
  Place start = scene.on_canvas(label.at);
  if (label.align != Align::kLeft) {
    const double width = text_width(label.text, lettering);
    start[0] -= label.align == Align::kCenter ? width / 2 : width;
  }
  draw_text(scene.canvas(), start, label.text, lettering);
}

void add_corner_label(Scene& scene, const std::string& text) {
  add_label(scene, {text, {28 * scene.unit(), 24 * scene.unit()}});
}

void add_scale_bar(Scene& scene) {
  const double unit = scene.unit();
  const double length = round_length(0.22 * scene.size()[0] * scene.mm_per_pixel());
  const double right = scene.size()[0] - 28 * unit;
  const double left = right - length / scene.mm_per_pixel();
  const double bottom = 22 * unit;
  fill(scene, {left, bottom}, {right, bottom + 3 * unit});
  for (const double end : {left, right - 3 * unit}) {
    fill(scene, {end, bottom - 4 * unit}, {end + 3 * unit, bottom + 7 * unit});
  }
  add_label(
      scene,
      {short_number(length) + " mm", {(left + right) / 2, bottom + 20 * unit}, Align::kCenter});
}

void add_tick(Scene& scene, const std::array<double, 2>& at, bool below, const std::string& text) {
  constexpr double kLength = 6, kHalfWidth = 0.75, kTextSize = 13;
  const double unit = scene.unit(), width = kHalfWidth * unit, length = kLength * unit;
  const auto [x, y] = at;
  if (below) {
    fill(scene, {x - width, y - length}, {x + width, y});
    add_label(scene, {text, {x, y - 15 * unit}, Align::kCenter, kTextSize});
  } else {
    fill(scene, {x - length, y - width}, {x, y + width});
    add_label(scene, {text, {x - 9 * unit, y}, Align::kRight, kTextSize});
  }
}

void add_color_bar(Scene& scene, const ColorBar& bar) {
  const double unit = scene.unit();
  const auto [width, height] = scene.size();
  const double left = width - 105 * unit, right = left + 22 * unit;
  // Whole pixels: then each row has one colour of the scale.
  const double bottom = std::round(0.22 * height), top = std::round(0.84 * height);
  fill(scene, {left - unit, bottom - unit}, {right + unit, top + unit});
  fill_scale(scene, {left, bottom}, {right, top}, bar.color);
  const Ticks ticks = round_ticks(bar.range.lo, bar.range.hi, 6);
  for (int i = 0; i < ticks.count; ++i) {
    const double value = ticks.at(i);
    const double y =
        bottom + (top - bottom) * (value - bar.range.lo) / (bar.range.hi - bar.range.lo);
    fill(scene, {right, y - 0.75 * unit}, {right + 6 * unit, y + 0.75 * unit});
    const bool zero = std::abs(value) < 1e-6 * ticks.step;
    add_label(scene, {short_number(zero ? 0 : value), {right + 11 * unit, y}});
  }
  add_label(scene, {bar.title, {(left + right) / 2, top + 24 * unit}, Align::kCenter, 18, true});
}

}  // namespace mesamis::detail::picture
