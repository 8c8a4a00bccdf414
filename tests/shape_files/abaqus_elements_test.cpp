// SPDX-License-Identifier: Apache-2.0
// Abaqus files with parts, materials and sets, run by CalculiX where it is installed.
#include <gmock/gmock.h>

#include <sstream>

#include "mesamis/shape_files/element_files.h"
#include "shape_files/element_example.h"
#include "support/external_program.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(AbaqusElements, OfTwoElementsAreThisText) {
  const TempFolder folder;
  write_elements(folder / "m.inp", two_elements(false));
  EXPECT_EQ(read_bytes(folder / "m.inp"),
            "*HEADING\nTetrahedral mesh of a scan\n"
            "** Lengths in mm; frame LPS: x left, y back, z head\n"
            "*NODE, NSET=ALL\n"
            "1, 0, 0, 0\n2, 2, 0, 0\n3, 0, 2, 0\n4, 0, 0, 2\n5, 2, 2, 2.5\n"
            "*ELEMENT, TYPE=C3D4, ELSET=ALL\n1, 1, 2, 3, 4\n2, 2, 5, 3, 4\n"
            "** Part HEAD: near\n*ELSET, ELSET=HEAD\n1\n*NSET, NSET=HEAD\n1, 2, 3, 4\n"
            "** Part NECK\n"
            "** Part SHAFT: far\n*ELSET, ELSET=SHAFT\n2\n*NSET, NSET=SHAFT\n2, 3, 4, 5\n"
            "** Moduli in MPa, densities in tonne/mm^3\n"
            "*ELSET, ELSET=STIFF\n1\n"
            "*MATERIAL, NAME=STIFF\n*ELASTIC\n17000, 0.3\n*DENSITY\n1.9e-09,\n"
            "*SOLID SECTION, ELSET=STIFF, MATERIAL=STIFF\n"
            "*ELSET, ELSET=SOFT\n2\n"
            "*MATERIAL, NAME=SOFT\n*ELASTIC\n350.5, 0.25\n"
            "*SOLID SECTION, ELSET=SOFT, MATERIAL=SOFT\n"
            "*NSET, NSET=FLOOR\n1, 2, 3\n"
            "*SURFACE, NAME=FLOOR, TYPE=ELEMENT\n1, S1\n");
}

TEST(AbaqusElements, WithoutMaterialsShowWhereTheyGo) {
  const TempFolder folder;
  FiniteElements e = two_elements(false);
  e.materials.clear();
  e.material_of_cell.clear();
  write_elements(folder / "m.inp", e);
  EXPECT_THAT(read_bytes(folder / "m.inp"),
              HasSubstr("** *SOLID SECTION, ELSET=SHAFT, MATERIAL=MAT_SHAFT\n"));
  EXPECT_THAT(read_bytes(folder / "m.inp"), Not(HasSubstr("\n*SOLID")));
}

/// C3D10: 1-2, 2-3, 3-1, 1-4, 2-4, 3-4.
TEST(AbaqusElements, QuadraticOnesHaveAbaqusOrder) {
  const TempFolder folder;
  const FiniteElements e = two_elements(true);
  write_elements(folder / "m.inp", e);
  std::istringstream in(read_bytes(folder / "m.inp"));
  std::string line;
  while (line != "*ELEMENT, TYPE=C3D10, ELSET=ALL") ASSERT_TRUE(std::getline(in, line));
  for (int element = 0; element < 2; ++element) {
    std::getline(in, line);
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::vector<int> numbers{std::istream_iterator<int>(words), {}};
    numbers.erase(numbers.begin());
    expect_middles(
        points_of(e.points, numbers), 4,
        std::array<std::array<int, 2>, 6>{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}});
  }
}

