// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/labels_in_slabs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "mesamis/base/parallel.h"
#include "mesamis/base/version.h"
#include "slabs/thread_ranks.h"
#include "slabs/touching_balls.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

/// Those that are chosen: by default all.
LabelSlabRequest request_for(const LabelMap& map, std::vector<Segment> chosen = {}) {
  return {[&map] { return ReadLabels{map}; },
          [chosen](const LabelMap& head) { return chosen.empty() ? head.segments : chosen; }};
}

void expect_same(const LabelResult& found, const LabelResult& expected) {
  ASSERT_EQ(found.objects.size(), expected.objects.size());
  for (std::size_t n = 0; n < expected.objects.size(); ++n) {
    EXPECT_EQ(found.objects[n].segment, expected.objects[n].segment);
    EXPECT_TRUE(found.objects[n].surface.points == expected.objects[n].surface.points);
    EXPECT_TRUE(found.objects[n].surface.triangles == expected.objects[n].surface.triangles);
    EXPECT_EQ(found.objects[n].triangles_extracted, expected.objects[n].triangles_extracted);
  }
  EXPECT_EQ(found.parameters.tolerance, expected.parameters.tolerance);
  EXPECT_EQ(found.decimated, expected.decimated);
  EXPECT_EQ(found.has_image, expected.has_image);
}

/// Without decimation, which all slabs' boundaries go through together.
Settings all_triangles() {
  Settings settings;
  settings.tolerance = 0;
  return settings;
}

struct Balls {
  LabelMap map = touching_balls();
  LabelResult whole = surfaces_of_labels({map}, all_triangles());
};

const Balls& balls() {
  static const Balls balls;
  return balls;
}

TEST(LabelsInSlabs, HaveTheBitsOfTheWholeForAnyNumberOfSlabsAndThreads) {
  ASSERT_EQ(balls().whole.objects.size(), 2u);
  for (const Index slabs : {1, 2, 3}) {
    {
      const int threads = slabs % 2 + 1;
      const TempFolder folder;
      const auto found = with_threads(threads, [&] {
        return label_surfaces_in_slabs(request_for(balls().map), all_triangles(),
                                       {.slabs = slabs, .scratch = folder.path()}, alone());
      });
      ASSERT_TRUE(found);
      SCOPED_TRACE(std::to_string(slabs) + " slabs, " + std::to_string(threads) + " threads");
      expect_same(found->result, balls().whole);
      EXPECT_EQ(found->slabs.size(), static_cast<std::size_t>(slabs));
      EXPECT_EQ(std::ssize(found->cuts), slabs + 1);
      EXPECT_FALSE(std::filesystem::exists(folder.path() / "mesamis-slabs"));
    }
  }
}

TEST(LabelsInSlabs, HaveTheBitsOfTheWholeForAnyNumberOfRanks) {
  for (const int ranks : {2, 5}) {
    const TempFolder folder;
    const SlabRunOptions options{.slabs = 3, .scratch = folder.path()};
    const auto found = results_of_ranks<LabelSlabResult>(ranks, [&](Team& team) {
      return label_surfaces_in_slabs(request_for(balls().map), all_triangles(), options, team);
    });
    ASSERT_TRUE(found[0]);
    for (std::size_t rank = 1; rank < found.size(); ++rank) EXPECT_FALSE(found[rank]);
    expect_same(found[0]->result, balls().whole);
  }
}

