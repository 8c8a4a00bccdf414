// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/surface_tasks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesamis/decimate/decimate.h"
#include "mesamis/method/follow_image.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/slabs/mapped_items.h"
#include "mesamis/slabs/surface_files.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/extract.h"
#include "mesamis/surface/self_intersections.h"
#include "slabs/small_run.h"
#include "support/throws.h"

namespace mesamis::detail {
namespace {

using testing::HasSubstr;

/// Three slabs with their last mesh.
struct ThreeSlabs {
  ThreeSlabs() {
    make_item_file<float>(small.scratch.path(kImageFile), small.scan.voxel_count());
    each([&](Index s) { return prepare_and_minimise(small.run, s); });
    mesh.emplace(small.run);
    each([&](Index s) { return first_mesh(*mesh, s); });
    at_borders([&](Index s) { return seam(*mesh, 1, s); });
    each([&](Index s) { return finish(*mesh, 1, s); });
    run.emplace(SurfaceRun{*mesh, 1});
  }
  void each(const std::function<SlabWork(Index)>& task) {
    for (Index s = 0; s < 3; ++s) task(s);
  }
  void at_borders(const std::function<SlabWork(Index)>& task) {
    for (Index s = 0; s < 2; ++s) task(s);
  }
  void extract() {
    each([&](Index s) { return extract_slab(*run, s); });
    learn_follows(*run);
  }
  void follow() {
    each([&](Index s) { return follow_slab(*run, s); });
    at_borders([&](Index s) { return follow_border(*run, s); });
  }
  void choose() {
    each([&](Index s) { return list_parts(*run, s); });
    learn_parts(*run);
    each([&](Index s) { return cross_rays(*run, s); });
    learn_choice(*run, {});
  }
  void decimate(double tolerance) {
    run->tolerance = tolerance;
    each([&](Index s) { return decimate_slab(*run, s); });
    at_borders([&](Index s) { return decimate_border(*run, s); });
    each([&](Index s) { return measure_slab(*run, s); });
  }
  /// As it would be extracted from the whole mesh.
  TriMesh whole_surface() const {
    const Piece whole = collect(*mesh, 1);
    const Parameters& p = mesh->input.parameters;
    return extract_solid(whole.mesh, values_of(whole, &NodeValues::u), p.grey.to_grey(p.level));
  }
  SurfacePiece extracted() const {
    std::vector<SurfacePiece> pieces;
    for (Index s = 0; s < 3; ++s) {
      ArchiveReader archive = small.scratch.read(surface_file("extracted", s));
      (void)archive.next_one<FollowCounts>();
      pieces.push_back(next_surface(archive));
    }
    return join(pieces);
  }
  double voxel() const { return 1 / mesh->input.parameters.unit_mm; }

