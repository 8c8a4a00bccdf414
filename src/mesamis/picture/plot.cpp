// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/plot.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/files/atomic_file.h"
#include "mesamis/picture/axis.h"
#include "mesamis/picture/series_style.h"
#include "mesamis/picture/svg.h"

namespace mesamis::detail::picture {

namespace {

// Lengths in CSS pixels.
constexpr double kFontSize = 16, kTitleSize = 20;
constexpr double kCharacterWidth = 0.6 * kFontSize;  // a little more than the mean of usual fonts
constexpr double kMargin = 14, kRowHeight = 26, kTickLength = 5;
constexpr double kSampleWidth = 48;  // of a line in the legend
constexpr double kEntryGap = 30;     // between two entries of the legend
constexpr int kSmallest = 200, kLargest = 10'000;

// ---------------------------------------------------------------- checks

/// The bytes of the UTF-8 character that begins a text; 0: it is none, or a control character.
std::size_t character_length(std::string_view text) {
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const unsigned second = byte(1);
  const bool overlong = (byte(0) == 0xe0 && second < 0xa0) || (byte(0) == 0xf0 && second < 0x90);
  const bool surrogate = byte(0) == 0xed && second >= 0xa0;
  const bool too_large = byte(0) == 0xf4 && second >= 0x90;
  return overlong || surrogate || too_large ? 0 : length;
}

void require_text(const char* what, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character_length(std::string_view(text).substr(at));
    if (length == 0) {
      throw InputError(std::string("plot: ") + what +
                       ": expected UTF-8 without control characters, found byte " +
                       std::to_string(static_cast<unsigned char>(text[at])));
    }
    at += length;
  }
}

std::string to_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

bool is_drawable(double value) {
  constexpr double kLeast = 1e-300, kGreatest = 1e300;
  return value == 0 || (std::abs(value) >= kLeast && std::abs(value) <= kGreatest);
}

void require_drawable(const PlotSeries& series) {
  require_text("name of a series", series.name);
  if (series.x.size() != series.y.size()) {
    throw InputError("plot: series '" + series.name + "': expected as many x as y, found " +
                     std::to_string(series.x.size()) + " and " + std::to_string(series.y.size()));
  }
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (is_drawable(series.x[i]) && is_drawable(series.y[i])) continue;
    throw InputError("plot: series '" + series.name + "', point " + std::to_string(i) +
                     ": expected 0 or a magnitude from 1e-300 to 1e300, found " +
                     to_text(series.x[i]) + " and " + to_text(series.y[i]));
  }
}

void require_valid(const PlotOptions& options) {
  require_text("title", options.title);
  require_text("label of the x axis", options.x_label);
  require_text("label of the y axis", options.y_label);
  for (const int length : options.size) {
    if (length >= kSmallest && length <= kLargest) continue;
    throw InputError("plot: expected a size of " + std::to_string(kSmallest) + " to " +
                     std::to_string(kLargest) + " pixels, found " + std::to_string(length));
  }
}

// ---------------------------------------------------------------- layout

double text_width(const std::string& text) {
  const auto characters = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  });
  return kCharacterWidth * static_cast<double>(characters);
}

/// A series to be drawn, and the upper left corner of its entry in the legend.
struct Entry {
  const PlotSeries* series = nullptr;
  SeriesStyle style{};
  double x = 0, y = 0;
};

struct Diagram {
  Axis x, y;
  double left = 0, right = 0, top = 0, bottom = 0;  // of the plane of the axes
  std::vector<Entry> entries;

  double x_at(double value) const { return left + x.share(value) * (right - left); }
  double y_at(double value) const { return bottom - y.share(value) * (bottom - top); }
};

/// Those with points; a series keeps its style if another one has none.
std::vector<Entry> entries_of(std::span<const PlotSeries> series) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (!series[i].x.empty()) entries.push_back({&series[i], series_style(i)});
  }
  if (entries.empty()) throw InputError("plot: nothing to draw, there are no points");
  return entries;
}

Axis fit_axis(const std::vector<Entry>& entries, std::vector<double> PlotSeries::*coordinate,
              const AxisOptions& options) {
  std::vector<double> values;
  for (const Entry& entry : entries) {
    const std::vector<double>& more = entry.series->*coordinate;
    values.insert(values.end(), more.begin(), more.end());
  }
  return make_axis(values, options);
}

/// Places the legend's entries in columns of equal width, row by row.
/// @return the lower edge of the last row.
double place_legend(Diagram& diagram, double top) {
  if (diagram.entries.size() < 2) return top;
  double column = 0;
  for (const Entry& entry : diagram.entries) {
    column = std::max(column, kSampleWidth + text_width(entry.series->name) + kEntryGap);
  }
  const double room = diagram.right - diagram.left + kEntryGap;
  const auto columns = static_cast<std::size_t>(std::max(1.0, room / column));
  for (std::size_t i = 0; i < diagram.entries.size(); ++i) {
    const std::size_t row = i / columns;
    diagram.entries[i].x = diagram.left + static_cast<double>(i - row * columns) * column;
    diagram.entries[i].y = top + static_cast<double>(row) * kRowHeight;
  }
  return diagram.entries.back().y + kRowHeight;
}

