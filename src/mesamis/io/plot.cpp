// SPDX-License-Identifier: Apache-2.0
#include "mesamis/io/plot.h"

#include <vtkAutoInit.h>
#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/io/detail/annotation.h"
#include "mesamis/io/detail/color_scale.h"
#include "mesamis/io/detail/scene.h"

VTK_MODULE_INIT(vtkRenderingContextOpenGL2)

namespace mesamis {

using namespace detail;

namespace {

constexpr int kTitleSize = 20, kLabelSize = 17;  // letters, in units of the scene

void require_drawable(std::span<const PlotSeries> series) {
  std::size_t points = 0;
  for (const PlotSeries& s : series) {
    if (s.x.size() != s.y.size()) {
      throw InputError("plot: series '" + s.name + "': expected as many x as y, found " +
                       std::to_string(s.x.size()) + " and " + std::to_string(s.y.size()));
    }
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (!std::isfinite(s.x[i] + s.y[i])) {
        throw InputError("plot: series '" + s.name + "': point " + std::to_string(i) +
                         " is not finite");
      }
    }
    points += s.x.size();
  }
  if (points == 0) throw InputError("plot: nothing to draw, there are no points");
}

/// What an axis shows: all values, a little more where it does not begin at zero.
ValueRange padded(double lo, double hi) {
  const double room = hi > lo ? 0.04 * (hi - lo) : std::max(0.5, 0.5 * std::abs(hi));
  return {lo - room, hi + room};
}

ValueRange range_of_x(std::span<const PlotSeries> series) {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for (const PlotSeries& s : series) {
    for (const double x : s.x) lo = std::min(lo, x), hi = std::max(hi, x);
  }
  const ValueRange range = padded(lo, hi);
  return lo == 0 ? ValueRange{0, range.hi} : range;
}

ValueRange range_of_y(std::span<const PlotSeries> series) {
  double lo = 0, hi = -std::numeric_limits<double>::infinity();
  for (const PlotSeries& s : series) {
    for (const double y : s.y) lo = std::min(lo, y), hi = std::max(hi, y);
  }
  if (lo == 0 && hi == 0) return {0, 1};
  const ValueRange range = padded(lo, std::max(0.0, hi));
  return {lo == 0 ? 0 : range.lo, hi <= 0 ? 0 : range.hi};
}

/// From below the least positive value to above the greatest.
ValueRange log_range_of_y(std::span<const PlotSeries> series) {
  double lo = std::numeric_limits<double>::infinity(), hi = 0;
  for (const PlotSeries& s : series) {
    for (const double y : s.y) {
      if (y > 0) lo = std::min(lo, y), hi = std::max(hi, y);
    }
  }
  if (hi == 0) throw InputError("plot: expected a positive value for a logarithmic axis");
  return {lo / 1.5, hi * 1.5};
}

vtkSmartPointer<vtkDoubleArray> column(const char* name, std::span<const double> values) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  for (const double value : values) array->InsertNextValue(value);
  return array;
}

vtkSmartPointer<vtkTable> table_of(const PlotSeries& series, double least_y) {
  std::vector<double> y = series.y;
  for (double& value : y) value = std::max(value, least_y);
  auto table = vtkSmartPointer<vtkTable>::New();
  table->AddColumn(column("x", series.x));
  table->AddColumn(column("y", y));
  return table;
}

/// Colours from dark to light, not so light as to vanish on white. A single point has a marker.
/// @param least_y  what lies below is drawn there.
/// @param share    of the way from dark to light.
vtkPlotPoints& add_series(vtkChartXY& chart, const PlotSeries& series, double least_y,
                          double share) {
  constexpr double kLightest = 0.82;
  constexpr std::array<int, 3> kMarkers{vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE,
                                        vtkPlotPoints::DIAMOND};
  const auto number = static_cast<std::size_t>(chart.GetNumberOfPlots());
  const bool line = series.x.size() > 1;
  auto& plot =
      *vtkPlotPoints::SafeDownCast(chart.AddPlot(line ? vtkChart::LINE : vtkChart::POINTS));
  plot.SetInputData(table_of(series, least_y), 0, 1);
  plot.SetLabel(" " + series.name);  // a gap after its sign
  const Rgb color = viridis(kLightest * share);
  plot.SetColor(color[0], color[1], color[2], 255);
  const bool marked = series.markers || !line;
  plot.SetMarkerStyle(marked ? kMarkers[number % kMarkers.size()] : vtkPlotPoints::NONE);
  return plot;
}

