// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/surface_pair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/shapes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

/// Nothing that a flip maps onto itself.
TriMesh lopsided() {
  TriMesh surface = joined(cube({10, 20, 30}, 8), cube({25, 22, 31}, 3));
  return joined(surface, cube({12, 40, 33}, 2));
}

TEST(MustTurn, WhereTheFilesStateDifferentFrames) {
  EXPECT_TRUE(must_turn(Frame::kLps, Frame::kRas, FrameRule::kAuto));
  EXPECT_FALSE(must_turn(Frame::kLps, Frame::kLps, FrameRule::kAuto));
  EXPECT_FALSE(must_turn(std::nullopt, Frame::kRas, FrameRule::kAuto));
  EXPECT_FALSE(must_turn(Frame::kLps, Frame::kRas, FrameRule::kAsIs));
  EXPECT_TRUE(must_turn(std::nullopt, std::nullopt, FrameRule::kTurned));
}

TEST(PairUp, TurnsAndSaysSo) {
  const TriMesh reference = lopsided();
  const SurfacePair pair =
      pair_up({reference, Frame::kLps}, {turned(reference), Frame::kRas}, FrameRule::kAuto, "it");
  EXPECT_TRUE(pair.surface_turned);
  EXPECT_EQ(pair.surface.points, reference.points);
  EXPECT_EQ(pair.frame(), Frame::kLps);
  ASSERT_EQ(pair.warnings.size(), 1u);
  EXPECT_EQ(pair.warnings[0], "it: turned from RAS to LPS, as both state");
}

TEST(PairUp, WhatFitsNeedsNoWarning) {
  const TriMesh reference = lopsided();
  const SurfacePair pair = pair_up({reference, {}}, {reference, {}}, FrameRule::kAuto, "it");
  EXPECT_FALSE(pair.surface_turned);
  EXPECT_TRUE(pair.warnings.empty());
  EXPECT_EQ(pair.frame(), std::nullopt);
}

TEST(PairUp, RefusesWhatFitsOnlyAfterAFlip) {
  const TriMesh reference = lopsided();
  EXPECT_REFUSED(pair_up({reference, {}}, {turned(reference), {}}, FrameRule::kAuto, "it"),
                 testing::HasSubstr("turned from LPS to RAS or back"));
  EXPECT_FALSE(pair_up({reference, {}}, {turned(reference), {}}, FrameRule::kAsIs, "it").flip);
}

NamedSurface named(const std::string& name, const Vec3& middle) {
  return {name, {}, 1, cube(middle, 2)};
}

SurfacePair pair_of(const PairedFile& reference, const PairedFile& surface,
                    FrameRule rule = FrameRule::kAsIs) {
  SurfacePair pair = pair_up({lopsided(), {}}, {lopsided(), {}}, rule, "it");
  pair_objects(pair, reference, surface);
  return pair;
}

TEST(PairObjects, ByTheirNames) {
  const SurfacePair pair = pair_of({"a", {named("left", {1, 2, 3}), named("right", {9, 2, 3})}},
                                   {"b", {named("right", {9, 2, 4}), named("left", {1, 2, 3})}});
  EXPECT_TRUE(pair.warnings.empty());
  ASSERT_EQ(pair.objects.size(), 2u);
  EXPECT_EQ(pair.objects[1].name, "right");
  EXPECT_EQ(pair.objects[1].reference.points, cube({9, 2, 3}, 2).points);
  EXPECT_EQ(pair.objects[1].surface.points, cube({9, 2, 4}, 2).points);
  const auto measured = measure_objects(pair);
  ASSERT_EQ(measured.size(), 2u);
  EXPECT_EQ(measured[0].directions[0].name, "surface_to_reference");
  EXPECT_EQ(measured[0].directions[0].from_vertices, std::vector<double>(8, 0.0));
  EXPECT_NEAR(measured[1].directions[1].from_vertices[0], 1, 1e-12);
}

TEST(PairObjects, TurnsThemWithTheirSurface) {
  const PairedFile two{"a", {named("left", {1, 2, 3}), named("right", {9, 2, 3})}};
  const SurfacePair pair = pair_of(two, two, FrameRule::kTurned);
  EXPECT_EQ(pair.objects[0].surface.points, turned(cube({1, 2, 3}, 2)).points);
  EXPECT_EQ(pair.objects[0].reference.points, cube({1, 2, 3}, 2).points);
}

TEST(PairObjects, SaysWhatIsMeasuredTogether) {
  const PairedFile one{"a", {named("left", {})}}, none{"a", {}};
  const PairedFile two{"b", {named("left", {}), named("right", {})}};
  const PairedFile others{"c", {named("x", {}), named("y", {})}};
  const PairedFile half{"d", {named("left", {}), named("top", {})}};
  const PairedFile twice{"e", {named("left", {}), named("left", {}), named("right", {})}};
  EXPECT_TRUE(pair_of(one, none).warnings.empty());
  const auto together = [](const char* name) {
    return std::string(name) + ": 2 objects, measured together as one surface";
  };
  EXPECT_THAT(pair_of(one, two).warnings, testing::ElementsAre(together("b")));
  EXPECT_THAT(pair_of(two, others).warnings, testing::ElementsAre(together("b"), together("c")));
  const SurfacePair partly = pair_of(two, half);
  EXPECT_EQ(partly.objects.size(), 1u);
  EXPECT_THAT(partly.warnings, testing::ElementsAre(testing::EndsWith("whole alone: \"right\""),
                                                    testing::EndsWith("whole alone: \"top\"")));
  const SurfacePair unclear = pair_of(two, twice);
  ASSERT_EQ(unclear.objects.size(), 1u);
  EXPECT_EQ(unclear.objects[0].name, "right");
}

TEST(MeasureObjects, LeavesOutThoseOutsideTheBox) {
  const PairedFile two{"a", {named("left", {1, 2, 3}), named("right", {99, 2, 3})}};
  const SurfacePair pair = pair_of(two, two);
  const auto measured = measure_objects(pair, Box{{-9, -9, -9}, {9, 9, 9}});
  ASSERT_EQ(measured.size(), 1u);
  EXPECT_EQ(measured[0].name, "left");
}

}  // namespace
}  // namespace mesamis
