// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/label_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "mesamis/base/parallel.h"
#include "mesamis/base/types.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::Each;
using testing::HasSubstr;

/// A grid turned about two axes, with three different spacings.
VoxelGrid oblique_grid() {
  const double c = std::cos(0.4), s = std::sin(0.4), e = std::cos(-1.1), f = std::sin(-1.1);
  VoxelGrid grid;
  grid.size = {7, 6, 5};
  grid.spacing = {0.75, 1.25, 2};
  grid.origin = {-3, 14, 105.5};
  grid.direction = Mat3{{Vec3{c, -s * e, s * f}, Vec3{s, c * e, -c * f}, Vec3{0, f, e}}};
  return grid;
}

LabelMap random_map(const VoxelGrid& grid, std::size_t layers = 1, int most = 4) {
  LabelMap map{grid, {}, {}};
  std::mt19937 random(3);
  map.layers.resize(layers, std::vector<std::uint16_t>(grid.voxel_count()));
  for (auto& layer : map.layers) {
    for (auto& label : layer) {
      label = static_cast<std::uint16_t>(random() % static_cast<unsigned>(most + 1));
    }
  }
  return with_all_segments(map);
}

Vec3 centre(const VoxelGrid& grid, double i, double j, double k) {
  return grid.to_world({i * grid.spacing.x, j * grid.spacing.y, k * grid.spacing.z});
}

TEST(LabelMap, OnItsOwnGridIsTheSame) {
  const LabelMap map = random_map(oblique_grid(), 2);
  const LabelMap same = labels_on(map, map);
  EXPECT_EQ(same.layers, map.layers);
  EXPECT_EQ(same.segments, map.segments);
  EXPECT_EQ(same.origin, map.origin);
}

TEST(LabelMap, OnAnotherGridIsTheLabelAtEachCentre) {
  const LabelMap map = random_map(oblique_grid(), 2);
  VoxelGrid grid;
  grid.size = {23, 17, 19};
  grid.spacing = {0.6, 0.9, 0.7};
  grid.origin = centre(map, 3, 3, 2) - Vec3{6, 7, 6};
  const LabelMap on = labels_on(map, grid);
  std::size_t inside = 0;
  for (Index layer = 0; layer < 2; ++layer) {
    for (Index k = 0; k < grid.size[2]; ++k) {
      for (Index j = 0; j < grid.size[1]; ++j) {
        for (Index i = 0; i < grid.size[0]; ++i) {
          const Index label = label_at(map, layer, centre(grid, i, j, k));
          ASSERT_EQ(on.layers[static_cast<std::size_t>(layer)][grid.offset(i, j, k)], label);
          inside += label > 0;
        }
      }
    }
  }
  EXPECT_GT(inside, 100u);
}

TEST(LabelMap, HasItsLabelsWithinHalfAVoxelOfEachCentre) {
  const LabelMap map = random_map(oblique_grid());
  for (const double away : {-0.49, 0.0, 0.49}) {
    for (Index n = 0; n < 5; ++n) {
      EXPECT_EQ(label_at(map, 0, centre(map, n + away, n - away, 4 + away)),
                map.layers[0][map.offset(n, n, 4)]);
    }
  }
  EXPECT_EQ(label_at(map, 0, centre(map, -0.51, 2, 2)), 0);
  EXPECT_EQ(label_at(map, 0, centre(map, 2, 5.51, 2)), 0);
  EXPECT_EQ(label_at(map, 0, {std::nan(""), 0, 0}), 0);
}

TEST(LabelMap, ShiftedByHalfAVoxelTakesTheGreaterIndex) {
  const LabelMap map = random_map(oblique_grid());
  VoxelGrid grid = map;
  grid.origin = centre(map, 0.5, 0, 0);
  const LabelMap on = labels_on(map, grid);
  for (Index k = 0; k < 5; ++k) {
    for (Index j = 0; j < 6; ++j) {
      for (Index i = 0; i < 7; ++i) {
        const Index expected = i + 1 < 7 ? map.layers[0][map.offset(i + 1, j, k)] : 0;
        ASSERT_EQ(on.layers[0][map.offset(i, j, k)], expected);
      }
    }
  }
}

