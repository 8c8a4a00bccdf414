// SPDX-License-Identifier: Apache-2.0
// Gmsh files with parts and sets, judged by Gmsh where it is installed.
#include <gmock/gmock.h>

#include <sstream>

#include "mesamis/shape_files/element_files.h"
#include "shape_files/element_example.h"
#include "support/external_program.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// The lines of a section.
std::vector<std::string> section(const std::filesystem::path& path, const std::string& name) {
  std::istringstream in(read_bytes(path));
  std::vector<std::string> lines;
  std::string line;
  while (std::getline(in, line) && line != "$" + name) {
  }
  while (std::getline(in, line) && line != "$End" + name) lines.push_back(line);
  return lines;
}

std::vector<int> numbers_of(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<int>(in), {}};
}

TEST(GmshElements, OfVersionTwoAreThisText) {
  const TempFolder folder;
  write_elements(folder / "m.msh", two_elements(false));
  EXPECT_THAT(read_bytes(folder / "m.msh"),
              StartsWith("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                         "$PhysicalNames\n3\n2 4 \"FLOOR\"\n3 1 \"HEAD\"\n3 3 \"SHAFT\"\n"
                         "$EndPhysicalNames\n"
                         "$Nodes\n5\n1 0 0 0\n2 2 0 0\n3 0 2 0\n4 0 0 2\n5 2 2 2.5\n$EndNodes\n"
                         "$Elements\n3\n1 4 2 1 1 1 2 3 4\n2 4 2 3 3 2 5 3 4\n3 2 2 4 4 1 3 2\n"
                         "$EndElements\n"
                         "$Comments\n"));
  FiniteElements without_sets = two_elements(false);
  without_sets.sets.clear();
  write_elements(folder / "m.msh", without_sets);
  EXPECT_THAT(read_bytes(folder / "m.msh"),
              HasSubstr("$ElementData\n1\n\"part\"\n1\n0\n3\n0\n1\n2\n1 1\n2 3\n"));
  write_elements(folder / "m.msh", two_elements(false));
  EXPECT_THAT(read_bytes(folder / "m.msh"),
              HasSubstr("SPACE=LPS LengthUnit=mm\nHEAD: near\nNECK: \nSHAFT: far\n"
                        "STIFF: 17000 MPa, 0.3, 1.9 g/cm^3\n"));
}

TEST(GmshElements, OfVersionFourAreThisText) {
  const TempFolder folder;
  write_elements(folder / "m.msh", two_elements(false), {.gmsh = GmshVersion::k41});
  EXPECT_THAT(read_bytes(folder / "m.msh"),
              StartsWith("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
                         "$PhysicalNames\n3\n2 4 \"FLOOR\"\n3 1 \"HEAD\"\n3 3 \"SHAFT\"\n"
                         "$EndPhysicalNames\n"
                         "$Entities\n0 0 1 2\n4 0 0 0 2 2 2.5 1 4 0\n1 0 0 0 2 2 2.5 1 1 0\n"
                         "3 0 0 0 2 2 2.5 1 3 0\n$EndEntities\n"
                         "$Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n"
                         "0 0 0\n2 0 0\n0 2 0\n0 0 2\n2 2 2.5\n$EndNodes\n"
                         "$Elements\n3 3 1 3\n3 1 4 1\n1 1 2 3 4\n3 3 4 1\n2 2 5 3 4\n"
                         "2 4 2 1\n3 1 3 2\n$EndElements\n"));
}

/// meshio matches values by their place: it needs one for each element, faces of sets included.
TEST(GmshElements, EveryElementHasAValueInTheOrderOfTheFile) {
  const TempFolder folder;
  FiniteElements e = two_elements(false);
  e.part_of_cell = {2, 0};  // parts are no longer in the order of the cells
  write_elements(folder / "m.msh", e, {.gmsh = GmshVersion::k41});
  EXPECT_THAT(section(folder / "m.msh", "Elements"),
              testing::ElementsAre("3 3 1 3", "3 1 4 1", "2 2 5 3 4", "3 3 4 1", "1 1 2 3 4",
                                   "2 4 2 1", "3 1 3 2"));
  const auto lines = section(folder / "m.msh", "ElementData");
  ASSERT_EQ(lines.size(), 11u);
  EXPECT_THAT(std::vector(lines.begin() + 8, lines.end()),
              testing::ElementsAre("2 1", "1 3", "3 3"));
}

