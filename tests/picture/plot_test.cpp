// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/plot.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "mesamis/files/xml.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;

using Points = std::vector<std::array<double, 2>>;

/// The elements with a class, anywhere below.
void collect(const XmlElement& from, const std::string& name, std::vector<XmlElement>& found) {
  if (from.attribute("class") == name) found.push_back(from);
  for (const XmlElement& child : from.children) collect(child, name, found);
}

std::vector<XmlElement> with_class(const std::string& svg, const std::string& name) {
  std::vector<XmlElement> found;
  WideBudget budget;
  collect(parse_xml("svg", svg, budget).root, name, found);
  return found;
}

/// The number a label shows; its minus sign is a typographer's.
double number_of(std::string label) {
  const std::string minus = "−";
  if (label.starts_with(minus)) label.replace(0, minus.size(), "-");
  return std::stod(label);
}

/// Every tick's label and its place in the diagram along x or y.
std::vector<std::pair<std::string, double>> tick_places(const std::string& svg, char axis) {
  const auto axes = with_class(svg, std::string(1, axis) + "-axis");
  const auto ticks = with_class(svg, "ticks");
  std::vector<std::pair<std::string, double>> places;
  EXPECT_EQ(axes.size(), 1u);
  for (const XmlElement& label : axes.at(0).children) {
    places.emplace_back(label.text, std::stod(label.attribute(std::string(1, axis))));
  }
  return places;
}

/// The points of every polyline, as they are in the file: y downwards.
std::vector<Points> polylines(const std::string& svg) {
  std::vector<Points> lines;
  for (const XmlElement& line : with_class(svg, "line")) {
    std::istringstream text(line.attribute("points"));
    Points& points = lines.emplace_back();
    char comma = 0;
    for (double x = 0, y = 0; text >> x >> comma >> y;) points.push_back({x, y});
  }
  return lines;
}

constexpr double kHundredth = 0.011;  // what two decimals leave

TEST(Plot, PutsLinearValuesWhereTheScaleSays) {
  const PlotSeries line{"line", {0, 1, 2.5, 10}, {-4, 3, 0, 8}};
  const std::string svg = plot_svg(std::vector{line});
  const auto x = tick_places(svg, 'x'), y = tick_places(svg, 'y');
  ASSERT_THAT(x.front().first, "0");
  ASSERT_THAT(x.back().first, "10");
  const double per_x = (x.back().second - x.front().second) / 10;
  const double per_y =
      (y[1].second - y[0].second) / (number_of(y[2].first) - number_of(y[1].first));
  const Points points = polylines(svg).at(0);
  ASSERT_EQ(points.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(points[i][0], x[0].second + per_x * line.x[i], kHundredth) << i;
    EXPECT_NEAR(points[i][1] - points[2][1], per_y * line.y[i], 2 * kHundredth) << i;
  }
  EXPECT_LT(points[3][1], points[0][1]) << "greater values lie higher";
}

TEST(Plot, PutsPowersOnAStraightLineOfALogarithmicAxis) {
  PlotSeries powers{"powers", {}, {}, false};
  for (int i = 0; i <= 40; ++i) {
    powers.x.push_back(std::pow(1.2, i));
    powers.y.push_back(std::pow(1.5, i));
  }
  const Points points =
      polylines(plot_svg(std::vector{powers}, {.log_x = true, .log_y = true})).at(0);
  const double dx = (points[40][0] - points[0][0]) / 40, dy = (points[40][1] - points[0][1]) / 40;
  EXPECT_GT(dx, 10);
  EXPECT_LT(dy, -5);
  for (std::size_t i = 0; i <= 40; ++i) {
    EXPECT_NEAR(points[i][0], points[0][0] + static_cast<double>(i) * dx, 2 * kHundredth);
    EXPECT_NEAR(points[i][1], points[0][1] + static_cast<double>(i) * dy, 2 * kHundredth);
  }
}