TEST(AbaqusElements, NumbersHaveTwentyCharactersAtMost) {
  const TempFolder folder;
  FiniteElements e = two_elements(false);
  e.points[0] = {-1.23456789012345678e-5, 1e-3 / 3, -1.0e-101 / 7};
  e.materials[0] = {"STIFF", 1e5 / 7, 1.0 / 3, 1.23456789012345678e-100};
  write_elements(folder / "m.inp", e, {.frame = Frame::kRas});
  std::istringstream in(read_bytes(folder / "m.inp"));
  EXPECT_THAT(in.str(), HasSubstr("1, 1.234567890123e-05, -0.0003333333333333, "));
  for (std::string line; std::getline(in, line);) {
    EXPECT_LE(line.size(), 132u);
    if (line[0] == '*' || line == "Tetrahedral mesh of a scan") continue;
    std::istringstream entries(line);
    for (std::string entry; std::getline(entries, entry, ',');) {
      entry.erase(0, entry.find_first_not_of(' '));
      EXPECT_LE(entry.size(), 20u) << line;
    }
  }
}

/// The first numbers of the lines of CalculiX's .dat behind a title.
std::vector<std::vector<double>> table_of(const std::string& text, const std::string& title) {
  std::istringstream in(text.substr(std::min(text.find(title), text.size())));
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::vector<double> row{std::istream_iterator<double>(words), {}};
    if (row.empty() && !rows.empty()) break;
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

/// A cube between sliding planes has the stress E times the strain, whatever its mesh. The force
/// on its top gives E back, and a pressure there its displacement: the sets of nodes and the names
/// of the faces are right.
class Cube : public testing::TestWithParam<bool> {
 protected:
  static constexpr double kModulus = 1234.5, kSide = 2;
  const char* kSupport = "*BOUNDARY\nLEFT, 1, 1\nFRONT, 2, 2\nBOTTOM, 3, 3\n";

  std::string run(const std::string& step) {
    const FiniteElements e =
        box_elements({{0, 0, 0}, {kSide, kSide, kSide}}, {3, 2, 2}, GetParam());
    write_elements(folder_ / "cube.inp", e);
    write_bytes(folder_ / "cube.inp", read_bytes(folder_ / "cube.inp") + "*STEP\n*STATIC\n" +
                                          kSupport + step + "*END STEP\n");
    EXPECT_EQ(run_in(folder_.path(), "ccx cube"), 0) << read_bytes(folder_ / "log");
    return read_bytes(folder_ / "cube.dat");
  }

  const TempFolder folder_;
};

TEST_P(Cube, InCompressionGivesItsModulusBack) {
  MESAMIS_REQUIRE_PROGRAM("ccx");
  const std::string found =
      run("*BOUNDARY\nTOP, 3, 3, -0.02\n*NODE PRINT, NSET=TOP, TOTALS=ONLY\nRF\n");
  const auto total = table_of(found, "total force");
  ASSERT_EQ(total.size(), 1u) << found;
  const double stress = -total[0].at(2) / (kSide * kSide), strain = 0.02 / kSide;
  EXPECT_NEAR(stress / strain, kModulus, 1e-6 * kModulus);
}

TEST_P(Cube, UnderPressureGivesItsModulusBack) {
  MESAMIS_REQUIRE_PROGRAM("ccx");
  const std::string found = run("*DSLOAD\nTOP, P, 12.345\n*NODE PRINT, NSET=TOP\nU\n");
  const auto rows = table_of(found, "displacements");
  EXPECT_GE(rows.size(), 9u) << found;
  for (const char* face : {", S1\n", ", S2\n", ", S3\n", ", S4\n"}) {
    const std::string text = read_bytes(folder_ / "cube.inp");
    EXPECT_NE(text.find(face, text.find("*SURFACE, NAME=TOP")), text.npos) << face;
  }
  for (const auto& row : rows) {
    EXPECT_NEAR(row.at(3), -0.02, 2e-8);  // pressure times side over modulus
  }
}

INSTANTIATE_TEST_SUITE_P(LinearAndQuadratic, Cube, testing::Bool());

}  // namespace
}  // namespace mesamis