double widest(const std::vector<std::string>& labels) {
  double width = 0;
  for (const std::string& label : labels) width = std::max(width, text_width(label));
  return width;
}

Diagram lay_out(std::span<const PlotSeries> series, const PlotOptions& options) {
  constexpr int kPixelsPerTickX = 110, kPixelsPerTickY = 65, kMostTicks = 10;
  constexpr double kLeast = 40;
  const auto [width, height] = options.size;
  Diagram d;
  d.entries = entries_of(series);
  d.x = fit_axis(d.entries, &PlotSeries::x,
                 {options.log_x, false, std::min(kMostTicks, width / kPixelsPerTickX)});
  d.y = fit_axis(d.entries, &PlotSeries::y,
                 {options.log_y, true, std::min(kMostTicks, height / kPixelsPerTickY)});
  d.left =
      kMargin + (options.y_label.empty() ? 0 : kRowHeight) + widest(d.y.labels) + 2 * kTickLength;
  d.right = width - kMargin - std::max(kMargin, text_width(d.x.labels.back()) / 2);
  d.bottom = height - kMargin - (options.x_label.empty() ? 0 : kRowHeight) - kRowHeight;
  d.top = place_legend(d, kMargin + (options.title.empty() ? 0 : 1.3 * kRowHeight)) + 0.4 * kMargin;
  if (d.right - d.left < kLeast || d.bottom - d.top < kLeast) {
    throw InputError("plot: expected more than " + std::to_string(width) + " x " +
                     std::to_string(height) + " pixels for a diagram with these labels");
  }
  return d;
}

// ---------------------------------------------------------------- drawing

SvgElement group(std::string_view name) {
  SvgElement g("g");
  g.set("class", name);
  return g;
}

SvgElement line(std::array<double, 2> from, std::array<double, 2> to) {
  SvgElement element("line");
  element.set("x1", from[0]).set("y1", from[1]).set("x2", to[0]).set("y2", to[1]);
  return element;
}

/// @param anchor  start, middle or end: which part of the text is at the place.
SvgElement text(const std::string& words, double x, double y, std::string_view anchor) {
  SvgElement element("text");
  element.set("x", x).set("y", y).set("text-anchor", anchor).set_text(words);
  return element;
}

/// Grid lines, ticks and labels of both axes, below the series.
SvgElement draw_axes(const Diagram& d) {
  constexpr double kToBaseline = 0.35 * kFontSize;  // from the middle of the digits
  SvgElement grid = group("grid"), ticks = group("ticks"), x = group("x-axis"), y = group("y-axis");
  for (std::size_t i = 0; i < d.x.ticks.size(); ++i) {
    const double at = d.x_at(d.x.ticks[i]);
    grid.add(line({at, d.top}, {at, d.bottom}));
    ticks.add(line({at, d.bottom}, {at, d.bottom + kTickLength}));
    x.add(text(d.x.labels[i], at, d.bottom + kTickLength + 1.1 * kFontSize, "middle"));
  }
  for (std::size_t i = 0; i < d.y.ticks.size(); ++i) {
    const double at = d.y_at(d.y.ticks[i]);
    grid.add(line({d.left, at}, {d.right, at}));
    ticks.add(line({d.left - kTickLength, at}, {d.left, at}));
    y.add(text(d.y.labels[i], d.left - 2 * kTickLength, at + kToBaseline, "end"));
  }
  grid.set("stroke", "#dddddd").set("stroke-width", 1);
  ticks.set("stroke", "#333333").set("stroke-width", 1.5);
  ticks.add(line({d.left, d.top}, {d.left, d.bottom}));
  ticks.add(line({d.left, d.bottom}, {d.right, d.bottom}));
  SvgElement axes = group("axes");
  axes.add(std::move(grid)).add(std::move(ticks)).add(std::move(x)).add(std::move(y));
  return axes;
}

SvgElement polyline(const std::vector<std::array<double, 2>>& points, const SeriesStyle& style) {
  std::string list;
  for (const auto& [x, y] : points) {
    list += (list.empty() ? "" : " ") + svg_number(x) + "," + svg_number(y);
  }
  SvgElement element("polyline");
  element.set("class", "line").set("points", list).set("stroke-dasharray", style.dashes);
  return element;
}