/// An oblique sheet, one voxel thick, through all slabs.
TEST(LabelsInSlabs, JoinThinObjectsAsInTheWhole) {
  LabelMap map = touching_balls();
  map.segments = {{"sheet", 1, 0, {}}};
  for (std::size_t n = 0; n < map.voxel_count(); ++n) {
    const auto [i, j, k] = map.voxel(n);
    const bool within = i > 2 && i + 3 < map.size[0] && j > 2 && j + 3 < map.size[1] && k > 2 &&
                        k + 3 < map.size[2];
    map.layers[0][n] = within && 3 * (i + k) + 2 * j >= 96 && 3 * (i + k) + 2 * j < 99 ? 1 : 0;
  }
  const LabelResult whole = surfaces_of_labels({map}, all_triangles());
  Settings as_it_is = all_triangles();
  as_it_is.keep_topology = true;
  EXPECT_FALSE(surfaces_of_labels({map}, as_it_is).objects[0].surface.points ==
               whole.objects[0].surface.points);
  for (const Index slabs : {2, 5}) {
    const TempFolder folder;
    const auto found = label_surfaces_in_slabs(request_for(map), all_triangles(),
                                               {.slabs = slabs, .scratch = folder.path()}, alone());
    ASSERT_TRUE(found);
    expect_same(found->result, whole);
  }
}

/// A scan of the balls with finer voxels, askew to those of the labels, whose edges are noisy and
/// lie half a voxel farther out.
Volume scan_of_balls() {
  Volume scan;
  scan.size = {20, 19, 34};
  scan.spacing = {0.85, 0.95, 1};
  scan.origin = {2.8, -4.3, 4.9};
  std::minstd_rand generator(3);
  for (std::size_t n = 0; n < scan.voxel_count(); ++n) {
    const auto [i, j, k] = scan.voxel(n);
    const Vec3 p = scan.to_world({i * scan.spacing.x, j * scan.spacing.y, k * scan.spacing.z}) -
                   Vec3{3, -4, 5};
    const double first = 6.5 - norm(p - Vec3{7, 7, 9}), second = 8 - norm(p - Vec3{8.5, 9, 22});
    const double inside = std::clamp(std::max(first, second) + 0.5, 0.0, 1.0);
    const double noise = static_cast<double>(generator() % 1000) / 50 - 10;
    scan.samples.push_back(static_cast<float>(300 * inside + (first < second ? 60 : 0) + noise));
  }
  return scan;
}

/// The image places what slabs have extracted.
TEST(LabelsInSlabs, AreFittedToAScanAsInTheWhole) {
  const LabelMap& map = balls().map;
  const Volume scan = scan_of_balls();
  const Settings settings = all_triangles();
  const LabelResult whole = find_labelled_objects(scan, {map}, settings);
  ASSERT_EQ(whole.objects.size(), 2u);
  EXPECT_FALSE(whole.objects[0].surface.points == balls().whole.objects[0].surface.points);
  LabelSlabRequest request = request_for(map);
  request.scan = scan;
  request.find = [&](const LabelRequest& extracted) {
    return find_labelled_objects(scan, extracted, settings);
  };
  for (const Index slabs : {1, 3}) {
    const TempFolder folder;
    const auto found = results_of_ranks<LabelSlabResult>(2, [&](Team& team) {
      return label_surfaces_in_slabs(request, settings, {.slabs = slabs, .scratch = folder.path()},
                                     team);
    });
    ASSERT_TRUE(found[0]);
    expect_same(found[0]->result, whole);
    EXPECT_EQ(found[0]->result.margin, whole.margin);
    EXPECT_EQ(found[0]->head.size, scan.size);
  }
}

/// Where labels flow, what is far away counts.
TEST(LabelsInSlabs, RefuseAScanThatTheyFlowIn) {
  const TempFolder folder;
  LabelSlabRequest request = request_for(balls().map);
  request.scan = scan_of_balls();
  request.scan->spacing = {0.5, 0.5, 0.5};
  const SlabRunOptions options{.scratch = folder.path(), .resumable = false};
  EXPECT_REFUSED(label_surfaces_in_slabs(request, all_triangles(), options, alone()),
                 HasSubstr("1.25 voxels of it, and no --no-fit, found coarser ones"));
  request.scan = scan_of_balls();
  Settings no_fit = all_triangles();
  no_fit.fit = false;
  EXPECT_REFUSED(label_surfaces_in_slabs(request, no_fit, options, alone()),
                 HasSubstr("found --no-fit"));
  request.margin = 1000;
  EXPECT_REFUSED(label_surfaces_in_slabs(request, all_triangles(), options, alone()),
                 HasSubstr("margin: expected more than 0 and at most"));
}

