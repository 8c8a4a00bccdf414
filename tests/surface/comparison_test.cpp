// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "support/shapes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

TEST(MeasureDistances, OfACubeToOneAroundIt) {
  const TriMesh inner = cube({0, 0, 0}, 1), outer = cube({-1, -1, -1}, 3);
  const DirectedDistances d = measure_distances("out", inner, outer);
  EXPECT_EQ(d.name, "out");
  EXPECT_EQ(d.from_vertices.size(), inner.points.size());
  for (const double x : d.from_vertices) EXPECT_NEAR(x, 1, 1e-12);
  EXPECT_GT(d.from_area.size(), 100'000u);
  for (const double x : d.from_area) EXPECT_NEAR(x, 1, 1e-12);
}

TEST(MeasureDistances, OnlyPointsInsideThePartCount) {
  const TriMesh surface = cube({0, 0, 0}, 2);
  const Box part{{-1, -1, -1}, {0.5, 3, 3}};
  const DirectedDistances d = measure_distances("a", surface, surface, part);
  EXPECT_EQ(d.from_vertices.size(), 4u);
  EXPECT_REFUSED(measure_distances("a", surface, surface, Box{{5, 5, 5}, {6, 6, 6}}),
                 testing::HasSubstr("no point of the first lies inside the box"));
  EXPECT_FALSE(find_distances("a", surface, surface, Box{{5, 5, 5}, {6, 6, 6}}));
  EXPECT_EQ(find_distances("a", surface, surface, part)->from_vertices, d.from_vertices);
}

TEST(Summarize, KeepsVerticesAndAreaApart) {
  const DirectedSummary summary = summarize(DirectedDistances{"a", {1, 3}, {4, 4, 7}});
  EXPECT_EQ(summary.vertices.count, 2u);
  EXPECT_DOUBLE_EQ(summary.vertices.mean, 2);
  EXPECT_EQ(summary.area.count, 3u);
  EXPECT_DOUBLE_EQ(summary.area.max, 7);
}

TEST(Histogram, CountsEveryDistanceOnce) {
  const std::vector<DirectedDistances> both{{"a", {0, 1, 2, 10}, {5}}, {"b", {3}, {10, 10}}};
  const DistanceHistogram histogram = histogram_of(both);
  EXPECT_DOUBLE_EQ(histogram.width, 0.1);
  ASSERT_EQ(histogram.columns.size(), 4u);
  const std::vector<std::size_t> totals{4, 1, 1, 2};
  for (std::size_t c = 0; c < 4; ++c) {
    const auto& counts = histogram.columns[c].counts;
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t{0}), totals[c]);
  }
  EXPECT_EQ(histogram.columns[3].name, "b_area");
  EXPECT_EQ(histogram.columns[3].counts.back(), 2u) << "the longest falls into the last bin";
  const std::string csv = to_csv(histogram);
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "from_mm,to_mm,a_vertices,a_area,b_vertices,b_area");
}

}  // namespace
}  // namespace mesamis
