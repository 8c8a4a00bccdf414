// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/length_unit.h"

#include <gtest/gtest.h>

namespace mesamis {
namespace {

TEST(LengthUnit, IsKnownByItsSymbolAndItsWordsInEitherCase) {
  for (const char* name : {"um", "UM", "\xc2\xb5m", "\xce\xbcm", "\\u00B5m", "micron", "microns",
                           "micrometer", "Micrometres", " um "}) {
    EXPECT_EQ(mm_per_unit(name), 1e-3) << name;
  }
  for (const char* name : {"mm", "millimetre", "Millimeters"}) EXPECT_EQ(mm_per_unit(name), 1);
  for (const char* name : {"in", "inch", "inches"}) EXPECT_EQ(mm_per_unit(name), 25.4) << name;
  EXPECT_EQ(mm_per_unit("nm"), 1e-6);
  EXPECT_EQ(mm_per_unit("cm"), 10);
  EXPECT_EQ(mm_per_unit("metres"), 1e3);
  EXPECT_DOUBLE_EQ(mm_per_unit("thou").value(), 0.0254);
  EXPECT_DOUBLE_EQ(mm_per_unit("yd").value(), 914.4);
  EXPECT_DOUBLE_EQ(mm_per_unit("pt").value(), 25.4 / 72);
}

TEST(LengthUnit, IsNoneForWhatIsNoLength) {
  for (const char* name : {"", "s", "pixel", "voxels", "mms", "ms", "parsec", "furlong", "mm mm"}) {
    EXPECT_EQ(mm_per_unit(name), std::nullopt) << name;
  }
}

}  // namespace
}  // namespace mesamis
