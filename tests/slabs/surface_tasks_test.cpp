// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/surface_tasks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesamis/method/follow_image.h"
#include "mesamis/slabs/point_numbers.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "slabs/three_slabs.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

using ExtractSlab = OnMeshedSlabs;
using FinalMesh = OnMeshedSlabs;
using FollowSlab = OnMeshedSlabs;
using FollowBorder = OnMeshedSlabs;
using SurfaceTasks = OnMeshedSlabs;

TEST_F(ExtractSlab, PiecesFitAndAreTheSurfaceOfTheWholeMesh) {
  ThreeSlabs slabs;
  slabs.mesh->prepared.parameters.fit =
      false;  // nodes at borders could not be moved onto the surface
  slabs.extract();
  const SurfacePiece joined = slabs.extracted();
  const TriMesh surface = mesh_of(joined, &detail::slabs::SurfacePoint::key),
                whole = slabs.whole_surface();
  EXPECT_EQ(solid_flaws_of(check_surface(surface)), "");
  EXPECT_EQ(surface.points.size(), whole.points.size());
  EXPECT_EQ(surface.triangles.size(), whole.triangles.size());
  EXPECT_NEAR(check_surface(surface).volume / check_surface(whole).volume, 1, 1e-9);
  EXPECT_LT(max_distance(surface, whole, 1e-9), 1e-6);
}

TEST_F(ExtractSlab, PiecesFitWhereNodesWereMovedOntoTheSurface) {
  ThreeSlabs slabs;
  slabs.extract();
  const TriMesh surface = mesh_of(slabs.extracted(), &detail::slabs::SurfacePoint::key),
                whole = slabs.whole_surface();
  slabs.mesh->prepared.parameters.fit = false;
  EXPECT_EQ(solid_flaws_of(check_surface(surface)), "");
  EXPECT_TRUE(find_self_intersections(surface).empty());
  EXPECT_LT(surface.points.size(), 0.9 * static_cast<double>(slabs.whole_surface().points.size()));
  EXPECT_LT(static_cast<double>(surface.points.size()),
            1.03 * static_cast<double>(whole.points.size()));
}

// Else the surface would have a crack there.
TEST_F(FinalMesh, NodesOfTwoSlabsHaveOneValue) {
  ThreeSlabs slabs;
  SlabWork work;
  int common = 0;
  for (Index s = 1; s < 3; ++s) {
    const Piece low = final_mesh(*slabs.run, s - 1, work), high = final_mesh(*slabs.run, s, work);
    PointNumbers numbers;
    for (const Vec3& p : low.mesh.points) (void)numbers.of(p);
    for (std::size_t n = 0; n < high.nodes.size(); ++n) {
      const Index other = numbers.find(high.mesh.points[n]);
      if (other == kNoIndex) continue;
      ++common;
      EXPECT_EQ(high.nodes[n].u, low.nodes[static_cast<std::size_t>(other)].u);
    }
  }
  EXPECT_GT(common, 40);
}

TEST_F(FollowSlab, PiecesFitAndLieWhereTheWholeWouldLie) {
  ThreeSlabs slabs;
  slabs.extract();
  ASSERT_TRUE(slabs.run->follows);
  slabs.follow();
  const RunInput& input = slabs.mesh->input;
  const TriMesh surface = followed_surface(*slabs.run);
  EXPECT_EQ(solid_flaws_of(check_surface(surface)), "");
  EXPECT_TRUE(find_self_intersections(surface).empty());
  const Parameters& p = input.parameters;
  ASSERT_TRUE(p.follow && p.fit);
  TriMesh whole = follow_image(slabs.whole_surface(), input.image,
                               {p.grey.to_grey(p.level), input.noise, p.unit_mm, true, true});
  bring_to_world(input, whole.points);
  EXPECT_NEAR(static_cast<double>(surface.points.size()) / static_cast<double>(whole.points.size()),
              1, 0.01);
  const std::vector<double> apart = distances_to_surface(surface.points, whole);
  // Near borders the means that tell noise from shape are of fewer points.
  EXPECT_LT(mean_of(apart), 0.004) << "voxels, of 1 mm";
  EXPECT_LT(*std::max_element(apart.begin(), apart.end()), 0.4);
}

// Else a point near a border would be moved by no task, or by two.
TEST_F(FollowBorder, MovesWhatTheSlabsHaveLeft) {
  ThreeSlabs slabs;
  slabs.extract();
  slabs.follow();
  int moved = 0, points = 0;
  for (Index s = 0; s < 2; ++s) {
    const SurfacePiece border = read_surface(slabs.small.scratch, surface_file("border", s));
    for (const detail::slabs::SurfacePoint& p : border.points) {
      ++points;
      moved += p.at != p.key;
      EXPECT_LT(norm(p.at - p.key), (0.7 + 0.25) * slabs.voxel() + 1e-9);
    }
  }
  EXPECT_GT(points, 50);
  EXPECT_GT(moved, 0.9 * points);
}

/// The heights of the points that a task on a border may move.
HeightRange free_heights(const SurfacePiece& piece) {
  HeightRange heights{1e9, -1e9};
  for (const detail::slabs::SurfacePoint& p : piece.points) {
    if (p.settled) continue;
    heights = {std::min(heights.low, p.key.z), std::max(heights.high, p.key.z)};
  }
  return heights;
}

TEST_F(FollowSlab, TheTasksOfTwoBordersHaveNoPointInCommon) {
  ThreeSlabs slabs;
  slabs.extract();
  slabs.follow();
  const Scratch& scratch = slabs.small.scratch;
  EXPECT_TRUE(read_surface(scratch, surface_file("low", 0)).triangles.empty());
  EXPECT_TRUE(read_surface(scratch, surface_file("high", 2)).triangles.empty());
  const HeightRange low = free_heights(read_surface(scratch, surface_file("low", 1)));
  const HeightRange high = free_heights(read_surface(scratch, surface_file("high", 1)));
  EXPECT_LT(low.low, low.high);
  EXPECT_LT(low.high, high.low);
}

TEST_F(SurfaceTasks, RefuseFilesThatAreCutOff) {
  ThreeSlabs slabs;
  slabs.extract();
  const auto file = slabs.small.scratch.path(surface_file("extracted", 1));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_REFUSED(follow_slab(*slabs.run, 1), HasSubstr("extracted.1: "));
}

}  // namespace
}  // namespace mesamis
