// SPDX-License-Identifier: Apache-2.0
// Gmsh .msh and Abaqus .inp: read back by small parsers of their own, and judged by Gmsh and
// CalculiX where these are installed.
#include <gmock/gmock.h>

#include <map>
#include <random>
#include <sstream>

#include "mesamis/io/mesh_files.h"
#include "support/external_program.h"
#include "support/perturbed_box.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Example {
  MeshWithArrays grid{perturbed_box({{0, 0, 0}, {4, 5, 600}}, {3, 2, 4}, 0.2), {}, {}};
  CellSets sets{{{"LOW", "dark"}, {"EMPTY", "nothing"}, {"HIGH", "bright"}}, {}};

  Example() {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, 1000);
    MeshArray u{"u", 1, {}}, native{"native", 1, {}};
    for (std::size_t n = 0; n < grid.mesh.points.size(); ++n) u.values.push_back(normal(random));
    for (std::size_t c = 0; c < grid.mesh.cells.size(); ++c) {
      native.values.push_back(normal(random));
      sets.of_cell.push_back(random() % 2 ? 2 : 0);
    }
    grid.point_arrays = {u};
    grid.cell_arrays = {native};
    grid.mesh.points[0] = {-1.23456789012345678e-5, 1e-3 / 3, -1.0e-101 / 7};
  }
};

/// What a parser finds, by the file's own numbers.
struct FileContents {
  std::map<int, Vec3> nodes;
  std::map<int, std::vector<int>> elements, sets;
  std::map<int, std::string> set_names;
  std::map<std::string, std::map<int, double>> node_data, element_data;
};

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

/// Numbers separated by commas, each of 20 characters at most, as the programs read them.
std::vector<double> numbers_of(const std::string& line) {
  std::vector<double> numbers;
  std::istringstream in(line);
  for (std::string entry; std::getline(in, entry, ',');) {
    entry.erase(0, entry.find_first_not_of(' '));
    EXPECT_LE(entry.size(), 20u) << line;
    numbers.push_back(std::stod(entry));
  }
  EXPECT_LE(numbers.size(), 16u);
  return numbers;
}

FileContents parse_abaqus(const std::filesystem::path& path,
                          std::map<std::string, std::vector<int>>& sets) {
  std::istringstream in(read_bytes(path));
  FileContents found;
  std::string keyword;
  for (std::string line; std::getline(in, line);) {
    EXPECT_LE(line.size(), 132u);
    if (line.starts_with("**")) continue;
    if (line.starts_with("*")) {
      keyword = line;
    } else if (keyword == "*NODE, NSET=ALL") {
      const auto n = numbers_of(line);
      found.nodes[static_cast<int>(n.at(0))] = {n.at(1), n.at(2), n.at(3)};
    } else if (keyword == "*ELEMENT, TYPE=C3D4, ELSET=ALL") {
      const auto n = numbers_of(line);
      found.elements[static_cast<int>(n.at(0))] = {n.begin() + 1, n.end()};
    } else if (keyword.starts_with("*ELSET, ELSET=")) {
      auto& set = sets[keyword.substr(14)];
      for (const double n : numbers_of(line)) set.push_back(static_cast<int>(n));
    } else {
      EXPECT_EQ(keyword, "*HEADING");
    }
  }
  return found;
}

