// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/check_printable.h"

#include <gmock/gmock.h>

#include "mesamis/base/error.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(CheckPrintable, NamesWhatIsWrong) {
  const TriMesh sound = cube();
  EXPECT_EQ(print_flaws_of(check_printable(sound)), "");
  TriMesh open = sound;
  open.triangles.pop_back();
  EXPECT_EQ(print_flaws_of(check_printable(open)), "3 open edges");
  TriMesh turned = sound;
  std::swap(turned.triangles[4][0], turned.triangles[4][1]);
  EXPECT_THAT(print_flaws_of(check_printable(turned)), HasSubstr("3 edges between triangles"));
  TriMesh doubled = sound;
  doubled.triangles.push_back(doubled.triangles[0]);
  EXPECT_THAT(print_flaws_of(check_printable(doubled)), HasSubstr("3 edges with more than two"));
  TriMesh inward = sound;
  for (Triangle& triangle : inward.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_THAT(print_flaws_of(check_printable(inward)), HasSubstr("inward"));
}

TEST(CheckPrintable, AHollowIsNoFlawAndOverlapsAreCounted) {
  TriMesh hollow = cube({2, 2, 2}, 1);
  for (Triangle& triangle : hollow.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_EQ(print_flaws_of(check_printable(joined(cube({0, 0, 0}, 5), hollow))), "");
  const PrintCheck overlap = check_printable(joined(cube(), cube({0.5, 0.5, 0.5})));
  EXPECT_EQ(print_flaws_of(overlap), "");
  EXPECT_GT(overlap.self_intersections, 0u);
}

TEST(CheckPrintable, PrusaSlicersRepairsAreFlaws) {
  PrintCheck check = check_printable(cube());
  EXPECT_FALSE(check.prusa.has_value());
  check.prusa = parse_prusa_info("manifold = yes\n");
  EXPECT_EQ(print_flaws_of(check), "");
  check.prusa = parse_prusa_info("manifold = yes\nedges_fixed = 2\n");
  EXPECT_EQ(print_flaws_of(check), "prusa-slicer --info: edges_fixed = 2");
  check.surface.open_edges = 3;
  EXPECT_EQ(print_flaws_of(check), "3 open edges, prusa-slicer --info: edges_fixed = 2");
}

TEST(CheckPrintable, RefusesAnUnsoundSurface) {
  TriMesh broken = cube();
  broken.triangles[0][0] = 99;
  EXPECT_THROW(check_printable(broken), InputError);
}

}  // namespace
}  // namespace mesamis
