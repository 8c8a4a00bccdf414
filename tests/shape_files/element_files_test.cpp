// SPDX-License-Identifier: Apache-2.0
// What all formats share, .vtu and .mesh; each other format has a test of its own.
#include "mesamis/shape_files/element_files.h"

#include <gmock/gmock.h>
#include <vtkCell.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <limits>

#include "mesamis/files/memory_budget.h"
#include "mesamis/shape_files/file_kind.h"
#include "mesamis/shape_files/vtk_xml.h"
#include "shape_files/element_example.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> cell_array(const MeshWithArrays& grid, const std::string& name) {
  for (const MeshArray& array : grid.cell_arrays) {
    if (array.name == name) return array.values;
  }
  ADD_FAILURE() << "no array " << name;
  return {};
}

/// Of quadratic elements the corners; the nodes between them stay, with their values.
TEST(ElementFiles, VtuOfQuadraticElementsReadsBackByItsCorners) {
  const TempFolder folder;
  const FiniteElements e = two_elements(true);
  write_elements(folder / "m.vtu", e, {});
  const MeshWithArrays found = read_mesh(folder / "m.vtu");
  EXPECT_TRUE(found.quadratic);
  EXPECT_EQ(found.mesh.points, e.points);
  EXPECT_EQ(found.mesh.cells, e.cells);
  EXPECT_THAT(cell_array(found, "part"), ElementsAre(1, 3));
  write_elements(folder / "l.vtu", two_elements(false), {});
  EXPECT_FALSE(read_mesh(folder / "l.vtu").quadratic);
}

TEST(ElementFiles, VtuOfLinearElementsReadsBack) {
  const TempFolder folder;
  const FiniteElements e = two_elements(false);
  const std::vector<MeshArray> points{{"u", 1, {1, 2, 3, 4, 5}}}, cells{{"grey", 1, {7, 8}}};
  write_elements(folder / "m.VTU", e,
                 {.point_arrays = points, .cell_arrays = cells, .frame = Frame::kRas});
  const MeshWithArrays found = read_mesh(folder / "m.VTU");
  EXPECT_EQ(found.mesh.points, e.points);
  EXPECT_EQ(found.mesh.cells, e.cells);
  EXPECT_EQ(found.point_arrays.at(0).values, points[0].values);
  EXPECT_THAT(cell_array(found, "part"), ElementsAre(1, 3));
  EXPECT_THAT(cell_array(found, "material"), ElementsAre(1, 2));
  EXPECT_THAT(cell_array(found, "modulus"), ElementsAre(17000, 350.5));
  EXPECT_THAT(cell_array(found, "poisson"), ElementsAre(0.3, 0.25));
  EXPECT_THAT(cell_array(found, "density"), ElementsAre(1.9, 0));
  EXPECT_EQ(cell_array(found, "grey"), cells[0].values);
  ASSERT_EQ(found.point_arrays.size(), e.sets.size() + points.size());
  for (std::size_t s = 0; s < e.sets.size(); ++s) {
    const MeshArray& array = found.point_arrays[points.size() + s];
    EXPECT_EQ(array.name, "set_" + e.sets[s].name);
    for (std::size_t n = 0; n < e.points.size(); ++n) {
      EXPECT_EQ(array.values[n], std::ranges::count(e.sets[s].nodes, static_cast<Index>(n)));
    }
  }
}

TEST(ElementFiles, VtuOfQuadraticElementsHasVtksOrder) {
  const TempFolder folder;
  const FiniteElements e = two_elements(true);
  write_elements(folder / "m.vtu", e);
  const std::string bytes = read_bytes(folder / "m.vtu");
  MemoryBudget budget(folder / "m.vtu", {});
  VtkXml xml(folder / "m.vtu", bytes, "UnstructuredGrid", budget);
  const XmlElement* piece = xml.data_set().child("Piece");
  ASSERT_NE(piece, nullptr);
  const auto& arrays = piece->child("Cells")->children;
  const auto connectivity = xml.values(arrays.at(0), 20);
  EXPECT_THAT(xml.values(arrays.at(1), 2), ElementsAre(10, 20));
  EXPECT_THAT(xml.values(arrays.at(2), 2), ElementsAre(24, 24));
  for (std::size_t c = 0; c < 2; ++c) {
    std::vector<int> numbers;
    for (std::size_t i = 0; i < 10; ++i) {
      numbers.push_back(static_cast<int>(connectivity[10 * c + i]) + 1);
    }
    // vtkQuadraticTetra: (0,1), (1,2), (2,0), (0,3), (1,3), (2,3)
    expect_middles(
        points_of(e.points, numbers), 4,
        std::array<std::array<int, 2>, 6>{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}});
  }
  EXPECT_THAT(bytes, AllOf(HasSubstr("PartNames"), HasSubstr("MaterialNames")));
}