SvgElement markers(const std::vector<std::array<double, 2>>& points, const SeriesStyle& style) {
  SvgElement all = group("markers");
  all.set("fill", style.filled ? style.color : "#ffffff").set("stroke-width", 2);
  for (const auto& [x, y] : points) {
    SvgElement marker("path");
    marker.set("transform", "translate(" + svg_number(x) + " " + svg_number(y) + ")");
    marker.set("d", style.marker);
    all.add(std::move(marker));
  }
  return all;
}

/// A group in which lines and markers are drawn in a series' colour.
SvgElement styled_group(std::string_view name, const SeriesStyle& style) {
  SvgElement g = group(name);
  g.set("fill", "none").set("stroke", style.color).set("stroke-width", 2.5);
  g.set("stroke-linejoin", "round").set("stroke-linecap", "round");
  return g;
}

bool has_markers(const PlotSeries& series) { return series.markers || series.x.size() == 1; }

SvgElement draw_series(const Diagram& d, const Entry& entry) {
  const PlotSeries& series = *entry.series;
  std::vector<std::array<double, 2>> points;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    points.push_back({d.x_at(series.x[i]), d.y_at(series.y[i])});
  }
  SvgElement g = styled_group("series", entry.style);
  g.add(SvgElement("title").set_text(series.name));
  if (points.size() > 1) g.add(polyline(points, entry.style));
  if (has_markers(series)) g.add(markers(points, entry.style));
  return g;
}

SvgElement draw_legend(const Diagram& d) {
  constexpr double kGap = 8;  // from the sample to the name
  SvgElement legend = group("legend");
  for (const Entry& entry : d.entries) {
    const double y = entry.y + kRowHeight / 2, end = entry.x + kSampleWidth - kGap;
    SvgElement sample = styled_group("sample", entry.style);
    if (entry.series->x.size() > 1) {
      sample.add(line({entry.x, y}, {end, y}).set("stroke-dasharray", entry.style.dashes));
    }
    if (has_markers(*entry.series)) sample.add(markers({{(entry.x + end) / 2, y}}, entry.style));
    legend.add(std::move(sample));
    legend.add(text(entry.series->name, end + kGap, y + 0.35 * kFontSize, "start"));
  }
  return legend;
}

SvgElement draw_labels(const Diagram& d, const PlotOptions& options) {
  const double x = (d.left + d.right) / 2, y = (d.top + d.bottom) / 2;
  const double left = kMargin + kFontSize;
  SvgElement labels = group("labels");
  if (!options.title.empty()) {
    labels.add(text(options.title, x, kMargin + kTitleSize, "middle")
                   .set("font-size", kTitleSize)
                   .set("font-weight", "bold"));
  }
  if (!options.x_label.empty())
    labels.add(text(options.x_label, x, options.size[1] - kMargin, "middle"));
  if (!options.y_label.empty()) {
    labels.add(text(options.y_label, left, y, "middle")
                   .set("transform", "rotate(-90 " + svg_number(left) + " " + svg_number(y) + ")"));
  }
  return labels;
}

/// For those who cannot see the diagram.
std::string description(const Diagram& d, const PlotOptions& options) {
  std::string words = options.y_label + " over " + options.x_label + ": ";
  for (const Entry& entry : d.entries) {
    words += (&entry == d.entries.data() ? "" : "; ") + entry.series->name;
  }
  return words;
}

SvgElement empty_page(const std::array<int, 2>& size) {
  const std::string width = std::to_string(size[0]), height = std::to_string(size[1]);
  SvgElement page("svg");
  page.set("xmlns", "http://www.w3.org/2000/svg").set("version", "1.1");
  page.set("width", width).set("height", height).set("viewBox", "0 0 " + width + " " + height);
  page.set("role", "img").set("fill", "#222222").set("font-size", kFontSize);
  page.set("font-family", "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif");
  return page;
}

}  // namespace

std::string plot_svg(std::span<const PlotSeries> series, const PlotOptions& options) {
  require_valid(options);
  for (const PlotSeries& s : series) require_drawable(s);
  const Diagram diagram = lay_out(series, options);
  SvgElement page = empty_page(options.size);
  page.add(SvgElement("title").set_text(options.title.empty() ? "Diagram" : options.title));
  page.add(SvgElement("desc").set_text(description(diagram, options)));
  page.add(SvgElement("rect").set("width", "100%").set("height", "100%").set("fill", "#ffffff"));
  page.add(draw_axes(diagram));
  for (const Entry& entry : diagram.entries) page.add(draw_series(diagram, entry));
  if (diagram.entries.size() > 1) page.add(draw_legend(diagram));
  page.add(draw_labels(diagram, options));
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + page.to_string();
}

void draw_plot(const OutputPath& file, std::span<const PlotSeries> series,
               const PlotOptions& options) {
  write_file(file, plot_svg(series, options));
}

}  // namespace mesamis::detail::picture
