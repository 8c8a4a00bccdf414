// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/fonts.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

TEST(Fonts, AreTrueTypeAndTwo) {
  const std::string_view magic("\0\1\0\0", 4);
  EXPECT_EQ(font_bytes(false).substr(0, 4), magic);
  EXPECT_EQ(font_bytes(true).substr(0, 4), magic);
  EXPECT_NE(font_bytes(false), font_bytes(true));
}

}  // namespace
}  // namespace mesamis
