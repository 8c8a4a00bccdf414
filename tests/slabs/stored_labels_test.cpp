// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/stored_labels.h"

#include <gtest/gtest.h>

#include "slabs/touching_balls.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

TEST(StoredLabels, AreReadSliceBySlice) {
  LabelMap map = touching_balls();
  map.layers.emplace_back(map.voxel_count(), std::uint16_t{0});
  map.layers[1][5] = 65535;
  map.segments.push_back({"a third, \n of another layer", 65535, 1, {1, 2, 3}, 1234567});
  map.modality = "SEG";
  map.frame_of_reference = "1.2.3";
  map.direction.rows[0].x = -1;
  const TempFolder folder;
  const Scratch scratch(folder.path());
  store_labels(scratch, map, {"one", "", "three"});
  const StoredLabels stored(scratch);
  const LabelMap& head = stored.head();
  EXPECT_EQ(head.size, map.size);
  EXPECT_EQ(head.spacing, map.spacing);
  EXPECT_EQ(head.origin, map.origin);
  EXPECT_EQ(head.direction, map.direction);
  EXPECT_EQ(head.modality, map.modality);
  EXPECT_EQ(head.frame_of_reference, map.frame_of_reference);
  EXPECT_EQ(stored.head().segments, map.segments);
  EXPECT_TRUE(stored.head().layers.empty());
  EXPECT_EQ(stored.warnings(), (std::vector<std::string>{"one", "", "three"}));
  for (Index layer = 0; layer < 2; ++layer) {
    std::vector<std::uint16_t> all;
    for (const auto& [first, count] : {std::pair<Index, Index>{0, 1}, {1, 26}, {27, 3}}) {
      const auto some = stored.read(layer, first, count);
      all.insert(all.end(), some.begin(), some.end());
    }
    EXPECT_EQ(all, map.layers[static_cast<std::size_t>(layer)]);
  }
}

TEST(StoredLabels, AreRefusedWhereThereAreNone) {
  const TempFolder folder;
  const Scratch scratch(folder.path());
  EXPECT_REFUSED(StoredLabels{scratch}, testing::HasSubstr("found none"));
}

}  // namespace
}  // namespace mesamis
