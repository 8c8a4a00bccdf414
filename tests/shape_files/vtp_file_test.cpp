// SPDX-License-Identifier: Apache-2.0
// VTK XML files of surfaces: sizes that do not fit, arrays on points.
#include <gmock/gmock.h>

#include <cmath>

#include "mesamis/shape_files/surface_files.h"
#include "support/shapes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(Vtp, PromisingMoreThanTheFileHoldsIsRefused) {
  const TempFolder folder;
  write_surface(folder / "a.vtp", cube());
  const std::string whole = read_bytes(folder / "a.vtp");
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"NumberOfPoints=\"8\"", "NumberOfPoints=\"80000000000\""},
           {"NumberOfPoints=\"8\"", "NumberOfPoints=\"9\""},
           {"NumberOfPolys=\"12\"", "NumberOfPolys=\"13\""},
           {"NumberOfPolys=\"12\"", "NumberOfPolys=\"-1\""},
           {"PolyData", "NolyData"}}) {
    std::string bytes = whole;
    bytes.replace(bytes.find(from), from.size(), to);
    write_bytes(folder / "a.vtp", bytes);
    EXPECT_REFUSED(read_surface(folder / "a.vtp"), HasSubstr("a.vtp: ")) << to;
  }
}

TEST(Vtp, ArraysOnItsPointsAreReadBackByName) {
  const TempFolder folder;
  const TriMesh surface = cube();
  const std::vector<double> values{0.5, -1, 1e-300, 3, 4, 5, 6, 1.0 / 3};
  write_surface(folder / "a.vtp", surface, {.point_arrays = {{"one", values}, {"two", values}}});
  EXPECT_EQ(read_point_array(folder / "a.vtp", "two"), values);
  EXPECT_REFUSED(read_point_array(folder / "a.vtp", "three"), HasSubstr("there is one, two"));
  write_surface(folder / "b.vtp", surface);
  EXPECT_REFUSED(read_point_array(folder / "b.vtp", "one"), HasSubstr("there is none"));
  write_surface(folder / "c.stl", surface);
  EXPECT_REFUSED(read_point_array(folder / "c.stl", "one"), HasSubstr("only .vtp and .ply"));
  EXPECT_REFUSED(write_surface(folder / "d.vtp", surface, {.point_arrays = {{"short", {1, 2}}}}),
                 HasSubstr("per point (8), found 2"));
  EXPECT_REFUSED(write_surface(folder / "d.vtp", surface,
                               {.point_arrays = {{"x", std::vector<double>(8, std::nan(""))}}}),
                 HasSubstr("not finite"));
  EXPECT_REFUSED(write_surface(folder / "d.vtp", surface, {.point_arrays = {{"a b", values}}}),
                 HasSubstr("one word"));
  EXPECT_FALSE(std::filesystem::exists(folder / "d.vtp"));
}

}  // namespace
}  // namespace mesamis
