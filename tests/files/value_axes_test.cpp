// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/value_axes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(TakeValue, IsTheOnlyOneWithoutAChoice) {
  const TakenValue taken = take_value("a.nii", {}, {});
  EXPECT_EQ(taken.volume, 0);
  EXPECT_EQ(taken.channel, 0);
  EXPECT_EQ(take_value("a.nii", {}, {.volume = 0}).volume, 0);
}

TEST(TakeValue, IsTheOneAskedFor) {
  EXPECT_EQ(take_value("a.nii", {.volumes = 5}, {.volume = 4}).volume, 4);
  const TakenValue both =
      take_value("a.nii", {.volumes = 5, .channels = 3}, {.volume = 1, .channel = 2});
  EXPECT_EQ(both.volume, 1);
  EXPECT_EQ(both.channel, 2);
}

/// Where a file has one axis, what it is called does not matter.
TEST(TakeValue, MayBeCalledAVolumeOrAChannel) {
  EXPECT_EQ(take_value("a.nii", {.volumes = 5}, {.channel = 3}).volume, 3);
  EXPECT_EQ(take_value("a.nii", {.channels = 5}, {.volume = 3}).channel, 3);
}

TEST(TakeValue, RefusesWithWhatThereIs) {
  EXPECT_REFUSED(take_value("a.nii", {.volumes = 5}, {}), HasSubstr("5 volumes (--volume 0 to 4)"));
  EXPECT_REFUSED(take_value("a.nii", {.channels = 2}, {}),
                 HasSubstr("2 channels (--channel 0 to 1)"));
  EXPECT_REFUSED(take_value("a.nii", {.volumes = 5, .channels = 2}, {.volume = 1}),
                 AllOf(HasSubstr("5 volumes"), HasSubstr("2 channels")));
  EXPECT_REFUSED(take_value("a.nii", {.volumes = 5}, {.volume = 5}), HasSubstr("0 to 4, found 5"));
  EXPECT_REFUSED(take_value("a.nii", {}, {.volume = 1}), HasSubstr("found 1"));
  EXPECT_REFUSED(take_value("a.nii", {.volumes = 5}, {.volume = -1}), HasSubstr("found -1"));
}

}  // namespace
}  // namespace mesamis
