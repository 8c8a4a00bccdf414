// SPDX-License-Identifier: Apache-2.0
// Files of several objects in the programs that print them.
#include <gmock/gmock.h>

#include <algorithm>

#include "shape_files/object_example.h"
#include "support/external_program.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

std::ptrdiff_t count_of(const std::string& text, const std::string& word) {
  std::ptrdiff_t count = 0;
  for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++count;
  return count;
}

/// Objects of some size, side by side.
std::vector<NamedSurface> blocks() {
  return {{"a", {255, 0, 0}, 1, cube({0, 0, 0}, 10)},
          {"b", {0, 255, 0}, 2, cube({10, 0, 0}, 10)},
          {"c", {0, 0, 255}, 3, cube({0, 10, 0}, 10)}};
}

TEST(ObjectInterop, PrusaSlicerFindsEachClosedObject) {
  MESAMIS_REQUIRE_PROGRAM("prusa-slicer");
  const TempFolder folder;
  for (const std::string name : {"a.3mf", "a.amf"}) {
    write_objects(folder / name, blocks());
    ASSERT_EQ(run_in(folder.path(), "prusa-slicer --info " + name), 0) << name;
    const std::string log = read_bytes(folder / "log");
    EXPECT_EQ(count_of(log, "number_of_facets = 12"), 3) << name << '\n' << log;
    EXPECT_EQ(count_of(log, "manifold = yes"), 3) << name << '\n' << log;
  }
}

TEST(ObjectInterop, PrusaSlicerMakesGcodeOfAllObjects) {
  MESAMIS_REQUIRE_PROGRAM("prusa-slicer");
  const TempFolder folder;
  write_objects(folder / "a.3mf", blocks());
  ASSERT_EQ(run_in(folder.path(), "prusa-slicer --export-gcode --dont-arrange -o a.gcode a.3mf"), 0)
      << read_bytes(folder / "log");
  EXPECT_THAT(read_bytes(folder / "a.gcode"), HasSubstr("G1"));
}

}  // namespace
}  // namespace mesamis
