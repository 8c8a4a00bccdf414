// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/sheets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/label_grids.h"
#include "support/throws.h"

namespace mesamis {
namespace {

/// A box of three slabs. Its boundaries: two sheets inside and three caps.
PartitionSurface slabs() {
  const TetMesh mesh = box_mesh({{0, 0, 0}, {1, 1, 1}}, {3, 3, 6});
  std::vector<std::vector<double>> fields(3);
  for (const Vec3& p : mesh.points) {
    fields[0].push_back(0.31 - p.z);
    fields[1].push_back(0);
    fields[2].push_back(p.z - 0.64);
  }
  return extract_partition(mesh, fields);
}

TEST(Sheets, AreTheBoundariesCutAlongTheirCurves) {
  const PartitionSurface partition = slabs();
  const Sheets sheets = cut_into_sheets(partition);
  EXPECT_EQ(sheets.count, 5);
  ASSERT_EQ(sheets.surface.triangles.size(), partition.triangles.size());
  std::vector<std::set<std::array<Index, 2>>> sides(5);
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index p = sheets.surface.triangles[t][i];
      EXPECT_EQ(sheets.origin[p], partition.triangles[t][i]);
      EXPECT_EQ(sheets.surface.points[p], partition.points[sheets.origin[p]]);
      sides[sheets.of_point[p]].insert(partition.sides[t]);
    }
  }
  for (const auto& of_sheet : sides) EXPECT_EQ(of_sheet.size(), 1u);
}

TEST(Sheets, KnowTheirRimsAndCopies) {
  const Sheets sheets = cut_into_sheets(slabs());
  std::size_t at_rims = 0;
  for (std::size_t p = 0; p < sheets.origin.size(); ++p) {
    const double z = sheets.surface.points[p].z, x = sheets.surface.points[p].x,
                 y = sheets.surface.points[p].y;
    const bool at_side = std::min({x, y, 1 - x, 1 - y}) == 0;
    const bool at_curve = at_side && (std::abs(z - 0.31) < 1e-9 || std::abs(z - 0.64) < 1e-9);
    EXPECT_EQ(sheets.at_rim[p] != 0, at_curve) << x << " " << y << " " << z;
    const auto copies = std::ranges::count(sheets.origin, sheets.origin[p]);
    EXPECT_EQ(copies, at_curve ? 3 : 1);
    const auto first = std::ranges::find(sheets.origin, sheets.origin[p]) - sheets.origin.begin();
    EXPECT_EQ(sheets.first_copy[p], first);
    at_rims += at_curve ? 1 : 0;
  }
  EXPECT_GT(at_rims, 0u);
}

TEST(Sheets, AreManifoldForAllLabels) {
  OwnedLabels labels{.size = {7, 7, 7}};
  std::mt19937 generator(5);
  for (int n = 0; n < 343; ++n) {
    labels.labels.push_back(static_cast<std::uint16_t>(generator() % 5));
  }
  const Sheets sheets = cut_into_sheets(
      extract_partition_on_grid(smooth_memberships(labels.grid(), {.most_rounds = 0})));
  EXPECT_TRUE(check_surface(sheets.surface).manifold());
}

TEST(Sheets, AreSplitIntoSurfacesOfTheirOwn) {
  const Sheets sheets = cut_into_sheets(slabs());
  const std::vector<TriMesh> split = split_sheets(sheets, sheets.surface.triangles);
  ASSERT_EQ(std::ssize(split), sheets.count);
  std::size_t points = 0, triangles = 0;
  double area = 0;
  for (const TriMesh& sheet : split) {
    const SurfaceCheck check = check_surface(sheet);
    EXPECT_TRUE(check.manifold());
    EXPECT_EQ(check.components, 1);
    points += sheet.points.size();
    triangles += sheet.triangles.size();
    area += check.area;
  }
  EXPECT_EQ(points, sheets.surface.points.size());
  EXPECT_EQ(triangles, sheets.surface.triangles.size());
  EXPECT_NEAR(area, 8, 1e-9);  // the cube and two walls in it
  EXPECT_TRUE(split_sheets(sheets, {})[0].triangles.empty());
}

TEST(Sheets, RefuseWhatIsNoPartition) {
  const PartitionSurface good = slabs();
  PartitionSurface bad = good;
  bad.sides.pop_back();
  EXPECT_REFUSED(cut_into_sheets(bad), testing::HasSubstr("pair of sides"));
  bad = good;
  bad.sides[0] = {7, 9};
  EXPECT_REFUSED(cut_into_sheets(bad), testing::HasSubstr("sides differ"));
  bad = good;
  std::swap(bad.triangles[0][1], bad.triangles[0][2]);
  EXPECT_REFUSED(cut_into_sheets(bad), testing::HasSubstr("opposite"));
  bad = good;
  bad.triangles[0][1] = bad.triangles[0][2];
  EXPECT_REFUSED(cut_into_sheets(bad), testing::HasSubstr("repeated corner"));
  bad.triangles[0][1] = 1 << 30;
  EXPECT_REFUSED(cut_into_sheets(bad), testing::HasSubstr("point"));
}

}  // namespace
}  // namespace mesamis
