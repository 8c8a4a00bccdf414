// SPDX-License-Identifier: Apache-2.0
// Gmsh files, read back by a parser of their own and judged by Gmsh where it is installed.
#include <gmock/gmock.h>

#include <sstream>

#include "shape_files/finite_element_example.h"
#include "support/external_program.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::Not;

template <class Value>
Value next(std::istream& in) {
  Value value{};
  in >> value;
  EXPECT_TRUE(in.good());
  return value;
}

void parse_data(std::istream& in, std::map<std::string, std::map<int, double>>& data) {
  EXPECT_EQ(next<int>(in), 1);
  const auto name = next<std::string>(in);
  EXPECT_EQ(next<int>(in), 1);
  next<double>(in);
  EXPECT_EQ(next<int>(in), 3);
  EXPECT_EQ(next<int>(in), 0);
  EXPECT_EQ(next<int>(in), 1);
  const int count = next<int>(in);
  for (int i = 0; i < count; ++i) {
    const int number = next<int>(in);
    data[name][number] = next<double>(in);
  }
}

FileContents parse_gmsh(const std::filesystem::path& path) {
  std::istringstream in(read_bytes(path));
  FileContents found;
  for (std::string word; in >> word;) {
    if (word == "$MeshFormat") {
      EXPECT_EQ(next<std::string>(in), "2.2");
    } else if (word == "$PhysicalNames") {
      for (int i = next<int>(in); i > 0; --i) {
        EXPECT_EQ(next<int>(in), 3);
        const int number = next<int>(in);
        found.set_names[number] = next<std::string>(in);
      }
    } else if (word == "$Nodes") {
      for (int i = next<int>(in); i > 0; --i) {
        const int number = next<int>(in);
        for (int axis = 0; axis < 3; ++axis) found.nodes[number][axis] = next<double>(in);
      }
    } else if (word == "$Elements") {
      for (int i = next<int>(in); i > 0; --i) {
        const int number = next<int>(in);
        EXPECT_EQ(next<int>(in), 4);
        EXPECT_EQ(next<int>(in), 2);
        found.sets[next<int>(in)].push_back(number);
        next<int>(in);
        for (int corner = 0; corner < 4; ++corner) {
          found.elements[number].push_back(next<int>(in));
        }
      }
    } else if (word == "$NodeData") {
      parse_data(in, found.node_data);
    } else if (word == "$ElementData") {
      parse_data(in, found.element_data);
    }
  }
  return found;
}

TEST(Gmsh, ReadsBackBitEqual) {
  const TempFolder folder;
  const FiniteElementExample example;
  write_gmsh(folder / "m.msh", example.grid, example.sets);
  const FileContents found = parse_gmsh(folder / "m.msh");
  expect_cells(found, example.grid.mesh);
  for (std::size_t n = 0; n < example.grid.mesh.points.size(); ++n) {
    EXPECT_EQ(found.nodes.at(static_cast<int>(n) + 1), example.grid.mesh.points[n]);
    EXPECT_EQ(found.node_data.at("\"u\"").at(static_cast<int>(n) + 1),
              example.grid.point_arrays[0].values[n]);
  }
  for (std::size_t c = 0; c < example.grid.mesh.cells.size(); ++c) {
    EXPECT_EQ(found.element_data.at("\"native\"").at(static_cast<int>(c) + 1),
              example.grid.cell_arrays[0].values[c]);
  }
  EXPECT_EQ(found.set_names, (std::map<int, std::string>{{1, "\"LOW\""}, {3, "\"HIGH\""}}));
  ASSERT_EQ(found.sets.size(), 2u);
  expect_set(found.sets.at(1), example, 0);
  expect_set(found.sets.at(3), example, 2);
  EXPECT_THAT(read_bytes(folder / "m.msh"), HasSubstr("SPACE=LPS LengthUnit=mm"));
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(Gmsh, ItselfFindsNothingWrong) {
  MESAMIS_REQUIRE_PROGRAM("gmsh");
  const TempFolder folder;
  const FiniteElementExample example;
  write_gmsh(folder / "m.msh", example.grid, example.sets);
  EXPECT_EQ(run_in(folder.path(), "gmsh m.msh -check -nopopup"), 0);
  const std::string log = read_bytes(folder / "log");
  EXPECT_THAT(log, HasSubstr(std::to_string(example.grid.mesh.points.size()) + " nodes"));
  EXPECT_THAT(log, HasSubstr(std::to_string(example.grid.mesh.cells.size()) + " elements"));
  EXPECT_THAT(log, Not(HasSubstr("Warning")));
  EXPECT_THAT(log, Not(HasSubstr("Error")));
}

TEST(Gmsh, TurnsWithTheFrame) {
  const TempFolder folder;
  const FiniteElementExample example;
  write_gmsh(folder / "m.msh", example.grid, example.sets, Frame::kRas);
  const Vec3 p = example.grid.mesh.points[7];
  EXPECT_EQ(parse_gmsh(folder / "m.msh").nodes.at(8), (Vec3{-p.x, -p.y, p.z}));
  EXPECT_THAT(read_bytes(folder / "m.msh"), HasSubstr("SPACE=RAS"));
}

TEST(Gmsh, TakesArraysOfOneComponentAlone) {
  const TempFolder folder;
  FiniteElementExample e;
  e.grid.cell_arrays[0].components = 3;
  EXPECT_REFUSED(write_gmsh(folder / "m.msh", e.grid, e.sets), HasSubstr("array 'native'"));
  EXPECT_EQ(folder.file_count(), 0);
}

}  // namespace
}  // namespace mesamis
