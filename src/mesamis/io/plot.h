// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

/// Diagrams of numbers, so that a study can be looked at without another program.
namespace mesamis {

/// A line through points.
struct PlotSeries {
  std::string name;          ///< in the legend
  std::vector<double> x, y;  ///< as many of each, finite
  bool markers = true;       ///< a sign at every point
};

struct PlotOptions {
  std::array<int, 2> pixels{1000, 700};
  std::string title;
  std::string x_label, y_label;  ///< what the axes show, with its unit
  bool log_y = false;            ///< powers of ten; what is not positive lies on the lower edge
};

/// Lines in one diagram, with a legend if there are several; the file appears whole or not at all.
/// Linear y axes begin at 0 unless a value is negative. Series differ in colour and in their
/// markers.
///
/// Needs a display, and silences stderr, as the pictures of io/picture.h do.
/// @throws InputError  if there is no display and no Xvfb, no point at all, with log_y none that is
///                     positive, x and y of a series differ in number or are not finite, or the
///                     file cannot be written.
void draw_plot(const std::filesystem::path& png, std::span<const PlotSeries> series,
               const PlotOptions& options = {});

}  // namespace mesamis
