// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/loop.h"

#include <gtest/gtest.h>

#include <vector>

#include "mesamis/method/prepare.h"
#include "support/ball_volume.h"

namespace mesamis {
namespace {

Prepared prepared_ball(int adaptations, bool mirrored) {
  Volume scan = make_ball({.size = 18, .radius = 5});
  if (mirrored) scan.direction.rows[0] = {-1, 0, 0};
  Settings settings;
  settings.max_tets = 3000;
  settings.adaptations = adaptations;
  return prepare_image(scan, settings);
}

TEST(Loop, MakesNoMoreMeshesThanAreAllowed) {
  for (const int adaptations : {1, 2}) {
    const Prepared prepared = prepared_ball(adaptations, false);
    const Loop loop = run_loop(RunInput(prepared), {});
    EXPECT_EQ(std::ssize(loop.passes), adaptations + 1) << "and the last minimisation";
    EXPECT_EQ(loop.minimum.u.size(), loop.state.mesh.points.size());
  }
}

TEST(Loop, StopsBetweenTwoMeshesWhenTheCallerHasEnough) {
  const Prepared prepared = prepared_ball(3, false);
  for (const int made : {1, 2}) {
    int asked = 0;
    const Loop loop = run_loop(RunInput(prepared), {}, [&] { return ++asked == made; });
    EXPECT_EQ(asked, made) << "once before each adaptation from the second on";
    EXPECT_TRUE(loop.stopped);
    EXPECT_EQ(std::ssize(loop.passes), made + 1);
    EXPECT_EQ(loop.minimum.u.size(), loop.state.mesh.points.size()) << "a whole result";
  }
  EXPECT_FALSE(run_loop(RunInput(prepared), {}, [] { return false; }).stopped);
}

TEST(Loop, TellsItsStagesInOrder) {
  const Prepared prepared = prepared_ball(2, false);
  std::vector<std::string> stages;
  const Progress progress = [&](std::string_view stage, double) {
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
    return true;
  };
  (void)run_loop(RunInput(prepared), progress);
  EXPECT_EQ(stages, (std::vector<std::string>{"adaptation 1 of 2, on the voxel grid",
                                              "adaptation 2 of 2", "final minimisation"}));
}

TEST(DeliverMesh, CellsHavePositiveVolumeInMirroredGridsToo) {
  for (const bool mirrored : {false, true}) {
    const Prepared prepared = prepared_ball(1, mirrored);
    const RunInput run(prepared);
    Result result;
    deliver_mesh(run, run_loop(run, {}), result);
    ASSERT_FALSE(result.mesh.cells.empty());
    for (std::size_t c = 0; c < result.mesh.cells.size(); ++c) {
      ASSERT_GT(cell_volume(result.mesh, static_cast<Index>(c)), 0);
    }
    EXPECT_EQ(result.metric.size(), result.mesh.points.size());
    EXPECT_GT(result.fit.unit_edge_fraction, 0.5);
  }
}

}  // namespace
}  // namespace mesamis