TEST(LabelsInSlabs, FindChosenObjectsOfSeveralLayers) {
  LabelMap map = touching_balls();
  map.layers.emplace_back(map.voxel_count(), std::uint16_t{0});
  for (std::size_t n = 0; n < map.voxel_count(); ++n) {
    const auto [i, j, k] = map.voxel(n);
    if (i > 4 && i < 20 && j > 5 && j < 17 && k > 3 && k < 30) map.layers[1][n] = 7;
  }
  map.segments.push_back({"box", 7, 1, {}});
  const std::vector<Segment> chosen{map.segments[1], map.segments[2]};
  const TempFolder folder;
  const auto found = label_surfaces_in_slabs(request_for(map, chosen), all_triangles(),
                                             {.slabs = 4, .scratch = folder.path()}, alone());
  ASSERT_TRUE(found);
  expect_same(found->result, surfaces_of_labels({map, chosen}, all_triangles()));
  EXPECT_EQ(found->chosen, chosen);
}

/// Decimation is that of the whole.
TEST(LabelsInSlabs, AreDecimatedTogether) {
  LabelMap map = touching_balls();
  for (std::uint16_t& label : map.layers[0]) label = label == 2 ? 0 : label;
  const TempFolder folder;
  const Settings settings;
  const auto found = label_surfaces_in_slabs(request_for(map), settings,
                                             {.slabs = 2, .scratch = folder.path()}, alone());
  ASSERT_TRUE(found);
  expect_same(found->result, surfaces_of_labels({map}, settings));
  EXPECT_LT(found->result.objects[0].surface.triangles.size(),
            static_cast<std::size_t>(found->result.objects[0].triangles_extracted));
}

/// The labels are read once.
TEST(LabelsInSlabs, GoOnWhereTheyWereStopped) {
  const TempFolder folder;
  int reads = 0;
  LabelSlabRequest request = request_for(balls().map);
  request.read = [&] {
    ++reads;
    return ReadLabels{balls().map, {"a warning"}};
  };
  SlabRunOptions options{.slabs = 3, .scratch = folder.path()};
  options.progress = [](std::string_view stage, double) {
    return stage.find("volumes 1") == std::string_view::npos;
  };
  EXPECT_THROW(label_surfaces_in_slabs(request, all_triangles(), options, alone()), Cancelled);
  options.progress = {};
  const auto found = label_surfaces_in_slabs(request, all_triangles(), options, alone());
  ASSERT_TRUE(found);
  expect_same(found->result, balls().whole);
  EXPECT_EQ(reads, 1);
  EXPECT_EQ(found->warnings, std::vector<std::string>{"a warning"});
}

TEST(LabelsInSlabs, RefuseWhatCannotBeDone) {
  const TempFolder folder;
  const auto run = [](const LabelSlabRequest& request, const SlabRunOptions& options) {
    label_surfaces_in_slabs(request, all_triangles(), options, alone());
  };
  const SlabRunOptions options{.scratch = folder.path(), .resumable = false};
  SlabRunOptions many = options, none = options;
  many.slabs = 30;  // of 48 slices
  none.turns = 0;
  LabelMap empty = balls().map;
  empty.segments.push_back({"nothing", 9, 0, {}});
  EXPECT_REFUSED(run(request_for(balls().map), many),
                 HasSubstr("slabs: expected at least 2 slices in each, found 30 slabs"));
  EXPECT_REFUSED(run(request_for(balls().map), none),
                 HasSubstr("slabs: expected at least 1 turn, found 0"));
  EXPECT_REFUSED(run(request_for(empty, {empty.segments.back()}), options),
                 HasSubstr("expected voxels of 'nothing' within the grid, found none"));
  EXPECT_REFUSED(run(request_for(balls().map, {empty.segments.back()}), options),
                 HasSubstr("found 'nothing' of another"));
}

}  // namespace
}  // namespace mesamis