TEST(Plot, PutsLogarithmicValuesOnTheirTicksAndOthersOnTheLowerEdge) {
  const PlotSeries series{"a", {1, 2, 3, 4}, {10, 1000, 0, -5}};
  const std::string svg = plot_svg(std::vector{series}, {.log_y = true});
  const Points points = polylines(svg).at(0);
  const auto labels = tick_places(svg, 'y');
  const auto place = [&labels](const std::string& label) {
    for (const auto& [text, y] : labels) {
      if (text == label) return y;
    }
    ADD_FAILURE() << "no tick " << label;
    return 0.0;
  };
  // Labels are shifted by the same amount from their ticks.
  EXPECT_NEAR(points[0][1] - points[1][1], place("10") - place("1000"), 2 * kHundredth);
  EXPECT_EQ(points[2][1], points[3][1]);
  EXPECT_GT(points[2][1], points[0][1]);
}

TEST(Plot, EscapesTexts) {
  const std::vector<PlotSeries> series{{"a<b", {1, 2}, {3, 4}}, {"\"c\" & d", {1, 2}, {4, 3}}};
  const std::string svg =
      plot_svg(series, {.title = "<script>", .x_label = "x > 0", .y_label = "grey value² µ"});
  WideBudget budget;
  const XmlElement page = parse_xml("svg", svg, budget).root;
  EXPECT_EQ(page.child("title")->text, "<script>");
  EXPECT_THAT(svg, HasSubstr(">a&lt;b<"));
  EXPECT_THAT(svg, HasSubstr(">&quot;c&quot; &amp; d<"));
  EXPECT_THAT(svg, HasSubstr(">x &gt; 0<"));
  EXPECT_THAT(svg, HasSubstr(">grey value² µ<"));
  EXPECT_THAT(svg, testing::Not(HasSubstr("<script")));
}

TEST(Plot, ScalesAndHasATitle) {
  const PlotSeries series{"a", {1, 2}, {3, 4}};
  const std::string svg = plot_svg(std::vector{series}, {.size = {640, 400}, .title = "Distances"});
  WideBudget budget;
  const XmlElement page = parse_xml("svg", svg, budget).root;
  EXPECT_EQ(page.name, "svg");
  EXPECT_EQ(page.attribute("viewBox"), "0 0 640 400");
  EXPECT_EQ(page.attribute("role"), "img");
  EXPECT_EQ(page.children.at(0).name, "title");
  EXPECT_EQ(page.children.at(0).text, "Distances");
  const Points points = polylines(svg).at(0);
  for (const auto& [x, y] : points) {
    EXPECT_TRUE(x > 0 && x < 640 && y > 0 && y < 400);
  }
}

TEST(Plot, HasALegendOnlyForSeveralSeriesAndLeavesOutEmptyOnes) {
  const PlotSeries a{"a", {1, 2}, {3, 4}}, b{"b", {1, 2}, {4, 3}}, none{"none", {}, {}};
  EXPECT_TRUE(with_class(plot_svg(std::vector{a}), "legend").empty());
  EXPECT_TRUE(with_class(plot_svg(std::vector{a, none}), "legend").empty());
  const std::string svg = plot_svg(std::vector{a, none, b});
  EXPECT_EQ(with_class(svg, "legend").size(), 1u);
  EXPECT_EQ(with_class(svg, "sample").size(), 2u);
  const auto groups = with_class(svg, "series");
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_NE(groups[0].attribute("stroke"), groups[1].attribute("stroke"));
  EXPECT_EQ(groups[1].attribute("stroke"),
            with_class(plot_svg(std::vector{a, a, b}), "series").at(2).attribute("stroke"))
      << "the same colour with or without the others' points";
}

TEST(Plot, KeepsTheLegendAboveTheGrid) {
  std::vector<PlotSeries> many;
  for (int i = 0; i < 12; ++i) {
    many.push_back({"a series with a rather long name " + std::to_string(i), {1, 2}, {3, 4}});
  }
  const std::string svg = plot_svg(many);
  double lowest = 0, highest = 1e9;
  const XmlElement legend = with_class(svg, "legend").at(0), grid = with_class(svg, "grid").at(0);
  for (const XmlElement& child : legend.children) {
    if (child.name != "text") continue;
    lowest = std::max(lowest, std::stod(child.attribute("y")));
    EXPECT_LT(std::stod(child.attribute("x")), 1000);
  }
  for (const XmlElement& line : grid.children) {
    highest = std::min(highest, std::stod(line.attribute("y1")));
  }
  EXPECT_LT(lowest, highest);
}

