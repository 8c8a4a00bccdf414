// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/picture/ticks.h"

namespace mesamis::detail::picture {
namespace {

struct Range {
  double lo, hi;
};

/// Adds a margin on each side, but none beyond zero.
Range with_margin(const Range& range) {
  constexpr double kMargin = 0.04;
  const double size = std::max(std::abs(range.lo), std::abs(range.hi));
  if (size == 0) return {0, 1};
  const double extent = range.hi - range.lo;
  const bool has_extent = extent > 1e-12 * size;
  const double margin = has_extent ? kMargin * extent : std::max(0.5, 0.5 * size);
  return {range.lo == 0 ? 0 : range.lo - margin, range.hi == 0 ? 0 : range.hi + margin};
}

Range linear_range(const std::vector<double>& values, bool include_zero) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  if (!include_zero) return with_margin({*least, *greatest});
  return with_margin({std::min(0.0, *least), std::max(0.0, *greatest)});
}

Range log_range(const std::vector<double>& values) {
  constexpr double kMargin = 1.5;
  double lo = std::numeric_limits<double>::infinity(), hi = 0;
  for (const double value : values) {
    if (value > 0) lo = std::min(lo, value), hi = std::max(hi, value);
  }
  if (hi == 0) throw InputError("plot: expected a positive value for a logarithmic axis");
  return {lo / kMargin, hi * kMargin};
}

bool are_whole(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return x == std::floor(x); });
}

/// @param whole  no ticks between whole numbers.
void add_linear_ticks(Axis& axis, int count, bool whole) {
  Ticks ticks = round_ticks(axis.lo, axis.hi, count);
  if (whole && ticks.step < 1) {
    ticks = {std::ceil(axis.lo), 1, 1 + static_cast<int>(std::floor(axis.hi) - std::ceil(axis.lo))};
  }
  for (int i = 0; i < ticks.count; ++i) axis.ticks.push_back(ticks.at(i));
  axis.labels = tick_labels(axis.ticks, ticks.step);
}

/// 1, 2 and 5 times powers of ten, or every power, or every second one, and so on.
void add_log_ticks(Axis& axis, int count) {
  const double decades = std::log10(axis.hi / axis.lo);
  const bool between = 3 * decades <= count;
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / count)));
  const int last = static_cast<int>(std::floor(std::log10(axis.hi)));
  for (int e = static_cast<int>(std::floor(std::log10(axis.lo))); e <= last; ++e) {
    if (e % stride != 0) continue;
    const double power = std::pow(10.0, e);
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * power;
      if (tick < axis.lo || tick > axis.hi || (factor > 1 && !between)) continue;
      axis.ticks.push_back(tick);
      axis.labels.push_back(tick_labels({tick}, power)[0]);
    }
  }
}

}  // namespace

double Axis::share(double value) const {
  if (!log_scale) return (value - lo) / (hi - lo);
  return (std::log10(std::max(value, lo)) - std::log10(lo)) / (std::log10(hi) - std::log10(lo));
}

Axis make_axis(const std::vector<double>& values, const AxisOptions& options) {
  const Range range =
      options.log_scale ? log_range(values) : linear_range(values, options.include_zero);
  Axis axis{range.lo, range.hi, options.log_scale, {}, {}};
  const bool less_than_a_decade = range.hi < 10 * range.lo;
  if (options.log_scale && !less_than_a_decade) {
    add_log_ticks(axis, options.tick_count);
  } else {
    add_linear_ticks(axis, options.tick_count, !options.log_scale && are_whole(values));
  }
  if (axis.ticks.empty()) {  // no round number lies on a short axis with few ticks
    axis.ticks.push_back(axis.lo);
    axis.labels.push_back(tick_labels({axis.lo}, axis.hi - axis.lo)[0]);
  }
  return axis;
}

}  // namespace mesamis::detail::picture
