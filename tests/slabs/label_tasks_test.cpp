// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/label_tasks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "mesamis/surface/label_parts.h"
#include "slabs/touching_balls.h"
#include "support/label_grids.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

/// A label map that is cut into slabs, and what its tasks leave.
class LabelTasks : public testing::Test {
 protected:
  const TempFolder folder;
  const Scratch scratch{folder.path()};

  static LabelBlock block_of(const LabelMap& map) { return *block_around(map, map.segments, 0); }
  static GridMemberships whole_memberships(const LabelMap& map) {
    const LabelBlock block = block_of(map);
    return smooth_memberships({block.size, map.spacing, labels_in(map, 0, block)});
  }
  LayerRun begin(const StoredLabels& stored, const LabelBlock& block, std::vector<Index> cuts) {
    LayerRun run{stored, scratch, 0, block, std::move(cuts)};
    make_part_file(run);
    for (Index s = 0; s < run.count(); ++s) find_parts(run, s);
    for (Index s = 0; s + 1 < run.count(); ++s) join_parts(run, s);
    learn_parts(run);
    return run;
  }
  /// Memberships and boundaries, with the constants that match the volumes.
  VolumeMatch smooth(const LayerRun& run) {
    for (Index s = 0; s < run.count(); ++s) find_wishes(run, s);
    let_yield(run);
    for (Index s = 0; s < run.count(); ++s) smooth_slab(run, s);
    VolumeMatch match(volumes_of(run.parts.eighths, run.source.head().spacing), run.smoothing);
    do {
      for (Index s = 0; s < run.count(); ++s) measure_slab(run, match, s);
    } while (match.improve(layers_of_slabs(run, match)));
    for (Index s = 0; s < run.count(); ++s) extract_slab(run, match, s);
    return match;
  }
};

/// Even slabs.
std::vector<Index> cuts_into(Index slices, Index slabs) {
  std::vector<Index> cuts;
  for (Index s = 0; s <= slabs; ++s) cuts.push_back(slices * s / slabs);
  return cuts;
}

/// Blobs of several labels, some wrong voxels, parts that wind through many slices.
LabelMap noisy_blobs() {
  OwnedLabels blobs = random_blobs(26, 5, 5);
  std::mt19937 generator(11);
  for (std::uint16_t& label : blobs.labels) {
    if (generator() % 25 == 0) label = static_cast<std::uint16_t>(generator() % 5);
  }
  LabelMap map;
  map.size = {26, 26, 26};
  map.layers.push_back(blobs.labels);
  return with_all_segments(map);
}

void expect_same(const PartitionSurface& found, const PartitionSurface& expected) {
  EXPECT_TRUE(found.points == expected.points);
  EXPECT_TRUE(found.triangles == expected.triangles);
  EXPECT_TRUE(found.sides == expected.sides);
}

TEST_F(LabelTasks, FindThePartsOfTheWhole) {
  const LabelMap map = noisy_blobs();
  const LabelBlock block = block_of(map);
  const auto labels = labels_in(map, 0, block);
  const LabelParts whole = find_label_parts({block.size, map.spacing, labels});
  std::vector<std::int64_t> nodes(whole.label.size(), 0);
  for (const Index part : whole.of_node) ++nodes[part];
  store_labels(scratch, map);
  const StoredLabels stored(scratch);
  for (const Index slabs : {1, 2, 5}) {
    const LayerRun run = begin(stored, block, cuts_into(block.size[2], slabs));
    EXPECT_EQ(run.parts.label, whole.label) << slabs;
    EXPECT_EQ(run.parts.nodes, nodes) << slabs;
  }
}

/// The order in which nodes yield, the volumes of all parts and the numbers of the points are those
/// of the whole, wherever it is cut.
TEST_F(LabelTasks, ExtractTheBoundariesOfTheWhole) {
  for (const LabelMap& map : {touching_balls(), noisy_blobs()}) {
    const PartitionSurface whole = extract_partition_on_grid(whole_memberships(map));
    const NetOptions of_net{.chosen = {0, 1}};
    const PartitionSurface net = extract_net_on_grid(whole_memberships(map), of_net);
    ASSERT_FALSE(whole.triangles.empty());
    store_labels(scratch, map);
    const StoredLabels stored(scratch);
    const LabelBlock block = block_of(map);
    for (const Index slabs : {1, 3, 7}) {
      LayerRun run = begin(stored, block, cuts_into(block.size[2], slabs));
      SCOPED_TRACE(slabs);
      smooth(run);
      expect_same(joined_boundaries(run), whole);
      run.net = of_net;
      smooth(run);
      expect_same(joined_boundaries(run), net);
    }
  }
}

/// Memory: a task holds its own slices and those in reach, whatever the size of the map.
TEST_F(LabelTasks, HoldTheirSlicesAndThoseInReach) {
  LabelMap map;
  map.size = {6, 6, 150};
  map.layers.emplace_back(map.voxel_count(), std::uint16_t{1});
  map.segments = {{"rod", 1, 0, {}}};
  store_labels(scratch, map);
  const StoredLabels stored(scratch);
  const LabelBlock block{{0, 0, 0}, map.size};
  LayerRun run = begin(stored, block, cuts_into(150, 10));
  const Index reach = smoothing_reach({});
  EXPECT_EQ(reach, 14);
  const std::int64_t slice = 36;
  EXPECT_EQ(find_parts(run, 4).voxels, slice * 15);
  EXPECT_EQ(find_wishes(run, 4).voxels, slice * (15 + 2 * 10));
  for (Index s = 0; s < 10; ++s) find_wishes(run, s);
  EXPECT_EQ(let_yield(run).voxels, slice * (15 + 2 * 2)) << "one slab at a time";
  for (const Index s : {3, 5}) smooth_slab(run, s);
  EXPECT_EQ(smooth_slab(run, 4).voxels, slice * (15 + 1 + 2 * reach));
  const VolumeMatch match(volumes_of(run.parts.eighths, map.spacing), run.smoothing);
  EXPECT_EQ(measure_slab(run, match, 4).voxels, slice * (15 + 1));
  EXPECT_EQ(extract_slab(run, match, 4).voxels, slice * (15 + 1));
  run.net = NetOptions{};
  EXPECT_EQ(extract_slab(run, match, 4).voxels, slice * (15 + 3));
}

}  // namespace
}  // namespace mesamis
