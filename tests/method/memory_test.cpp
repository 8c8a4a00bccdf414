// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/memory.h"

#include <gtest/gtest.h>

#include <array>

#include "mesamis/method/parameters.h"
#include "support/throws.h"

namespace mesamis {
namespace {

/// Only its size counts.
Volume empty_volume(Index nx, Index ny, Index nz, const Vec3& spacing = {1, 1, 1}) {
  Volume volume;
  volume.size = {nx, ny, nz};
  volume.spacing = spacing;
  return volume;
}

constexpr std::array<Index, 3> kEveryVoxel{1, 1, 1};

TEST(MemoryNeeded, GrowsWithVoxelsAndCellsAndFallsWithTheStride) {
  const Volume small = empty_volume(200, 200, 200), large = empty_volume(400, 200, 200);
  Settings settings;
  settings.stride = kEveryVoxel;
  settings.max_tets = 100'000;
  EXPECT_NEAR(memory_needed(large, settings) / memory_needed(small, settings), 2, 0.1);
  Settings thin = settings;
  thin.stride = std::array<Index, 3>{2, 2, 1};
  EXPECT_LT(memory_needed(small, thin), 0.5 * memory_needed(small, settings));
  Settings part = settings;
  part.crop.end = {200, -1, -1};
  EXPECT_EQ(memory_needed(large, part), memory_needed(small, settings));
  settings.max_tets = 20'000'000;
  EXPECT_GT(memory_needed(small, settings), 2 * memory_needed(large, part));
}

TEST(MemoryNeeded, OfTheLargestScansIsWhatWasMeasured) {
  Settings settings;
  settings.stride = kEveryVoxel;
  settings.max_tets = 3'000'000;
  // Measured beside the scan: 5.55 GB, 1.50 GB, 0.56 GB.
  EXPECT_GT(memory_needed(empty_volume(512, 512, 400), settings), 5.55e9);
  EXPECT_LT(memory_needed(empty_volume(512, 512, 400), settings), 1.3 * 5.55e9);
  settings.stride = std::array<Index, 3>{2, 2, 1};
  settings.max_tets = 1'000'000;
  EXPECT_GT(memory_needed(empty_volume(512, 512, 275), settings), 1.5e9);
  EXPECT_LT(memory_needed(empty_volume(512, 512, 275), settings), 1.3 * 1.5e9);
  settings.stride = std::array<Index, 3>{2, 2, 1};
  settings.max_tets = 1'300'000;
  EXPECT_GT(memory_needed(empty_volume(204, 244, 304), settings), 0.56e9);
  EXPECT_LT(memory_needed(empty_volume(204, 244, 304), settings), 1e9);
}

TEST(MemoryNeeded, OfPreviewsIsWhatWasMeasured) {
  Settings settings;
  settings.preview = true;
  // Measured beside the scan: a spine, spongy bone and a skull, 441 MB, 356 MB, 416 MB.
  const Volume spine = empty_volume(120, 126, 164, {1.5, 1.5, 1.5}),
               spongy = empty_volume(140, 140, 140),
               skull = empty_volume(328, 435, 112, {0.451, 0.451, 1});
  EXPECT_GT(memory_needed(spine, settings), 441e6);
  EXPECT_LT(memory_needed(spine, settings), 1.3 * 441e6);
  EXPECT_GT(memory_needed(spongy, settings), 356e6);
  EXPECT_LT(memory_needed(spongy, settings), 1.5 * 356e6);
  EXPECT_GT(memory_needed(skull, settings), 416e6);
  EXPECT_LT(memory_needed(skull, settings), 1.7 * 416e6);
}

TEST(MemoryNeeded, IsMoreWhereTheFirstGridIsSolvedInDoublePrecision) {
  const Volume volume = empty_volume(400, 400, 400);
  Settings draft, exact, stiff;
  draft.stride = exact.stride = stiff.stride = kEveryVoxel;
  exact.drafts = false;
  stiff.beta = 100;
  EXPECT_GT(memory_needed(volume, exact), 1.5 * memory_needed(volume, draft));
  EXPECT_EQ(memory_needed(volume, stiff), memory_needed(volume, exact));
}

TEST(MemoryNeeded, KnowsTheStrideThatIsChosen) {
  const Volume volume = empty_volume(400, 400, 100, {0.5, 0.5, 2});
  Settings chosen, asked;
  chosen.max_tets = asked.max_tets = 20'000;
  asked.stride = default_stride(volume.size, volume.spacing);
  EXPECT_EQ(memory_needed(volume, chosen), memory_needed(volume, asked));
  asked.stride = kEveryVoxel;
  EXPECT_LT(memory_needed(volume, chosen), memory_needed(volume, asked));
}

/// Samples that are still to be read need memory too.
TEST(RequireMemory, CountsWhatIsStillTaken) {
  const Volume volume = empty_volume(100, 100, 100);
  Settings settings;
  settings.max_tets = 20'000;
  const double needed = memory_needed(volume, settings);
  const double limit_gb = 1.1 * needed / 1e9;
  EXPECT_NO_THROW(require_memory(volume, settings, limit_gb));
  EXPECT_NO_THROW(require_memory(volume, settings, limit_gb, 0.09 * needed));
  EXPECT_REFUSED(require_memory(volume, settings, limit_gb, 0.2 * needed),
                 testing::HasSubstr("memory: expected about"));
}

TEST(StrideThatFits, ThinsTheAxisThatIsFinest) {
  const Volume volume = empty_volume(400, 400, 100, {0.5, 0.5, 2});
  Settings settings;
  settings.stride = kEveryVoxel;
  settings.max_tets = 20'000;
  const double half = 0.5 * memory_needed(volume, settings);
  const auto stride = stride_that_fits(volume, settings, half);
  ASSERT_TRUE(stride);
  EXPECT_EQ((*stride)[2], 1);
  EXPECT_GT((*stride)[0] * (*stride)[1], 1);
  settings.stride = *stride;
  EXPECT_LE(memory_needed(volume, settings), half);
  EXPECT_EQ(stride_that_fits(volume, settings, half), settings.stride);
  EXPECT_FALSE(stride_that_fits(volume, settings, 1e6));
}

}  // namespace
}  // namespace mesamis
