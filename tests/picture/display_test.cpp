// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/display.h"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include "mesamis/picture/picture.h"
#include "picture/drawing_test.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using detail::Display;
using testing::HasSubstr;

constexpr const char* kNone = ":987";  // no server has this number

class DisplayTest : public DrawingTest {};

TEST_F(DisplayTest, IsTheOneOfTheEnvironmentUnlessNamed) {
  EXPECT_NE(Display("").connection(), nullptr);
  const Variable none("DISPLAY", kNone);
  EXPECT_THROW(Display(""), DisplayError);
  EXPECT_NE(Display(display()).connection(), nullptr);
}

TEST_F(DisplayTest, IsUsedByPicturesThatNameIt) {
  const TempFolder folder;
  const TriMesh triangle{{{0, 0, 0}, {10, 0, 0}, {0, 0, 10}}, {{0, 1, 2}}};
  PictureOptions options;
  options.pixels = {64, 64};
  options.display = display();
  const Variable none("DISPLAY", kNone);
  draw_surface(folder / "a.png", triangle, options);
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(Display, IsRefusedInOneLineWhereThereIsNone) {
  const TempFolder folder;
  const TriMesh triangle{{{0, 0, 0}, {10, 0, 0}, {0, 0, 10}}, {{0, 1, 2}}};
  const MeshWithArrays box{box_mesh({{0, 0, 0}, {1, 1, 1}}, {1, 1, 1}), {}, {}};
  const Variable display("DISPLAY", kNone);
  EXPECT_THROW(draw_surface(folder / "a.png", triangle), DisplayError);
  EXPECT_REFUSED(draw_surface(folder / "a.png", triangle), HasSubstr("':987' cannot be opened"));
  EXPECT_REFUSED(draw_mesh(folder / "a.png", box), HasSubstr("X display"));
  const Variable unset("DISPLAY", "");
  EXPECT_REFUSED(draw_surface(folder / "a.png", triangle), HasSubstr("DISPLAY is not set"));
  EXPECT_EQ(folder.file_count(), 0);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "the library starts no process";
}

}  // namespace
}  // namespace mesamis
