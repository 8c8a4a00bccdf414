// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/mapped_items.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(MappedItems, AreWhatWasWrittenInAnyOrder) {
  const TempFolder temp;
  make_item_file<float>(temp / "image", 6);
  write_items<float>(temp / "image", 4, std::vector<float>{5, 6});
  write_items<float>(temp / "image", 1, std::vector<float>{2, 3});
  EXPECT_THAT(map_items<float>(temp / "image", 6).values, ElementsAre(0, 2, 3, 0, 5, 6));
  make_item_file<float>(temp / "image", 2);
  EXPECT_THAT(map_items<float>(temp / "image", 2).values, ElementsAre(0, 0)) << "made anew";
}

TEST(MappedItems, StayAsLongAsTheirOwner) {
  const TempFolder temp;
  make_item_file<float>(temp / "image", 1 << 16);
  write_items<float>(temp / "image", 65535, std::vector<float>{7});
  MappedItems<float> copy;
  {
    const auto first = map_items<float>(temp / "image", 1 << 16);
    copy = first;
  }
  std::filesystem::remove(temp / "image");
  EXPECT_EQ(copy.values[65535], 7);
}

TEST(MappedItems, RefusesFilesThatAreMissingOrOfAnotherSize) {
  const TempFolder temp;
  const std::vector<float> one{1};
  EXPECT_REFUSED(map_items<float>(temp / "no", 3), HasSubstr("/no: "));
  EXPECT_REFUSED(write_items<float>(temp / "no", 0, one), HasSubstr("/no: "));
  EXPECT_REFUSED(make_item_file<float>(temp / "no/such", 3), HasSubstr("/no/such: "));
  make_item_file<float>(temp / "image", 3);
  std::filesystem::resize_file(temp / "image", 11);
  EXPECT_REFUSED(map_items<float>(temp / "image", 3),
                 AllOf(HasSubstr("12 bytes"), HasSubstr("found 11")));
}

}  // namespace
}  // namespace mesamis
