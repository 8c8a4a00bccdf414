// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/printable.h"

#include <gtest/gtest.h>

#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "support/level_set.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

TriMesh ball() {
  TriMesh surface = level_set({{-1, -1, -1}, {1, 1, 1}}, {16, 16, 16},
                              [](const Vec3& p) { return 0.8 - norm(p); });
  for (Vec3& p : surface.points) p = Vec3{100.1, -7.3, 950.7} + 8 * p;
  return surface;
}

void expect_single_precision(const TriMesh& surface) {
  for (const Vec3& p : surface.points) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(p[axis], static_cast<float>(p[axis]));
  }
}

TEST(Printable, StaysWithinTheToleranceOfWhatWasExtracted) {
  const TriMesh surface = ball();
  PrintableReport report;
  PrintableOptions options;
  options.tolerance = 0.1;
  const TriMesh result = make_printable(surface, options, &report);
  EXPECT_LT(result.triangles.size(), surface.triangles.size() / 2);
  EXPECT_EQ(report.triangles_extracted, static_cast<std::int64_t>(surface.triangles.size()));
  EXPECT_GT(report.extracted_to_result, 0.02);
  EXPECT_LE(report.extracted_to_result, 0.1);
  EXPECT_LE(report.result_to_extracted, 0.1);
  EXPECT_LE(max_distance(surface, result, 1e-3), 0.1);
  expect_single_precision(result);
  EXPECT_TRUE(find_self_intersections(result).empty());
}

TEST(Printable, AnInfiniteToleranceStopsAtTheNumberOfTriangles) {
  PrintableOptions options;
  options.triangles = 200;
  options.tolerance = std::numeric_limits<double>::infinity();
  PrintableReport report;
  EXPECT_EQ(make_printable(ball(), options, &report).triangles.size(), 200u);
  EXPECT_GT(report.extracted_to_result, 0);
  options.tolerance = 1e-3;  // both: whichever comes first
  EXPECT_GT(make_printable(ball(), options, &report).triangles.size(), 200u);
  EXPECT_LE(report.extracted_to_result, 1e-3);
}

TEST(Printable, NoToleranceMeansAsExtracted) {
  const TriMesh surface = ball();
  PrintableOptions options;
  options.tolerance = 0;
  PrintableReport report;
  const TriMesh result = make_printable(surface, options, &report);
  EXPECT_EQ(result.points, surface.points);
  EXPECT_EQ(result.triangles, surface.triangles);
  EXPECT_EQ(report.triangles_extracted, static_cast<std::int64_t>(surface.triangles.size()));
  EXPECT_EQ(report.extracted_to_result, 0);
}

TEST(Printable, IsRoundedIfAskedThoughNothingIsDecimated) {
  TriMesh far = ball();
  for (Vec3& p : far.points) p = p + Vec3{30000, 0, 0};  // where floats are 0.002 mm apart
  PrintableOptions options;
  options.tolerance = 0;
  options.round = true;
  PrintableReport report;
  for (const TriMesh& surface : {ball(), far}) {
    const TriMesh result = make_printable(surface, options, &report);
    expect_single_precision(result);
    EXPECT_EQ(flaws_of(check_surface(result)), "");
    EXPECT_TRUE(find_self_intersections(result).empty());
    EXPECT_GT(report.extracted_to_result, 0);
    EXPECT_LE(max_distance(surface, result, 1e-5), report.extracted_to_result + 1e-5);
    EXPECT_TRUE(report.within(0)) << "none was asked for";
  }
}

TEST(Printable, DropsWhatIsSmallerThanAskedAndSaysSo) {
  const TriMesh crumb = cube({200, 0, 0}, 0.5);
  PrintableOptions options;
  options.tolerance = 0;
  options.min_volume = 0.2;
  PrintableReport report;
  const TriMesh result = make_printable(joined(ball(), crumb), options, &report);
  EXPECT_EQ(result.triangles, ball().triangles);
  ASSERT_TRUE(report.parts);
  EXPECT_EQ(report.parts->islands, 2);
  EXPECT_EQ(report.parts->islands_dropped, 1);
  EXPECT_NEAR(report.parts->volume_dropped, 0.125, 1e-9);
  EXPECT_EQ(report.triangles_extracted, static_cast<std::int64_t>(result.triangles.size()));
  options.min_volume = 0.1;
  EXPECT_EQ(check_surface(make_printable(joined(ball(), crumb), options, &report)).components, 2);
}

TEST(Printable, AFlawedSurfaceIsLeftForTheCallerToFind) {
  TriMesh open = ball();
  open.triangles.pop_back();
  PrintableOptions options;
  options.tolerance = 0.1;
  PrintableReport report;
  EXPECT_EQ(make_printable(open, options, &report).triangles, open.triangles);
  EXPECT_FALSE(report.parts);
  EXPECT_EQ(report.triangles_extracted, static_cast<std::int64_t>(open.triangles.size()));
}

TEST(Printable, NothingStaysNothing) {
  PrintableReport report;
  PrintableOptions options;
  options.tolerance = 0.1;
  EXPECT_TRUE(make_printable({}, options, &report).triangles.empty());
}

}  // namespace
}  // namespace mesamis