  SmallRun small{96, {0, 32, 64, 96}};
  std::optional<MeshRun> mesh;
  std::optional<SurfaceRun> run;
};

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(ExtractSlab, PiecesFitAndAreTheSurfaceOfTheWholeMesh) {
  ThreeSlabs slabs;
  slabs.extract();
  const SurfacePiece joined = slabs.extracted();
  const TriMesh surface = mesh_of(joined, &SurfacePoint::key), whole = slabs.whole_surface();
  EXPECT_EQ(solid_flaws_of(check_surface(surface)), "");
  EXPECT_EQ(surface.points.size(), whole.points.size());
  EXPECT_EQ(surface.triangles.size(), whole.triangles.size());
  EXPECT_NEAR(check_surface(surface).volume / check_surface(whole).volume, 1, 1e-9);
  EXPECT_LT(max_distance(surface, whole, 1e-9), 1e-6);
}

TEST(FollowSlab, PiecesFitAndLieWhereTheWholeWouldLie) {
  ThreeSlabs slabs;
  slabs.extract();
  ASSERT_TRUE(slabs.run->follows);
  slabs.follow();
  const RunInput& input = slabs.mesh->input;
  const TriMesh surface = followed_surface(*slabs.run);
  EXPECT_EQ(solid_flaws_of(check_surface(surface)), "");
  EXPECT_TRUE(find_self_intersections(surface).empty());
  const Parameters& p = input.parameters;
  TriMesh whole = follow_image(slabs.whole_surface(), input.image,
                               {p.grey.to_grey(p.level), input.error.noise, p.unit_mm});
  bring_to_world(input, whole.points);
  EXPECT_NEAR(static_cast<double>(surface.points.size()) / static_cast<double>(whole.points.size()),
              1, 0.01);
  const std::vector<double> apart = distances_to_surface(surface.points, whole);
  // Near borders the means that tell noise from shape are of fewer points.
  EXPECT_LT(mean_of(apart), 0.004) << "voxels, of 1 mm";
  EXPECT_LT(*std::max_element(apart.begin(), apart.end()), 0.4);
}

// Else a point near a border would be moved by no task, or by two.
TEST(FollowBorder, MovesWhatTheSlabsHaveLeft) {
  ThreeSlabs slabs;
  slabs.extract();
  slabs.follow();
  int moved = 0, points = 0;
  for (Index s = 0; s < 2; ++s) {
    const SurfacePiece border = read_surface(slabs.small.scratch, surface_file("border", s));
    for (const SurfacePoint& p : border.points) {
      ++points;
      moved += p.at != p.key;
      EXPECT_LT(norm(p.at - p.key), 0.7 * slabs.voxel() + 1e-9);
    }
  }
  EXPECT_GT(points, 50);
  EXPECT_GT(moved, 0.9 * points);
}

TEST(DecimateSlab, KeepsThePromisesOfDecimateAndLeavesNoSeams) {
  ThreeSlabs slabs;
  slabs.extract();
  slabs.follow();
  slabs.choose();
  constexpr double kTolerance = 0.1;
  slabs.decimate(kTolerance);
  const TriMesh before = followed_surface(*slabs.run), after = decimated_surface(*slabs.run);
  EXPECT_EQ(solid_flaws_of(check_surface(after)), "");
  EXPECT_TRUE(find_self_intersections(after).empty());
  EXPECT_LE(max_distance(before, after, 1e-3), kTolerance);
  EXPECT_LE(max_distance(after, before, 1e-3), kTolerance);
  const TriMesh whole = decimate(before, {.tolerance = kTolerance});
  EXPECT_LT(static_cast<double>(after.triangles.size()),
            1.1 * static_cast<double>(whole.triangles.size()));
  const PrintableReport report = printable_report(*slabs.run);
  EXPECT_EQ(report.triangles_extracted, std::ssize(before.triangles));
  EXPECT_TRUE(report.within(kTolerance));
  EXPECT_NEAR(report.extracted_to_result, max_distance(before, after, 1e-3), 2e-3);
  EXPECT_NEAR(report.result_to_extracted, max_distance(after, before, 1e-3), 2e-3);
  EXPECT_EQ(report.parts->islands, 1);
}

TEST(FindGrey, IsThatOfTheWholeMesh) {
  ThreeSlabs slabs;
  slabs.extract();
  slabs.follow();
  slabs.choose();
  slabs.decimate(0.1);
  slabs.each([&](Index s) { return find_grey(*slabs.run, s); });
  Result whole;
  whole.surface = decimated_surface(*slabs.run);
  const Piece mesh = collect(*slabs.mesh, 1);
  whole.mesh = mesh.mesh;
  bring_to_world(slabs.mesh->input, whole.mesh.points);
  whole.u = values_of(mesh, &NodeValues::u);
  const std::vector<double> expected = surface_grey(whole, 1);
  const std::vector<double> found = grey_of(*slabs.run, whole.surface);
  ASSERT_EQ(found.size(), expected.size());
  // The surface is rounded in one, and values at borders are those of two slabs in the other.
  for (std::size_t p = 0; p < found.size(); ++p) EXPECT_NEAR(found[p], expected[p], 1) << p;
}

TEST(SurfaceTasks, RefuseFilesThatAreCutOff) {
  ThreeSlabs slabs;
  slabs.extract();
  const auto file = slabs.small.scratch.path(surface_file("extracted", 1));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_REFUSED(follow_slab(*slabs.run, 1), HasSubstr("extracted.1: "));
}

}  // namespace
}  // namespace mesamis::detail
