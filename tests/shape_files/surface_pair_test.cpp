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
  EXPECT_EQ(pair.warnings[0], "it: turned from RAS to LPS, as the files state");
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

}  // namespace
}  // namespace mesamis
