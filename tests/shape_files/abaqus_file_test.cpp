// SPDX-License-Identifier: Apache-2.0
// Abaqus files, read back by a parser of their own and judged by CalculiX where it is installed.
#include <gmock/gmock.h>

#include <sstream>

#include "shape_files/finite_element_example.h"
#include "support/external_program.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::Not;

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

TEST(Abaqus, ReadsBackToThirteenDigits) {
  const TempFolder folder;
  const FiniteElementExample example;
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

TEST(Abaqus, TurnsWithTheFrame) {
  const TempFolder folder;
  const FiniteElementExample example;
  write_abaqus(folder / "m.inp", example.grid.mesh, example.sets, Frame::kRas);
  std::map<std::string, std::vector<int>> sets;
  const Vec3 p = example.grid.mesh.points[7], q = parse_abaqus(folder / "m.inp", sets).nodes.at(8);
  EXPECT_LT(norm(q - Vec3{-p.x, -p.y, p.z}), 1e-9);
  EXPECT_THAT(read_bytes(folder / "m.inp"), HasSubstr("frame RAS"));
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
