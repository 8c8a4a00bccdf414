// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/segment_in_slabs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesamis/run/write.h"
#include "run/small_request.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

class SegmentInSlabs : public testing::Test {
 protected:
  SegmentInSlabs() { request.slabs.scratch = folder / "scratch"; }

  const TempFolder folder;
  const Volume scan = make_ball(small_ball());
  const VolumeSlices source{scan};
  SlabRequest request{source, small_settings()};
};

/// A scan of one slab has the bytes of a run without slabs.
TEST_F(SegmentInSlabs, OneSlabIsTheWhole) {
  request.piece_meshes = {folder / "pieces.pvtu"};
  const auto found = segment_in_slabs(request, folder.path(), alone());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->outcome.details().verdict.kind, VerdictKind::kKept)
      << found->outcome.details().verdict.message;
  Outputs out;
  out.meshes = {folder / "slabs.vtu"};
  out.surfaces = {folder / "slabs.vtp"};
  write(found->outcome, out);
  out.meshes = {folder / "whole.vtu"};
  out.surfaces = {folder / "whole.vtp"};
  write(ball_outcome(), out);
  for (const char* ending : {".vtu", ".vtp"}) {
    EXPECT_EQ(read_bytes(folder / (std::string("slabs") + ending)),
              read_bytes(folder / (std::string("whole") + ending)));
  }
  EXPECT_TRUE(fs::exists(folder / "pieces.pvtu"));
  EXPECT_TRUE(fs::exists(folder / "pieces_0.vtu"));
}

/// The scan is not copied where nothing needs its grey values.
TEST_F(SegmentInSlabs, KeepsNoImageWithoutAMesh) {
  request.slabs.mesh = false;
  const auto found = segment_in_slabs(request, folder.path(), alone());
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->scan);
  EXPECT_TRUE(found->outcome.details().image().samples.empty());
  EXPECT_EQ(found->outcome.details().mesh(), nullptr);
  EXPECT_EQ(found->outcome.details().one->surface.points,
            ball_outcome().details().one->surface.points);
}

}  // namespace
}  // namespace mesamis