TEST(Plot, MarksEveryPointOrNoneButSinglePointsAlways) {
  const auto markers = [](const PlotSeries& series) {
    std::size_t count = 0;
    const auto groups = with_class(plot_svg(std::vector{series}), "markers");
    for (const XmlElement& group : groups) count += group.children.size();
    return count;
  };
  EXPECT_EQ(markers({"a", {1, 2, 3}, {1, 2, 3}, true}), 3u);
  EXPECT_EQ(markers({"a", {1, 2, 3}, {1, 2, 3}, false}), 0u);
  EXPECT_EQ(markers({"a", {1}, {1}, false}), 1u);
}

TEST(Plot, GivesTheSameBytesTwiceAndAsAFile) {
  const TempFolder folder;
  const std::vector<PlotSeries> series{{"a", {1, 2, 7}, {3, 1e-3, 1e5}}, {"b", {2, 3}, {4, 4}}};
  const PlotOptions options{.title = "t", .log_y = true};
  const std::string svg = plot_svg(series, options);
  EXPECT_EQ(plot_svg(series, options), svg);
  draw_plot(folder / "a.svg", series, options);
  EXPECT_EQ(read_bytes(folder / "a.svg"), svg);
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(Plot, DrawsExtremeValues) {
  for (const bool log : {false, true}) {
    const PlotSeries series{"a", {-1e300, 0, 1e300}, {1e-300, 1, 1e300}};
    const Points line = polylines(plot_svg(std::vector{series}, {.log_y = log})).at(0);
    for (const auto& [x, y] : line) EXPECT_TRUE(x >= 0 && x <= 1000 && y >= 0 && y <= 700);
  }
}

TEST(Plot, RefusesWhatCannotBeDrawnAndLeavesNothingBehind) {
  const TempFolder folder;
  const auto draw = [&](const std::vector<PlotSeries>& series, const PlotOptions& options = {}) {
    draw_plot(folder / "a.svg", series, options);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_REFUSED(draw({}), HasSubstr("no points"));
  EXPECT_REFUSED(draw({{"a", {}, {}}}), HasSubstr("no points"));
  EXPECT_REFUSED(draw({{"a", {1, 2}, {3}}}),
                 HasSubstr("'a': expected as many x as y, found 2 and 1"));
  EXPECT_REFUSED(draw({{"a", {1, 2}, {3, nan}}}), HasSubstr("point 1"));
  EXPECT_REFUSED(draw({{"a", {-infinity}, {3}}}), HasSubstr("point 0"));
  EXPECT_REFUSED(draw({{"a", {1e-310}, {3}}}), HasSubstr("found 1e-310 and 3"));
  EXPECT_REFUSED(draw({{"a", {1, 2}, {0, -1}}}, {.log_y = true}), HasSubstr("positive"));
  const PlotSeries good{"a", {1, 2}, {3, 4}};
  EXPECT_REFUSED(draw({good}, {.size = {1000, 199}}), HasSubstr("found 199"));
  EXPECT_REFUSED(draw({good}, {.title = "two\nlines"}), HasSubstr("title"));
  for (const std::string bad : {"\xff", "\xc3", "\xc0\x80", "\xed\xa0\x80", "\xe2\x82", "\x7f"}) {
    EXPECT_REFUSED(draw({{bad, {1}, {1}}}), HasSubstr("UTF-8"));
  }
  const std::vector<PlotSeries> many(40,
                                     {"a long name, so that the legend takes many rows", {1}, {1}});
  EXPECT_REFUSED(draw(many, {.size = {300, 300}}), HasSubstr("300 x 300 pixels"));
  EXPECT_EQ(folder.file_count(), 0);
  EXPECT_THROW(draw_plot(folder / "none/a.svg", std::vector{good}), InputError);
}

}  // namespace
}  // namespace mesamis