TEST(LabelMap, IsTheSameInFlippedAxes) {
  const LabelMap map = random_map(oblique_grid());
  LabelMap flipped = map;  // the same voxels stored from the other end of i, as another frame would
  flipped.origin = centre(map, 6, 0, 0);
  for (Vec3& row : flipped.direction.rows) row.x = -row.x;
  for (Index k = 0; k < 5; ++k) {
    for (Index j = 0; j < 6; ++j) {
      for (Index i = 0; i < 7; ++i) {
        flipped.layers[0][map.offset(6 - i, j, k)] = map.layers[0][map.offset(i, j, k)];
      }
    }
  }
  EXPECT_EQ(labels_on(flipped, map).layers, map.layers);
}

TEST(LabelMap, FinerGridKeepsTheVolume) {
  const LabelMap map = random_map(oblique_grid());
  VoxelGrid fine = map;
  fine.size = {21, 18, 15};
  fine.spacing = (1.0 / 3) * map.spacing;
  fine.origin = centre(map, -1.0 / 3, -1.0 / 3, -1.0 / 3);
  const auto mask = mask_on(map, map.segments, fine);
  const auto coarse = mask_on(map, map.segments, map);
  const auto count = [](const auto& m) { return std::count(m.begin(), m.end(), 1); };
  EXPECT_GT(count(coarse), 0);
  EXPECT_EQ(count(mask), 27 * count(coarse));
}

TEST(LabelMap, MaskIsTheUnionOfItsSegments) {
  const LabelMap map = random_map(oblique_grid(), 2);
  const std::vector<Segment> wanted{map.segments[0], map.segments[2], map.segments[5]};
  ASSERT_EQ(wanted[2].layer, 1);
  const auto mask = mask_on(map, wanted, map);
  for (std::size_t n = 0; n < mask.size(); ++n) {
    const bool in = map.layers[0][n] == wanted[0].label || map.layers[0][n] == wanted[1].label ||
                    map.layers[1][n] == wanted[2].label;
    ASSERT_EQ(mask[n], in ? 1 : 0);
  }
  EXPECT_THAT(mask_on(map, {}, map), Each(0));
}

TEST(LabelMap, IsTheSameForAnyNumberOfThreads) {
  const LabelMap map = random_map(oblique_grid());
  VoxelGrid grid = map;
  grid.size = {40, 40, 40};
  grid.spacing = {0.1, 0.2, 0.3};
  const auto one = with_threads(1, [&] { return labels_on(map, grid); });
  EXPECT_EQ(one.layers, labels_on(map, grid).layers);
}