void set_letters(vtkTextProperty& letters, int size, double unit) {
  letters.SetFontSize(static_cast<int>(std::lround(size * unit)));
  letters.SetColor(0.1, 0.1, 0.1);
  letters.SetBold(false);
  letters.SetItalic(false);
}

/// "0.25", "20 000"
std::string tick_label(double value) {
  constexpr double kGrouped = 1e7;
  if (std::abs(value) < 1e4 || std::abs(value) >= kGrouped) return short_number(value);
  std::string digits = std::to_string(std::llround(value));
  const std::size_t sign = value < 0 ? 1 : 0;
  for (std::size_t at = digits.size() - 3; at > sign && at < digits.size(); at -= 3) {
    digits.insert(at, " ");
  }
  return digits;
}

/// Round numbers; none between whole ones if only these occur.
std::vector<double> linear_ticks(const ValueRange& range, bool whole) {
  constexpr int kAbout = 8;
  Ticks ticks = round_ticks(range, kAbout);
  if (whole && ticks.step < 1) {
    ticks = {std::ceil(range.lo), 1,
             static_cast<int>(std::floor(range.hi) - std::ceil(range.lo)) + 1};
  }
  std::vector<double> values(static_cast<std::size_t>(ticks.count));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = ticks.first + static_cast<double>(i) * ticks.step;
  }
  return values;
}

/// 1, 2 and 5 times powers of ten, or the powers alone if these are many; in less than a decade
/// round numbers.
std::vector<double> log_ticks(const ValueRange& range) {
  const double decades = std::log10(range.hi / range.lo);
  if (decades < 1) return linear_ticks(range, false);
  std::vector<double> values;
  for (double power = std::pow(10, std::floor(std::log10(range.lo))); power <= range.hi;
       power *= 10) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (decades > 4 && factor > 1) continue;
      if (factor * power >= range.lo && factor * power <= range.hi)
        values.push_back(factor * power);
    }
  }
  return values;
}

void set_ticks(vtkAxis& axis, const std::vector<double>& values) {
  const auto positions = vtkSmartPointer<vtkDoubleArray>::New();
  const auto labels = vtkSmartPointer<vtkStringArray>::New();
  for (const double value : values) {
    positions->InsertNextValue(axis.GetLogScale() ? std::log10(value) : value);
    labels->InsertNextValue(tick_label(value));
  }
  axis.SetCustomTickPositions(positions, labels);
}

void set_axis(vtkAxis& axis, const std::string& label, const ValueRange& range, double unit) {
  axis.SetBehavior(vtkAxis::FIXED);
  axis.SetUnscaledRange(range.lo, range.hi);
  axis.SetTitle(label);
  axis.SetTickLength(3);  // pixels as rendered; the labels begin at 7
  axis.GetPen()->SetWidth(static_cast<float>(1.5 * unit));
  axis.GetGridPen()->SetWidth(static_cast<float>(unit));
  axis.GetGridPen()->SetColor(225, 225, 225);
  set_letters(*axis.GetTitleProperties(), kLabelSize, unit);
  set_letters(*axis.GetLabelProperties(), kLabelSize, unit);
}

/// How much of the lines runs through each quarter of the diagram: left below, right below, left
/// above, right above.
std::array<int, 4> crowds(std::span<const PlotSeries> series, const ValueRange& x,
                          const ValueRange& y, bool log_y) {
  constexpr int kSteps = 50;
  const auto height = [&](double value) {
    if (!log_y) return (value - y.lo) / (y.hi - y.lo);
    return std::log(std::max(value, y.lo) / y.lo) / std::log(y.hi / y.lo);
  };
  std::array<int, 4> count{};
  for (const PlotSeries& s : series) {
    for (std::size_t i = 0; i + 1 < s.x.size(); ++i) {
      for (int step = 0; step <= kSteps; ++step) {
        const double t = static_cast<double>(step) / kSteps;
        const double px = (s.x[i] + t * (s.x[i + 1] - s.x[i]) - x.lo) / (x.hi - x.lo);
        const double py = (1 - t) * height(s.y[i]) + t * height(s.y[i + 1]);
        ++count[(px > 0.5 ? 1u : 0u) + (py > 0.5 ? 2u : 0u)];
      }
    }
  }
  return count;
}

