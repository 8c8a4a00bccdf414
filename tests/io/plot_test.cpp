// SPDX-License-Identifier: Apache-2.0
#include "mesamis/io/plot.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "support/can_draw.h"
#include "support/png_image.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/variable.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

PlotOptions small() {
  PlotOptions options;
  options.pixels = {500, 350};
  return options;
}

/// The mean height of what is drawn in colour in a column of pixels; -1: nothing.
double height_at(const Image& image, int x) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < image.size()[1]; ++y) {
    const Rgb c = image.at(x, y);
    if (std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}) < 40) continue;
    sum += y;
    ++count;
  }
  return count > 0 ? sum / count : -1;
}

/// The heights at a quarter, half and three quarters of the width that the line takes.
std::array<double, 3> heights(const Image& image) {
  int first = image.size()[0], last = 0;
  for (int x = 0; x < image.size()[0]; ++x) {
    if (height_at(image, x) < 0) continue;
    first = std::min(first, x);
    last = std::max(last, x);
  }
  EXPECT_GT(last - first, 0.7 * image.size()[0]) << "the line fills the diagram";
  const auto at = [&](double share) {
    return height_at(image, first + static_cast<int>(share * (last - first)));
  };
  return {at(0.25), at(0.5), at(0.75)};
}

TEST(Plot, StraightLinesAreStraightAndPowersAreOnALogarithmicAxis) {
  MESAMIS_REQUIRE_DISPLAY();
  const TempFolder folder;
  PlotSeries line{"line", {}, {}, false}, powers{"powers", {}, {}, false};
  for (int i = 0; i <= 40; ++i) {
    line.x.push_back(i);
    line.y.push_back(1 + 3 * i);
    powers.x.push_back(i);
    powers.y.push_back(std::pow(1.08, i));
  }
  PlotOptions options = small();
  for (const bool log_y : {false, true}) {
    options.log_y = log_y;
    draw_plot(folder / "a.png", std::vector{log_y ? powers : line}, options);
    const Image image(folder / "a.png");
    EXPECT_EQ(image.size(), (std::array<int, 2>{500, 350}));
    const auto h = heights(image);
    EXPECT_GT(h[2] - h[0], 100);
    EXPECT_NEAR(h[1], (h[0] + h[2]) / 2, 2) << (log_y ? "logarithmic" : "linear");
  }
  draw_plot(folder / "a.png", std::vector{powers}, small());
  const auto h = heights(Image(folder / "a.png"));
  EXPECT_LT(h[1], (h[0] + h[2]) / 2) << "convex";
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(Plot, DrawsEverySeriesInAColourOfItsOwn) {
  MESAMIS_REQUIRE_DISPLAY();
  const TempFolder folder;
  const PlotSeries low{"low", {0, 1}, {1, 1}}, high{"high", {0, 1}, {3, 3}};
  const auto inks = [&](const std::vector<PlotSeries>& series) {
    draw_plot(folder / "a.png", series, small());
    const Image image(folder / "a.png");
    std::array<int, 2> count{};  // violet, green
    for (int y = 0; y < 350; ++y) {
      for (int x = 0; x < 500; ++x) {
        const Rgb c = image.at(x, y);
        count[0] += c.b > c.g + 40;
        count[1] += c.g > c.b + 40;
      }
    }
    return count;
  };
  const auto one = inks({low}), both = inks({low, high});
  EXPECT_GT(one[0], 300);
  EXPECT_LT(one[1], 20);
  EXPECT_GT(both[0], 300);
  EXPECT_GT(both[1], 300);
}

TEST(Plot, RefusesPlainlyAndLeavesNothingBehind) {
  const TempFolder folder;
  const auto draw = [&](std::vector<PlotSeries> series, bool log_y = false) {
    PlotOptions options = small();
    options.log_y = log_y;
    draw_plot(folder / "a.png", series, options);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(draw({}), HasSubstr("no points"));
  EXPECT_REFUSED(draw({{"a", {}, {}}}), HasSubstr("no points"));
  EXPECT_REFUSED(draw({{"a", {1, 2}, {3}}}), HasSubstr("found 2 and 1"));
  EXPECT_REFUSED(draw({{"a", {1, 2}, {3, nan}}}), HasSubstr("point 1"));
  const Variable path("PATH", "/nowhere"), display("DISPLAY", ":987");
  EXPECT_REFUSED(draw({{"a", {1, 2}, {3, 4}}}), HasSubstr("xvfb"));
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(Plot, RefusesALogarithmicAxisWithoutAPositiveValue) {
  MESAMIS_REQUIRE_DISPLAY();
  const TempFolder folder;
  PlotOptions options = small();
  options.log_y = true;
  const std::vector<PlotSeries> series{{"a", {1, 2}, {0, -1}}};
  EXPECT_REFUSED(draw_plot(folder / "a.png", series, options), HasSubstr("positive"));
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(Plot, DrawsWhatHasNoExtent) {
  MESAMIS_REQUIRE_DISPLAY();
  const TempFolder folder;
  PlotOptions options = small();
  for (const bool log_y : {false, true}) {
    options.log_y = log_y;
    for (const double y : {0.0, 5.0, -5.0}) {
      if (log_y && y <= 0) continue;
      const std::vector<PlotSeries> series{{"none", {}, {}}, {"one", {3}, {y}, false}};
      draw_plot(folder / "a.png", series, options);
      const Image image(folder / "a.png");
      int colored = 0;
      for (int x = 0; x < 500; ++x) colored += height_at(image, x) >= 0;
      EXPECT_GT(colored, 3) << "a marker";
    }
  }
}

}  // namespace
}  // namespace mesamis
