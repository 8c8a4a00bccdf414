// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/decimate_objects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "support/level_set.h"
#include "support/shapes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A ball of some thousand triangles, radius 8 mm.
TriMesh ball(const Vec3& middle) {
  TriMesh ball = level_set({{-1, -1, -1}, {1, 1, 1}}, {20, 20, 20},
                           [](const Vec3& p) { return 0.8 - norm(p); });
  for (Vec3& p : ball.points) p = middle + 10 * p;
  return ball;
}

std::vector<NamedSurface> ball_and_crumb() {
  return {{"ball", {1, 2, 3}, 7, ball({0, 0, 0})}, {"crumb", {4, 5, 6}, 3, cube({20, 0, 0}, 1)}};
}

PrintableOptions within(double tolerance) {
  PrintableOptions options;
  options.tolerance = tolerance;
  return options;
}

TEST(DecimateObjects, KeepsNamesLabelsAndColours) {
  const DecimatedObjects done = decimate_objects(ball_and_crumb(), within(0.2));
  ASSERT_EQ(done.objects.size(), 2U);
  const NamedSurface& one = done.objects[0];
  EXPECT_EQ(one.name, "ball");
  EXPECT_EQ(one.label, 7);
  EXPECT_THAT(one.colour, ElementsAre(1, 2, 3));
  EXPECT_LT(one.surface.triangles.size(), ball({}).triangles.size() / 4);
  EXPECT_TRUE(done.reports[0].within(0.2));
  EXPECT_EQ(done.reports[0].triangles_extracted, std::ssize(ball({}).triangles));
  EXPECT_EQ(done.objects[1].surface.triangles.size(), 12U);
  EXPECT_THAT(done.dropped, IsEmpty());
  EXPECT_EQ(done.unmet, "");
}

TEST(DecimateObjects, OneObjectIsThatOfMakePrintable) {
  const TriMesh surface = ball({0, 0, 0});
  const DecimatedObjects done = decimate_objects({{"", {}, 1, surface}}, within(0.2));
  PrintableReport report;
  const TriMesh printable = make_printable(surface, within(0.2), &report);
  EXPECT_EQ(done.objects[0].surface.points, printable.points);
  EXPECT_EQ(done.objects[0].surface.triangles, printable.triangles);
  EXPECT_EQ(done.reports[0].extracted_to_result, report.extracted_to_result);
  EXPECT_EQ(done.reports[0].parts->islands, 1);
}

TEST(DecimateObjects, TellsWhatWentAndWhatIsUnmet) {
  PrintableOptions options = within(0.2);
  options.min_volume = 10;
  options.triangles = 20;
  const DecimatedObjects done = decimate_objects(ball_and_crumb(), options);
  ASSERT_EQ(done.objects.size(), 1U);
  EXPECT_THAT(done.dropped, ElementsAre("crumb"));
  EXPECT_THAT(done.unmet, HasSubstr("triangles: expected 20 at most, found "));
  options.min_volume = 1e9;
  const DecimatedObjects none = decimate_objects(ball_and_crumb(), options);
  EXPECT_THAT(none.objects, IsEmpty());
  EXPECT_THAT(none.dropped, ElementsAre("ball", "crumb"));
}

TEST(ReadClosedObjects, TurnsToLpsWhatStatesAFrame) {
  const TempFolder folder;
  write_objects(folder / "a.vtp", ball_and_crumb(), {.frame = Frame::kRas});
  std::vector<std::string> warnings;
  const ObjectFile file = read_closed_objects(folder / "a.vtp", {}, warnings);
  ASSERT_EQ(file.objects.size(), 2U);
  EXPECT_EQ(file.objects[1].surface.points, ball_and_crumb()[1].surface.points);
  EXPECT_EQ(file.frame, Frame::kRas);
  EXPECT_TRUE(file.coloured);
  EXPECT_THAT(warnings, IsEmpty());
}

TEST(ReadClosedObjects, TakesOpenPartsOfAClosedSurfaceAsOne) {
  const TempFolder folder;
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  write_bytes(folder / "a.obj", points + "g a\nf 1 3 2\nf 1 2 4\ng b\nf 2 3 4\nf 1 4 3\n");
  std::vector<std::string> warnings;
  const ObjectFile file = read_closed_objects(folder / "a.obj", {}, warnings);
  EXPECT_EQ(file.objects.size(), 1U);
  EXPECT_EQ(file.objects[0].surface.triangles.size(), 4U);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("taken as one surface without names")));
  write_bytes(folder / "open.obj", points + "f 1 3 2\n");
  EXPECT_REFUSED(read_closed_objects(folder / "open.obj", {}, warnings),
                 HasSubstr("open.obj: expected a closed 2-manifold surface, found "));
}

}  // namespace
}  // namespace mesamis