/// @param quarter  where it goes, see crowds().
void set_legend(vtkChartXY& chart, std::size_t quarter, double unit) {
  vtkChartLegend& legend = *chart.GetLegend();
  chart.SetShowLegend(true);
  legend.SetLabelSize(static_cast<int>(std::lround(kLabelSize * unit)));
  legend.SetSymbolWidth(static_cast<int>(std::lround(34 * unit)));
  legend.SetPadding(static_cast<int>(std::lround(7 * unit)));
  legend.SetHorizontalAlignment(quarter % 2 == 1 ? vtkChartLegend::RIGHT : vtkChartLegend::LEFT);
  legend.SetVerticalAlignment(quarter / 2 == 1 ? vtkChartLegend::TOP : vtkChartLegend::BOTTOM);
}

bool has_whole_x(std::span<const PlotSeries> series) {
  return std::all_of(series.begin(), series.end(), [](const PlotSeries& s) {
    return std::all_of(s.x.begin(), s.x.end(), [](double x) { return x == std::floor(x); });
  });
}

void set_axes(vtkChartXY& chart, std::span<const PlotSeries> series, const PlotOptions& options,
              double unit) {
  const ValueRange x = range_of_x(series);
  const ValueRange y = options.log_y ? log_range_of_y(series) : range_of_y(series);
  vtkAxis &bottom = *chart.GetAxis(vtkAxis::BOTTOM), &left = *chart.GetAxis(vtkAxis::LEFT);
  left.SetLogScale(options.log_y);
  set_axis(bottom, options.x_label, x, unit);
  set_axis(left, options.y_label, y, unit);
  set_ticks(bottom, linear_ticks(x, has_whole_x(series)));
  set_ticks(left, options.log_y ? log_ticks(y) : linear_ticks(y, false));
  if (series.size() < 2) return;
  const auto crowd = crowds(series, x, y, options.log_y);
  // The greatest of equals: right above before the others.
  const auto emptiest = std::min_element(crowd.rbegin(), crowd.rend());
  set_legend(chart, static_cast<std::size_t>(crowd.rend() - emptiest) - 1, unit);
}

vtkSmartPointer<vtkChartXY> make_chart(std::span<const PlotSeries> series,
                                       const PlotOptions& options, double unit) {
  const auto chart = vtkSmartPointer<vtkChartXY>::New();
  const double least =
      options.log_y ? log_range_of_y(series).lo : -std::numeric_limits<double>::infinity();
  const double steps = std::max<double>(1, static_cast<double>(series.size()) - 1);
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (series[i].x.empty()) continue;
    vtkPlotPoints& plot = add_series(*chart, series[i], least, static_cast<double>(i) / steps);
    plot.SetWidth(static_cast<float>(2.5 * unit));
    plot.SetMarkerSize(static_cast<float>(11 * unit));
  }
  chart->SetTitle(options.title);
  set_letters(*chart->GetTitleProperties(), kTitleSize, unit);
  set_axes(*chart, series, options, unit);
  return chart;
}

}  // namespace

void draw_plot(const std::filesystem::path& png, std::span<const PlotSeries> series,
               const PlotOptions& options) {
  require_drawable(series);
  Scene scene(options.pixels);
  const auto chart = make_chart(series, options, scene.unit());
  const auto [width, height] = scene.rendered_size();
  const double margin = 12 * scene.unit();
  chart->SetAutoSize(false);
  chart->SetSize(vtkRectf(static_cast<float>(margin), static_cast<float>(margin),
                          static_cast<float>(width - 2 * margin),
                          static_cast<float>(height - 2 * margin)));
  const auto actor = vtkSmartPointer<vtkContextActor>::New();
  actor->GetScene()->AddItem(chart);
  actor->GetScene()->SetRenderer(&scene.renderer());
  scene.renderer().AddActor(actor);
  scene.save(png);
}

}  // namespace mesamis
