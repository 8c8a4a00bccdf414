// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mesamis/base/types.h"

namespace mesamis {
namespace {

TEST(Frame, RasIsHalfATurnAboutZ) {
  const Vec3 p{1, 2, 3}, q{-4, 5, 6};
  EXPECT_EQ(in_frame(p, Frame::kLps), p);
  EXPECT_EQ(in_frame(p, Frame::kRas), (Vec3{-1, -2, 3}));
  EXPECT_EQ(in_frame(in_frame(p, Frame::kRas), Frame::kRas), p);
  // A rotation: it keeps products, and so lengths, angles and orientation.
  EXPECT_EQ(dot(in_frame(p, Frame::kRas), in_frame(q, Frame::kRas)), dot(p, q));
  EXPECT_EQ(cross(in_frame(p, Frame::kRas), in_frame(q, Frame::kRas)),
            in_frame(cross(p, q), Frame::kRas));
}

TEST(Frame, HasAName) {
  EXPECT_STREQ(frame_name(Frame::kLps), "LPS");
  EXPECT_STREQ(frame_name(Frame::kRas), "RAS");
}

}  // namespace
}  // namespace mesamis
