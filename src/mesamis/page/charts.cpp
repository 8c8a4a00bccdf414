// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/charts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "mesamis/image/grey_values.h"
#include "mesamis/page/figures.h"
#include "mesamis/picture/plot.h"

namespace mesamis::detail::page {
namespace {

using nlohmann::json;

constexpr std::array<int, 2> kSize{760, 420};

/// Without the declaration of a file of its own.
std::string inline_svg(const std::vector<PlotSeries>& series, const PlotOptions& options) {
  const std::string file = plot_svg(series, options);
  return file.substr(file.find("<svg"));
}

/// Whether a value is a number that an axis can hold: no greater than a sample, which has single
/// precision. Differences of greater ones may not be finite.
bool can_be_drawn(const json& value) {
  return value.is_number() && std::abs(value.get<double>()) <= std::numeric_limits<float>::max();
}

/// Outlines of bars: counts over values.
PlotSeries bars_of(const VolumeView& scan, double low, double high, const std::string& name) {
  constexpr std::size_t kBars = 160;
  std::vector<double> counts(kBars, 0);
  for (const float sample : scan.samples) {
    const double share = (sample - low) / (high - low);
    if (!(share >= 0 && share <= 1)) continue;
    ++counts[std::min(static_cast<std::size_t>(share * kBars), kBars - 1)];
  }
  PlotSeries series{name, {}, {}, false};
  for (std::size_t n = 0; n < kBars; ++n) {
    const double width = (high - low) / kBars, left = low + static_cast<double>(n) * width;
    series.x.insert(series.x.end(), {left, left + width});
    series.y.insert(series.y.end(), {std::max(counts[n], 1.0), std::max(counts[n], 1.0)});
  }
  return series;
}

/// An upright line from 1 to the greatest count.
PlotSeries mark_at(const std::string& name, double x, double top) {
  return {name, {x, x}, {1, top}, false};
}

void add_mark(std::vector<PlotSeries>& series, const std::string& name, const json& value,
              double top) {
  if (can_be_drawn(value)) series.push_back(mark_at(name, value.get<double>(), top));
}

/// The values of an entry of the passes, those that were measured; passes count from 1.
PlotSeries over_passes(const json& report, const std::string& name, const char* pointer) {
  PlotSeries series{name, {}, {}, true};
  double pass = 0;
  for (const json& iteration : entry(report, "/iterations")) {
    ++pass;
    const json& value = entry(iteration, pointer);
    if (!can_be_drawn(value)) continue;
    series.x.push_back(pass);
    series.y.push_back(value.get<double>());
  }
  return series;
}

std::string pass_diagram(const std::vector<PlotSeries>& series, const std::string& title,
                         const std::string& unit) {
  const bool enough =
      std::any_of(series.begin(), series.end(), [](const PlotSeries& s) { return s.x.size() > 1; });
  if (!enough) return {};
  return inline_svg(series, {kSize, title, "pass", unit});
}

}  // namespace

std::string histogram_svg(const VolumeView& scan, const json& report) {
  const auto ends = quantiles(scan.samples, {0.0005, 0.9995});
  const json &window = entry(report, "/grey/window_native"),
             &threshold = entry(report, "/settings/threshold"),
             &level = entry(report, "/surface/level_native");
  double low = ends[0], high = ends[1];
  for (const json& value : {window, threshold, level}) {
    for (const json& number : value.is_array() ? value : json::array({value})) {
      if (!can_be_drawn(number)) continue;
      low = std::min(low, number.get<double>());
      high = std::max(high, number.get<double>());
    }
  }
  if (!(high > low)) high = low + 1;
  std::vector<PlotSeries> series{bars_of(scan, low, high, "voxels")};
  const double top = *std::max_element(series[0].y.begin(), series[0].y.end());
  if (window.is_array() && window.size() == 2) {
    add_mark(series, "window, low", window[0], top);
    add_mark(series, "window, high", window[1], top);
  }
  add_mark(series, "threshold", threshold, top);
  add_mark(series, "level", level, top);
  PlotOptions options{kSize, "Values of the scan", "value, " + native_unit(report), "voxels"};
  options.log_y = true;
  return inline_svg(series, options);
}

std::string energy_svg(const json& report) {
  return pass_diagram({over_passes(report, "energy", "/energy_parts/total"),
                       over_passes(report, "fidelity", "/energy_parts/fidelity"),
                       over_passes(report, "smoothing", "/energy_parts/smoothing"),
                       over_passes(report, "edge", "/energy_parts/edge")},
                      "Energy of each pass", "energy");
}

std::string cells_svg(const json& report) {
  return pass_diagram({over_passes(report, "tetrahedra", "/tets")}, "Size of each mesh",
                      "tetrahedra");
}

std::string movement_svg(const json& report) {
  return pass_diagram({over_passes(report, "movement", "/surface_change_mm"),
                       over_passes(report, "bound to end", "/surface_tolerance_mm")},
                      "Movement of the surface", "mm");
}

}  // namespace mesamis::detail::page
