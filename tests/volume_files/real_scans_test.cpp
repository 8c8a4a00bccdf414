// SPDX-License-Identifier: Apache-2.0
// Real scans have the size, spacing and range that their list gives them.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "mesamis/volume_files/read_volume.h"
#include "support/test_data.h"

namespace mesamis {
namespace {

struct Expected {
  std::string file;
  std::array<double, 3> size{}, spacing{};
  double lo = 0, hi = 0;
};

/// "AxBxC" as three numbers; false if it is something else.
bool parse_three(const std::string& text, std::array<double, 3>& out) {
  char x = 0, y = 0;
  std::istringstream in(text);
  return static_cast<bool>(in >> out[0] >> x >> out[1] >> y >> out[2]) && x == 'x' && y == 'x';
}

/// The lines of the list that speak of volumes.
std::vector<Expected> read_list(const std::filesystem::path& list) {
  std::vector<Expected> all;
  std::ifstream in(list);
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> columns;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, '\t');) columns.push_back(field);
    Expected e;
    if (columns.size() < 9 || !parse_three(columns[6], e.size)) continue;
    if (!parse_three(columns[7], e.spacing)) continue;
    e.file = columns[0];
    std::istringstream range(columns[8]);
    char dot = 0;
    range >> e.lo >> dot;  // "-1024..2986": the first number takes one of the two dots
    if (range.peek() == '.') range >> dot;
    range >> e.hi;
    all.push_back(e);
  }
  return all;
}

TEST(RealScans, HaveTheSizeSpacingAndRangeOfTheirList) {
  const auto list = test_data("data/MANIFEST.tsv");
  MESAMIS_REQUIRE_DATA(list);
  const auto all = read_list(list);
  ASSERT_GE(all.size(), 10u);
  for (const Expected& e : all) {
    SCOPED_TRACE(e.file);
    const Volume volume = read_volume(list.parent_path() / e.file).volume;
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_EQ(volume.size[a], e.size[a]);
      EXPECT_NEAR(volume.spacing[static_cast<int>(a)], e.spacing[a], 1e-3 * e.spacing[a]);
    }
    const auto [lo, hi] = std::minmax_element(volume.samples.begin(), volume.samples.end());
    EXPECT_EQ(*lo, e.lo);
    EXPECT_EQ(*hi, e.hi);
    EXPECT_NO_THROW(require_usable(volume));
    const auto listed = list_volumes(list.parent_path() / e.file);
    ASSERT_EQ(listed.size(), 1u);
    EXPECT_EQ(listed[0].size, volume.size);
    EXPECT_EQ(listed[0].spacing, volume.spacing);
    EXPECT_EQ(listed[0].problem, "");
  }
}

}  // namespace
}  // namespace mesamis
