// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/cut.h"

#include <gtest/gtest.h>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "remesh/small_body.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

const FormulaMetric kMetric = uniform_metric(0.25);

WorkingMesh cut(const TetMesh& start, const BodyShape& shape) {
  return cut_along_border(start, shape, MetricSampler(kMetric, kUnitBox));
}

TEST(Cut, NoCellLiesOnBothSides) {
  const RoundShape ball({0.5, 0.5, 0.5}, 0.4);
  const WorkingMesh mesh = cut(perturbed_box(kUnitBox, {4, 4, 4}, 0.2), ball);
  expect_sound_body(mesh);
  for (const WorkCell& cell : mesh.cells) {
    for (const Index p : cell.points) {
      const Vertex& vertex = mesh.vertices[p];
      const double distance = ball.distance(vertex.position);
      if (vertex.mask & kOnSkin) {
        EXPECT_NEAR(distance, 0, 0.02);  // off it where the border is next to an end of an edge
      } else {
        EXPECT_EQ(cell.material == kOutside, distance > 0);
      }
    }
  }
}

/// No vertex of the start lies between 0.3 and 0.34.
TEST(Cut, AWallThinnerThanTheCellsIsKept) {
  const WorkingMesh mesh = cut(box_mesh(kUnitBox, {4, 4, 4}), SlabShape(0.3, 0.34));
  expect_sound_body(mesh);
  EXPECT_NEAR(volume_of(mesh), 0.04, 1e-6);
}

TEST(Cut, AGapThinnerThanTheCellsIsKept) {
  const SlabShape gap(0.3, 0.34, kOutside, 1);
  const WorkingMesh mesh = cut(box_mesh(kUnitBox, {4, 4, 4}), gap);
  expect_sound_body(mesh);
  EXPECT_NEAR(volume_of(mesh), 0.96, 1e-6);
}

TEST(Cut, WhatIsThinnerThanTheToleranceIsNot) {
  const double half = 0.9 * FormulaShape::kTolerance;
  const SlabShape gap(0.3 - half, 0.3 + half, kOutside, 1);
  EXPECT_NEAR(volume_of(cut(box_mesh(kUnitBox, {4, 4, 4}), gap)), 1, 1e-12);
}

TEST(Cut, IsTheSameForAnyNumberOfThreads) {
  const TetMesh start = box_mesh(kUnitBox, {16, 16, 16});  // more edges than a block of a loop
  auto hash = [&] { return mesh_hash(unload(cut(start, SlabShape(0.28, 0.31)))); };
  const auto once = with_threads(1, hash);
  EXPECT_EQ(with_threads(4, hash), once);
}

TEST(Cut, RefusesWhatHoldsNothing) {
  EXPECT_REFUSED(cut(box_mesh(kUnitBox, {4, 4, 4}), RoundShape({5, 5, 5}, 1)),
                 HasSubstr("expected an object that fills at least one element, found none"));
}

}  // namespace
}  // namespace mesamis