/// VTK's own shape functions find each mid-side node in the middle of its edge.
TEST(ElementFiles, VtkReadsQuadraticElements) {
  const TempFolder folder;
  const FiniteElements e = two_elements(true);
  write_elements(folder / "m.vtu", e);
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "m.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  const double corners[4][3]{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (vtkIdType c = 0; c < 2; ++c) {
    vtkCell* cell = grid->GetCell(c);
    EXPECT_EQ(cell->GetCellType(), VTK_QUADRATIC_TETRA);
    for (std::size_t m = 0; m < 6; ++m) {
      double at[3], found[3], weights[10];
      for (int axis = 0; axis < 3; ++axis) {
        at[axis] = (corners[kMidNodeEdges[m][0]][axis] + corners[kMidNodeEdges[m][1]][axis]) / 2;
      }
      int part = 0;
      cell->EvaluateLocation(part, at, found, weights);
      EXPECT_NEAR(weights[4 + m], 1, 1e-12);
      const Vec3 expected =
          e.points[static_cast<std::size_t>(e.mid_nodes[static_cast<std::size_t>(c)][m])];
      EXPECT_LT(norm(Vec3{found[0], found[1], found[2]} - expected), 1e-12);
    }
  }
}

TEST(ElementFiles, MeditHoldsPartsAsReferencesAndNoMidSideNodes) {
  const TempFolder folder;
  const FiniteElements e = two_elements(false);
  write_elements(folder / "m.mesh", e);
  EXPECT_EQ(read_medit_mesh(folder / "m.mesh").cells, e.cells);
  EXPECT_THAT(read_bytes(folder / "m.mesh"), HasSubstr("1 2 3 4 1\n2 5 3 4 3\n"));
  EXPECT_REFUSED(write_elements(folder / "q.mesh", two_elements(true)),
                 HasSubstr("expected linear elements for .mesh, found mid-side nodes"));
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(ElementFiles, FacesTurnOutwardAndHaveTheirMiddles) {
  const FiniteElements e = two_elements(true);
  for (int vertex = 0; vertex < 4; ++vertex) {
    const auto nodes = face_nodes(e, 1, vertex);
    std::vector<Vec3> p;
    for (const Index n : nodes) p.push_back(e.points[static_cast<std::size_t>(n)]);
    const Vec3 apex =
        e.points[static_cast<std::size_t>(e.cells[1][static_cast<std::size_t>(vertex)])];
    EXPECT_LT(six_volume(p[0], p[1], p[2], apex), 0);
    expect_middles(p, 3, std::array<std::array<int, 2>, 3>{{{0, 1}, {1, 2}, {2, 0}}});
  }
}

TEST(ElementFiles, OtherExtensionsAreRefused) {
  const TempFolder folder;
  EXPECT_REFUSED(write_elements(folder / "m.stl", two_elements(false)),
                 AllOf(HasSubstr(".stl"), HasSubstr(".inp .feb .msh .vtu .mesh")));
}

TEST(ElementFiles, WhatDoesNotFitIsRefused) {
  const TempFolder folder;
  const auto refused = [&](auto change, const auto& matcher) {
    for (const char* name : {"m.inp", "m.feb", "m.msh", "m.vtu"}) {
      FiniteElements e = two_elements(true);
      change(e);
      EXPECT_REFUSED(write_elements(folder / name, e), matcher);
    }
  };
  refused([](auto& e) { e.cells.clear(); }, HasSubstr("without cells"));
  refused([](auto& e) { e.part_of_cell.pop_back(); }, HasSubstr("a part for each of 2 cells"));
  refused([](auto& e) { e.part_of_cell[0] = 3; }, HasSubstr("names part 3, there are 3"));
  refused([](auto& e) { e.materials.clear(); }, HasSubstr("names material 0, there are 0"));
  refused([](auto& e) { e.material_of_cell.clear(); }, HasSubstr("a material for each of 2"));
  refused([](auto& e) { e.mid_nodes.pop_back(); }, HasSubstr("six mid-side nodes for each of 2"));
  refused([](auto& e) { e.mid_nodes[1][5] = 99; }, HasSubstr("a cell names a missing point"));
  refused([](auto& e) { e.cells[1][3] = -1; }, HasSubstr("a cell names a missing point"));
  refused([](auto& e) { e.materials[1].modulus = 0; }, HasSubstr("\"SOFT\""));
  refused([](auto& e) { e.materials[1].poisson = 0.5; }, HasSubstr("350.5, 0.5, 0"));
  refused([](auto& e) { e.materials[1].density = -1; }, HasSubstr("350.5, 0.25, -1"));
  refused([](auto& e) { e.sets[0].nodes.push_back(44); }, HasSubstr("names a missing point"));
  refused([](auto& e) { e.sets[0].faces = {{1, 4}}; }, HasSubstr("names face 4 of cell 1"));
  refused([](auto& e) { e.sets[0].faces = {{2, 0}}; }, HasSubstr("names face 0 of cell 2"));
  refused([](auto& e) { e.parts[1].name = "1A"; }, HasSubstr("begins with a letter"));
  refused([](auto& e) { e.sets[0].name = "a b"; }, HasSubstr("letters, digits"));
  refused([](auto& e) { e.materials[0].name = std::string(61, 'x'); }, HasSubstr("at most 60"));
  refused([](auto& e) { e.sets[0].name = "head"; }, HasSubstr("again"));
  refused([](auto& e) { e.parts[0].name = "All"; }, HasSubstr("none ALL"));
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(ElementFiles, CoordinatesAreFinite) {
  const TempFolder folder;
  FiniteElements e = two_elements(false);
  e.points[2].y = std::numeric_limits<double>::infinity();
  for (const char* name : {"m.inp", "m.feb", "m.msh", "m.mesh", "m.vtu"}) {
    EXPECT_REFUSED(write_elements(folder / name, e), HasSubstr("finite"));
  }
  EXPECT_EQ(folder.file_count(), 0);
}

}  // namespace
}  // namespace mesamis