TEST(LabelMap, RangeHoldsTheSegmentTightly) {
  LabelMap map{oblique_grid(), {}, {}};
  map.layers.assign(1, std::vector<std::uint16_t>(map.voxel_count()));
  map.layers[0][map.offset(2, 1, 4)] = 7;
  map.layers[0][map.offset(5, 1, 3)] = 7;
  map.layers[0][map.offset(0, 0, 0)] = 6;
  const Segment seven{"seven", 7, 0, {}}, eight{"eight", 8, 0, {}};
  EXPECT_EQ(range_of(map, seven), (CropRange{{2, 1, 3}, {6, 2, 5}}));
  EXPECT_EQ(range_of(map, eight), std::nullopt);
  map.layers.push_back(map.layers[0]);
  map.layers[1][map.offset(6, 5, 4)] = 7;
  map.segments = {eight, seven, {"seven", 7, 1, {}}};
  const auto ranges = ranges_of(map);
  ASSERT_EQ(ranges.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(ranges[n], range_of(map, map.segments[n]));
  EXPECT_EQ(ranges[2], (CropRange{{2, 1, 3}, {7, 6, 5}}));
}

TEST(LabelMap, NamesLabelsThatHaveNone) {
  LabelMap map{oblique_grid(), {}, {{"bone", 3, 0, {1, 2, 3}}}};
  map.layers.assign(2, std::vector<std::uint16_t>(map.voxel_count()));
  map.layers[0][4] = 3;
  map.layers[0][5] = 65535;
  map.layers[1][5] = 3;
  EXPECT_REFUSED(require_valid(map), HasSubstr("segment for the label 65535 of layer 0"));
  const LabelMap all = with_all_segments(map);
  ASSERT_EQ(all.segments.size(), 3u);
  EXPECT_EQ(all.segments[0], map.segments[0]);
  EXPECT_EQ(all.segments[1].name, "label 65535");
  EXPECT_EQ(all.segments[2].layer, 1);
  EXPECT_NO_THROW(require_valid(all));
  const std::vector<Segment> table{{"hip", 3, 0, {9, 9, 9}}, {"other", 4, 0, {}}};
  const LabelMap named = with_names(all, table);
  ASSERT_EQ(named.segments.size(), 3u);
  EXPECT_EQ(named.segments[0], (Segment{"hip", 3, 0, {9, 9, 9}}));
  EXPECT_EQ(named.segments[1].name, "label 65535");
  EXPECT_EQ(named.segments[2].name, "hip");
}

TEST(LabelMap, HasNoMoreSegmentsThanLabels) {
  LabelMap map;
  map.size = {40000, 1, 1};
  map.layers.assign(2, std::vector<std::uint16_t>(40000));
  for (std::size_t n = 0; n < 40000; ++n) {
    map.layers[0][n] = static_cast<std::uint16_t>(n);
    map.layers[1][n] = static_cast<std::uint16_t>(n < 25537 ? n : 0);
  }
  EXPECT_EQ(with_all_segments(map).segments.size(), 65535u);
  map.layers[1][0] = 25537;
  EXPECT_REFUSED(with_all_segments(map), HasSubstr("at most 65535 segments"));
}

TEST(LabelMap, CountsTheVoxelsOfEachSegment) {
  LabelMap map;
  map.size = {4, 1, 1};
  map.layers = {{0, 3, 3, 7}, {7, 0, 0, 0}};
  map.segments = {{"a", 7, 1}, {"b", 3, 0}, {"c", 7, 0}, {"none", 9, 0}};
  EXPECT_EQ(voxel_counts(map), (std::vector<std::size_t>{1, 2, 1, 0}));
}

TEST(LabelMap, CountsNeighboursOfOtherLabels) {
  LabelMap map;
  map.size = {2, 2, 3};
  map.layers = {{1, 1, 0, 0, 2, 1, 0, 0, 0, 0, 0, 0}};
  const LabelPairs pairs = count_pairs(map);
  EXPECT_EQ(pairs.all, 10U) << "2 along i, 4 along j, 4 along k";
  EXPECT_EQ(pairs.different, 8U) << "1, 4 and 3";
}

TEST(LabelMap, LabelsAreWholeAndMostlyLikeTheirNeighbours) {
  const VoxelGrid row{{12, 1, 1}};
  const auto look = [&](const std::vector<float>& samples) {
    return look_like_labels(row, samples);
  };
  EXPECT_TRUE(look({0, 0, 5, 5, 5, 5, 5, 5, 7, 7, 7, 0}));
  EXPECT_TRUE(look({0, 0, 3.00005f, 3, 3, 3, -0.001f, 0, 0, 0, 0, 0}));
  EXPECT_TRUE(look({0, 255, 0, 255, 0, 0, 0, 0, 0, 0, 0, 255}));
  EXPECT_FALSE(look({0, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 6}));
  EXPECT_FALSE(look({0, 0, 31, 32, 33, 31, 30, 35, 36, 33, 30, 0}));
  EXPECT_FALSE(look({-1, -1, -1, 5, 5, 5, 5, 5, 5, 5, 5, 5}));
  EXPECT_FALSE(look({0, 0, 0.5f, 0.5f, 1, 1, 1, 1, 1, 0, 0, 0}));
  EXPECT_FALSE(look(std::vector<float>(12, 0)));
  EXPECT_FALSE(look(std::vector<float>(12, std::numeric_limits<float>::quiet_NaN())));
}

TEST(LabelMap, NumbersInTheFileFindTheirNames) {
  LabelMap map;
  map.segments = {{"label 70000", 1, 0, {}, 70000}, {"label 2", 2}};
  const std::vector<Segment> table{{"liver", 0, 0, {1, 2, 3}, 70000}, {"wrong", 1}, {"hip", 2}};
  map = with_names(std::move(map), table);
  EXPECT_EQ(map.segments[0], (Segment{"liver", 1, 0, {1, 2, 3}, 70000}));
  EXPECT_EQ(map.segments[1].name, "hip");
  EXPECT_EQ(find_segment(map.segments, "70000").label, 1);
}

TEST(LabelMap, DefaultColoursDiffer) {
  std::set<std::array<std::uint8_t, 3>> colours;
  for (Index label = 1; label <= 50; ++label) colours.insert(default_colour(label));
  EXPECT_GE(colours.size(), 49u);
  EXPECT_EQ(default_colour(7), default_colour(7));
}

TEST(LabelMap, ThatBreaksItsPromisesIsRefused) {
  const LabelMap good = random_map(oblique_grid());
  const auto refused = [&good](auto spoil, const char* why) {
    LabelMap map = good;
    spoil(map);
    EXPECT_REFUSED(require_valid(map), HasSubstr(why));
  };
  refused([](LabelMap& m) { m.layers.clear(); }, "at least one layer");
  refused([](LabelMap& m) { m.layers[0].pop_back(); }, "210 labels in each layer, found 209");
  refused([](LabelMap& m) { m.segments[0].label = 0; }, "labels of 1 to 65535, found 0");
  refused([](LabelMap& m) { m.segments[0].label = 65536; }, "found 65536");
  refused([](LabelMap& m) { m.segments[0].layer = 1; }, "found layer 1");
  refused([](LabelMap& m) { m.segments[0].name = ""; }, "a name for the label 1");
  refused([](LabelMap& m) { m.segments[0].label = 2; }, "two for label 2 of layer 0");
  refused([](LabelMap& m) { m.segments.pop_back(); }, "segment for the label 4");
}

TEST(Probabilities, AreLinearBetweenVoxelsAndZeroOutside) {
  Probabilities from{oblique_grid(), {}, {{"bone", 1, 0, {}}}};
  from.layers.resize(1);
  const auto value = [](const Vec3& p) { return 0.5 + 0.01 * p.x - 0.02 * p.y + 0.015 * p.z; };
  for (Index k = 0; k < 5; ++k) {
    for (Index j = 0; j < 6; ++j) {
      for (Index i = 0; i < 7; ++i) {
        from.layers[0].push_back(static_cast<float>(value({double(i), double(j), double(k)})));
      }
    }
  }
  VoxelGrid grid = from;  // between the voxels, and some of it outside
  grid.origin = centre(from, 0.5, 0.25, 0.75);
  const auto on = probability_on(from, 0, grid);
  for (Index k = 0; k < 4; ++k) {
    EXPECT_NEAR(on[grid.offset(3, 2, k)], value({3.5, 2.25, k + 0.75}), 1e-6);
  }
  EXPECT_EQ(on[grid.offset(3, 2, 4)], 0);  // 0.75 voxels beyond the last centre
  EXPECT_NEAR(on[grid.offset(3, 5, 2)], value({3.5, 5, 2.75}), 1e-6);  // within the last voxel
  from.size = {210, 1, 1};
  EXPECT_REFUSED(probability_on(from, 0, grid), HasSubstr("210 x 1 x 1"));
}

}  // namespace
}  // namespace mesamis
