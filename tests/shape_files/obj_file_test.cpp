// SPDX-License-Identifier: Apache-2.0
// OBJ files of other writers, and damaged ones.
#include <gmock/gmock.h>

#include "mesamis/shape_files/surface_files.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(Obj, ReadsAllWaysToNamePoints) {
  const TempFolder folder;
  write_bytes(
      folder / "a.obj",
      "# by hand\r\nmtllib none.mtl\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 .5 .5 .5\nvt 0 0\nvn 0 0 1\n"
      "v 0 1 0\nf 1/1/1 2//1 3/1 4\ns off\nf -4 -3 -1\n");
  const TriMesh surface = read_surface(folder / "a.obj");
  EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}}));
}

TEST(Obj, SaysInWhichLineItIsWrong) {
  const TempFolder folder;
  for (const auto& [text, message] :
       std::vector<std::pair<std::string, std::string>>{{"v 1 2\n", "line 1"},
                                                        {"v 0 0 0\nf 1 1 0\n", "line 2"},
                                                        {"v 0 0 0\nf 1 -2 1\n", "line 2"},
                                                        {"v 0 0 0\nf 1 1\n", "at least 3"},
                                                        {"v 0 0 0\nf 1 1 x\n", "\"x\""},
                                                        {"v 0 0 0\nf 1 1 2\n", "names point 1"},
                                                        {"v 0 0 0\n", "no triangle"}}) {
    write_bytes(folder / "a.obj", text);
    EXPECT_REFUSED(read_surface(folder / "a.obj"), HasSubstr(message)) << text;
  }
}

}  // namespace
}  // namespace mesamis