/// Gmsh's second order: tetrahedra 1-2, 2-3, 1-3, 1-4, 3-4, 2-4, triangles 1-2, 2-3, 3-1.
TEST(GmshElements, QuadraticOnesHaveGmshsOrder) {
  const TempFolder folder;
  const FiniteElements e = two_elements(true);
  write_elements(folder / "m.msh", e);
  const auto lines = section(folder / "m.msh", "Elements");
  ASSERT_EQ(lines.size(), 4u);
  for (std::size_t c = 1; c <= 2; ++c) {
    auto numbers = numbers_of(lines[c]);
    EXPECT_EQ(numbers.at(1), 11);
    numbers.erase(numbers.begin(), numbers.begin() + 5);
    expect_middles(
        points_of(e.points, numbers), 4,
        std::array<std::array<int, 2>, 6>{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}});
  }
  auto numbers = numbers_of(lines[3]);
  EXPECT_EQ(numbers.at(1), 9);
  numbers.erase(numbers.begin(), numbers.begin() + 5);
  expect_middles(points_of(e.points, numbers), 3,
                 std::array<std::array<int, 2>, 3>{{{0, 1}, {1, 2}, {2, 0}}});
}

TEST(GmshElements, TakeArraysOfOneComponentAlone) {
  const TempFolder folder;
  const std::vector<MeshArray> wide{{"grad", 3, {1, 2, 3, 4, 5, 6}}}, good{{"u", 1, {1.5, 2.5}}};
  EXPECT_REFUSED(write_elements(folder / "m.msh", two_elements(false), {.cell_arrays = wide}),
                 HasSubstr("array 'grad'"));
  EXPECT_REFUSED(write_elements(folder / "m.msh", two_elements(false), {.point_arrays = good}),
                 HasSubstr("expected 5 scalars"));
  EXPECT_EQ(folder.file_count(), 0);
  FiniteElements without_sets = two_elements(false);
  without_sets.sets.clear();
  write_elements(folder / "m.msh", without_sets, {.cell_arrays = good});
  EXPECT_THAT(read_bytes(folder / "m.msh"), HasSubstr("\"u\"\n1\n0\n3\n0\n1\n2\n1 1.5\n2 2.5\n"));
}

/// What Gmsh itself finds in both versions, of linear and of quadratic elements.
class GmshJudges : public testing::TestWithParam<std::tuple<GmshVersion, bool>> {
 protected:
  const bool quadratic_ = std::get<1>(GetParam());
  FiniteElements elements_ = box_elements({{0, 0, 0}, {3, 4, 5}}, {2, 3, 2}, quadratic_);
  const TempFolder folder_;

  void SetUp() override {
    elements_.parts.push_back({"OTHER"});
    for (std::size_t c = 0; c < elements_.cells.size(); ++c) elements_.part_of_cell[c] = c % 2;
  }
  void write() { write_elements(folder_ / "m.msh", elements_, {.gmsh = std::get<0>(GetParam())}); }
};

TEST_P(GmshJudges, NothingWrong) {
  MESAMIS_REQUIRE_PROGRAM("gmsh");
  write();
  EXPECT_EQ(run_in(folder_.path(), "gmsh m.msh -check -nopopup"), 0);
  std::size_t faces = 0;
  for (const auto& set : elements_.sets) faces += set.faces.size();
  const std::string log = read_bytes(folder_ / "log");
  EXPECT_THAT(log, HasSubstr(std::to_string(elements_.points.size()) + " nodes"));
  EXPECT_THAT(log, HasSubstr(std::to_string(elements_.cells.size() + faces) + " elements"));
  EXPECT_THAT(log, Not(HasSubstr("Warning")));
  EXPECT_THAT(log, Not(HasSubstr("Error")));
}

/// Gmsh converts to Abaqus, whose order of mid-side nodes is ours: the elements come back.
TEST_P(GmshJudges, TheOrderOfNodesRight) {
  MESAMIS_REQUIRE_PROGRAM("gmsh");
  write();
  ASSERT_EQ(run_in(folder_.path(), "gmsh m.msh -save_all -format inp -o back.inp -save -nopopup"),
            0);
  std::istringstream in(read_bytes(folder_ / "back.inp"));
  const std::string type = quadratic_ ? "type=C3D10" : "type=C3D4";
  std::size_t seen = 0;
  bool inside = false;
  std::string pending;
  for (std::string line; std::getline(in, line);) {
    if (line[0] == '*') {
      inside = line.find(type + ",") != line.npos;
      continue;
    }
    if (!inside) continue;
    pending += line + " ";
    if (line.find_last_not_of(' ') != line.npos && line[line.find_last_not_of(' ')] == ',')
      continue;
    std::replace(pending.begin(), pending.end(), ',', ' ');
    const auto numbers = numbers_of(pending);
    pending.clear();
    const auto c = static_cast<std::size_t>(numbers.at(0)) - 1;
    std::vector<int> expected{numbers[0]};
    for (const Index n : elements_.cells.at(c)) expected.push_back(n + 1);
    if (quadratic_) {
      for (const Index n : elements_.mid_nodes[c]) expected.push_back(n + 1);
    }
    EXPECT_EQ(numbers, expected);
    ++seen;
  }
  EXPECT_EQ(seen, elements_.cells.size());
}

INSTANTIATE_TEST_SUITE_P(BothVersionsAndOrders, GmshJudges,
                         testing::Combine(testing::Values(GmshVersion::k22, GmshVersion::k41),
                                          testing::Bool()));

}  // namespace
}  // namespace mesamis
