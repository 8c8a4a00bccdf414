// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/ticks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace mesamis::detail::picture {
namespace {

constexpr const char* kMinus = "−";

/// The power of ten of a number's first digit; a little below a power counts as the power.
int exponent_of(double value) {
  return static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
}

/// Independent of the locale.
std::string with_decimals(double value, int decimals) {
  char text[400];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals);
  return {text, end.ptr};
}

/// "12345" becomes "12 345".
std::string grouped(std::string digits) {
  const std::size_t whole = std::min(digits.find('.'), digits.size());
  if (whole < 5) return digits;
  for (std::size_t at = whole; at > 3;) digits.insert(at -= 3, " ");
  return digits;
}

std::string superscript(int number) {
  constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number))) text += kDigits[digit - '0'];
  return text;
}

/// "2.5·10⁸" with digits down to the step.
std::string scientific(double size, double step) {
  const int exponent = exponent_of(size);
  const int decimals = std::clamp(exponent - exponent_of(step), 0, 15);
  const double mantissa = size / std::pow(10.0, exponent);
  return with_decimals(mantissa, decimals) + "·10" + superscript(exponent);
}

}  // namespace

Ticks round_ticks(double lo, double hi, int count) {
  const double least = (hi - lo) / count;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= 0.999 * least) step = factor * power;
  }
  Ticks ticks{std::ceil(lo / step - 1e-9) * step, step, 0};
  ticks.count = 1 + static_cast<int>(std::floor((hi - ticks.first) / step + 1e-9));
  return ticks;
}

std::vector<std::string> tick_labels(const std::vector<double>& ticks, double step) {
  constexpr double kLargest = 1e7, kFinest = 1e-5;
  double largest = 0;
  for (const double tick : ticks) largest = std::max(largest, std::abs(tick));
  const bool powers = largest >= 0.999999 * kLargest || step < 0.999999 * kFinest;
  std::vector<std::string> labels;
  for (const double tick : ticks) {
    const double size = std::abs(tick);
    const bool zero = size < 1e-6 * step;
    std::string& label = labels.emplace_back(tick < 0 && !zero ? kMinus : "");
    if (powers) {
      label += zero ? "0" : scientific(size, step);
    } else {
      label += grouped(with_decimals(zero ? 0 : size, std::max(0, -exponent_of(step))));
    }
  }
  return labels;
}

}  // namespace mesamis::detail::picture
