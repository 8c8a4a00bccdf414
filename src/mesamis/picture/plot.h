// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mesamis/files/output_path.h"
#include "mesamis/rooms.h"

/// Diagrams of numbers as SVG. Nothing but this library is needed to draw them, and any browser
/// shows them.
namespace mesamis::detail::picture {

/// A polyline through points.
struct PlotSeries {
  std::string name;          ///< shown in the legend; UTF-8
  std::vector<double> x, y;  ///< as many of each; 0, or of a magnitude from 1e-300 to 1e300
  bool markers = true;       ///< draw a marker at every point
};

struct PlotOptions {
  std::array<int, 2> size{1000, 700};      ///< width and height in CSS pixels, 200 to 10 000 each
  std::string title = {};                  ///< above the diagram; UTF-8
  std::string x_label = {}, y_label = {};  ///< quantity and unit of each axis; UTF-8
  bool log_x = false;  ///< logarithmic x axis; values that are not positive lie on its left end
  bool log_y = false;  ///< logarithmic y axis; values that are not positive lie on its lower end
};

/// Draws several series in one diagram, with a legend above it if there is more than one series.
///
/// A linear axis shows all values with a margin of 4 % and does not extend beyond 0 where the
/// values do not; the y axis always contains 0. A logarithmic axis shows all positive values with a
/// margin of a factor of 1.5. Ticks are at 1, 2 or 5 times powers of ten. Series differ in colour,
/// lightness, marker and dash pattern, so that a grey print can be read as well. A series of one
/// point always has a marker; a series without points is left out.
///
/// The root element has a viewBox, so that the diagram scales, and a title element for screen
/// readers. Each polyline has class "line" and holds its points in diagram coordinates with two
/// decimals.
///
/// @param series   at least one point among them.
/// @param options  see there.
/// @return an SVG 1.1 document in UTF-8; the same input gives the same bytes, whatever the locale.
/// @throws InputError  if there is no point at all, x and y of a series differ in number, a value
///                     is not finite or out of range, a logarithmic axis has no positive value, the
///                     size is out of range, or a text is not UTF-8 or has control characters.
///
/// O(n) time and memory for n points.
std::string plot_svg(std::span<const PlotSeries> series, const PlotOptions& options = {});

/// Writes the diagram of plot_svg() to a file, which appears whole or not at all.
///
/// @param file  the name should end in .svg; its folder must exist.
/// @throws InputError  as plot_svg() does, or if the file cannot be written.
///
/// O(n) time and memory for n points.
void draw_plot(const OutputPath& file, std::span<const PlotSeries> series,
               const PlotOptions& options = {});

}  // namespace mesamis::detail::picture
