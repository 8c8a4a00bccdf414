// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "mesamis/rooms.h"

namespace mesamis::detail::picture {

struct AxisOptions {
  bool log_scale = false;
  bool include_zero = false;  ///< of a linear axis
  int tick_count = 8;         ///< about so many ticks; >= 1
};

/// The range of an axis and its ticks.
struct Axis {
  double lo = 0, hi = 1;  ///< lo < hi; 0 < lo on a logarithmic axis
  bool log_scale = false;
  std::vector<double> ticks;        ///< ascending, within the range
  std::vector<std::string> labels;  ///< one per tick

  /// Where a value lies along the axis: 0 at lo, 1 at hi. What is not positive lies at lo of a
  /// logarithmic axis.
  double share(double value) const;
};

/// Fits an axis to values as plot_svg() describes it.
/// @param values  0, or of a magnitude from 1e-300 to 1e300; at least one.
/// @throws InputError  if the axis is logarithmic and no value is positive.
Axis make_axis(const std::vector<double>& values, const AxisOptions& options);

}  // namespace mesamis::detail::picture
