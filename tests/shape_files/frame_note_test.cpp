// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mesamis/shape_files/surface_formats.h"

namespace mesamis {
namespace {

TEST(FrameNote, StatesAFrameThatIsReadBack) {
  EXPECT_EQ(frame_note(Frame::kLps), "mesamis, millimetre, SPACE=LPS");
  EXPECT_EQ(frame_note(Frame::kRas), "mesamis, millimetre, SPACE=RAS");
  EXPECT_EQ(frame_note(std::nullopt), "mesamis, millimetre");
  for (const std::optional<Frame> frame :
       {std::optional(Frame::kLps), std::optional(Frame::kRas), std::optional<Frame>()}) {
    EXPECT_EQ(frame_named_in(frame_note(frame)), frame);
  }
}

TEST(FrameNote, AnyOtherNameIsNoFrame) {
  EXPECT_EQ(frame_named_in("3D Slicer output. SPACE=RAS;UNIT=mm"), Frame::kRas);
  for (const char* note : {"", "LPS", "SPACE=", "SPACE=lps", "SPACE=LPSX", "SPACE=LPS2", "SPACE=LA",
                           "SPACE=\xc3\x84"}) {
    EXPECT_EQ(frame_named_in(note), std::nullopt) << note;
  }
  EXPECT_EQ(frame_named("LPS"), Frame::kLps);
  EXPECT_EQ(frame_named("LPS "), std::nullopt);
}

}  // namespace
}  // namespace mesamis
