// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/nrrd_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesamis/volume_files/formats.h"
#include "support/temp_folder.h"
#include "support/throws.h"
#include "support/wide_budget.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

VoxelGrid some_grid() {
  VoxelGrid grid;
  grid.size = {2, 3, 1};
  grid.spacing = {0.1, 1.0 / 3, 2};
  grid.origin = {-1.0 / 7, 5, 1e-3};
  grid.direction = Mat3{{Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}};
  return grid;
}

TEST(NrrdHeader, ReadsBackToTheSameBits) {
  const TempFolder folder;
  const VoxelGrid grid = some_grid();
  NrrdContent content{"uint8"};
  content.values = 4;
  content.keys = {{"a\\b", "two\nlines"}, {"Name", " x: y := z"}};
  write_bytes(folder / "a.nrrd", nrrd_header(grid, content) + std::string(24, '\3'));
  WideBudget budget;
  const ScanFile scan = open_nrrd(folder / "a.nrrd", {budget, false, Values::kMany});
  EXPECT_EQ(scan.grid.size, grid.size);
  EXPECT_EQ(scan.grid.spacing, grid.spacing);
  EXPECT_EQ(scan.grid.origin, grid.origin);
  EXPECT_EQ(scan.grid.direction, grid.direction);
  EXPECT_EQ(scan.inner, 4);
  EXPECT_EQ(scan.outer, 1);
  EXPECT_THAT(scan.keys, ElementsAre(Pair("Name", " x: y := z"), Pair("a\\b", "two\nlines")));
  EXPECT_EQ(read_samples(scan, budget), std::vector<float>(24, 3));
  EXPECT_REFUSED(open_nrrd(folder / "a.nrrd", {budget}), HasSubstr("4 channels"));
}

}  // namespace
}  // namespace mesamis