void expect_cells(const FileContents& found, const TetMesh& mesh) {
  ASSERT_EQ(found.nodes.size(), mesh.points.size());
  ASSERT_EQ(found.elements.size(), mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& corners = found.elements.at(static_cast<int>(c) + 1);
    ASSERT_EQ(corners.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(corners[i], mesh.cells[c][i] + 1);
  }
}

void expect_set(const std::vector<int>& numbers, const Example& example, Index set) {
  std::vector<int> expected;
  for (std::size_t c = 0; c < example.sets.of_cell.size(); ++c) {
    if (example.sets.of_cell[c] == set) expected.push_back(static_cast<int>(c) + 1);
  }
  EXPECT_EQ(numbers, expected);
}

TEST(Gmsh, ReadsBackBitEqual) {
  const TempFolder folder;
  const Example example;
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
  const Example example;
  write_gmsh(folder / "m.msh", example.grid, example.sets);
  EXPECT_EQ(run_in(folder.path(), "gmsh m.msh -check -nopopup"), 0);
  const std::string log = read_bytes(folder / "log");
  EXPECT_THAT(log, HasSubstr(std::to_string(example.grid.mesh.points.size()) + " nodes"));
  EXPECT_THAT(log, HasSubstr(std::to_string(example.grid.mesh.cells.size()) + " elements"));
  EXPECT_THAT(log, Not(HasSubstr("Warning")));
  EXPECT_THAT(log, Not(HasSubstr("Error")));
}

TEST(Abaqus, ReadsBackToThirteenDigits) {
  const TempFolder folder;
  const Example example;
  write_abaqus(folder / "m.inp", example.grid.mesh, example.sets);
  std::map<std::string, std::vector<int>> sets;
  const FileContents found = parse_abaqus(folder / "m.inp", sets);
  expect_cells(found, example.grid.mesh);
  for (std::size_t n = 0; n < example.grid.mesh.points.size(); ++n) {
    const Vec3 p = found.nodes.at(static_cast<int>(n) + 1), expected = example.grid.mesh.points[n];
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(p[a], expected[a], 5.1e-13 * std::abs(expected[a]));
  }
  ASSERT_EQ(sets.size(), 2u) << "an empty set is an error for some programs";
  expect_set(sets.at("LOW"), example, 0);
  expect_set(sets.at("HIGH"), example, 2);
  const std::string text = read_bytes(folder / "m.inp");
  EXPECT_THAT(text, HasSubstr("** LOW: dark\n*ELSET, ELSET=LOW\n"));
  EXPECT_THAT(text, HasSubstr("** EMPTY: nothing\n** HIGH"));
  EXPECT_THAT(text, HasSubstr("** *SOLID SECTION, ELSET=HIGH, MATERIAL=MAT_HIGH\n"));
  EXPECT_THAT(text, Not(HasSubstr("\n*SOLID")));
  EXPECT_THAT(text, HasSubstr("in mm; frame LPS"));
}

TEST(FiniteElementFiles, TurnWithTheFrame) {
  const TempFolder folder;
  const Example example;
  write_gmsh(folder / "m.msh", example.grid, example.sets, Frame::kRas);
  write_abaqus(folder / "m.inp", example.grid.mesh, example.sets, Frame::kRas);
  const Vec3 p = example.grid.mesh.points[7];
  EXPECT_EQ(parse_gmsh(folder / "m.msh").nodes.at(8), (Vec3{-p.x, -p.y, p.z}));
  std::map<std::string, std::vector<int>> sets;
  const Vec3 q = parse_abaqus(folder / "m.inp", sets).nodes.at(8);
  EXPECT_LT(norm(q - Vec3{-p.x, -p.y, p.z}), 1e-9);
  EXPECT_THAT(read_bytes(folder / "m.msh"), HasSubstr("SPACE=RAS"));
  EXPECT_THAT(read_bytes(folder / "m.inp"), HasSubstr("frame RAS"));
}

TEST(FiniteElementFiles, RefuseWhatDoesNotFit) {
  const TempFolder folder;
  const auto refused = [&folder](const Example& e, const std::string& words) {
    EXPECT_REFUSED(write_gmsh(folder / "m.msh", e.grid, e.sets), HasSubstr(words));
    EXPECT_REFUSED(write_abaqus(folder / "m.inp", e.grid.mesh, e.sets), HasSubstr(words));
  };
  Example e;
  e.sets.of_cell.pop_back();
  refused(e, "expected a set for each of 144 cells, found 143");
  e = {};
  e.sets.of_cell[5] = 3;
  refused(e, "a cell names set 3, there are 3");
  e = {};
  e.grid.mesh.cells[5][1] = 5000;
  refused(e, "a cell names a missing point");
  e = {};
  e.grid.mesh.points[5].y = std::nan("");
  refused(e, "not finite");
  e = {};
  e.grid.mesh = {};
  refused(e, "without cells");
  e = {};
  e.grid.cell_arrays[0].components = 3;
  EXPECT_REFUSED(write_gmsh(folder / "m.msh", e.grid, e.sets), HasSubstr("array 'native'"));
  EXPECT_EQ(folder.file_count(), 0);
  EXPECT_THROW(write_abaqus(folder / "no/m.inp", Example().grid.mesh, Example().sets), InputError);
}

/// A bar along x of two materials, four times as stiff in its second half, pulled by 0.1 mm.
/// Poisson's ratio is 0: linear elements have the exact solution.
TEST(Abaqus, CalculixFindsTheKnownDisplacementOfABarOfTwoMaterials) {
  MESAMIS_REQUIRE_PROGRAM("ccx");
  const TempFolder folder;
  const TetMesh mesh = box_mesh({{-5, 0, 0}, {5, 2, 2}}, {10, 2, 2});
  CellSets sets{{{"GREY_BIN_01", "soft"}, {"GREY_BIN_02", "stiff"}}, {}};
  for (const Cell& cell : mesh.cells) {
    const auto p = cell_corners(mesh, cell);
    sets.of_cell.push_back(p[0].x + p[1].x + p[2].x + p[3].x > 0);
  }
  write_abaqus(folder / "bar.inp", mesh, sets);
  std::ostringstream step;
  for (const auto* at : {"LEFT", "MIDDLE", "RIGHT"}) {
    step << "*NSET, NSET=" << at << "\n";
    const double x = at[0] == 'L' ? -5 : at[0] == 'M' ? 0 : 5;
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
      if (mesh.points[n].x == x) step << n + 1 << ",\n";
    }
  }
  step << "*MATERIAL, NAME=SOFT\n*ELASTIC\n1000., 0.\n*MATERIAL, NAME=STIFF\n*ELASTIC\n4000., 0.\n"
          "*SOLID SECTION, ELSET=GREY_BIN_01, MATERIAL=SOFT\n"
          "*SOLID SECTION, ELSET=GREY_BIN_02, MATERIAL=STIFF\n"
          "*STEP\n*STATIC\n*BOUNDARY\nALL, 2, 3\nLEFT, 1, 1\nRIGHT, 1, 1, 0.1\n"
          "*NODE PRINT, NSET=MIDDLE\nU\n*END STEP\n";
  write_bytes(folder / "bar.inp", read_bytes(folder / "bar.inp") + step.str());
  ASSERT_EQ(run_in(folder.path(), "ccx bar"), 0) << read_bytes(folder / "log");
  std::istringstream in(read_bytes(folder / "bar.dat"));
  int nodes = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream numbers(line);
    int node = 0;
    double x = 0;
    if (!(numbers >> node >> x)) continue;
    EXPECT_NEAR(x, 0.1 * 4 / 5, 1e-7);  // strains 4 : 1 over equal lengths
    ++nodes;
  }
  EXPECT_EQ(nodes, 9);
}

}  // namespace
}  // namespace mesamis
