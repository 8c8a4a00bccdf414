// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>

#include "mesamis/shape_files/mesh_files.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TEST(WritePvtu, NamesPiecesAndTheirArrays) {
  const TempFolder folder;
  const std::vector<MeshArray> points{{"u", 1, {}}, {"metric", 6, {}}}, cells{{"a<\"b\"&c", 1, {}}};
  write_pvtu(folder / "m.pvtu", std::vector<std::string>{"m_0.vtu", "m_1.vtu"}, points, cells);
  const std::string text = read_bytes(folder / "m.pvtu");
  for (const char* part :
       {"<VTKFile type=\"PUnstructuredGrid\"", "<PUnstructuredGrid GhostLevel=\"0\">",
        "Name=\"u\" NumberOfComponents=\"1\"", "Name=\"metric\" NumberOfComponents=\"6\"",
        "Name=\"a&lt;&quot;b&quot;&amp;c\"", "Name=\"Points\" NumberOfComponents=\"3\"",
        "<Piece Source=\"m_0.vtu\"/>", "<Piece Source=\"m_1.vtu\"/>", "</VTKFile>"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_LT(text.find("PPointData"), text.find("PCellData"));
  EXPECT_LT(text.find("m_0.vtu"), text.find("m_1.vtu"));
}

TEST(WritePvtu, VtkReadsAllPieces) {
  const TempFolder folder;
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  const std::vector<std::string> pieces{"m_0.vtu", "m_1.vtu", "m_2.vtu"};
  std::vector<MeshArray> u{{"u", 1, {1, 2, 3, 4}}}, bin{{"bin", 1, {0}}};
  for (const std::string& piece : pieces) {
    bin[0].values[0] += 10;
    write_vtu(folder / piece, mesh, {u, bin});
  }
  write_pvtu(folder / "m.pvtu", pieces, u, bin);
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  reader->SetFileName((folder / "m.pvtu").c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  EXPECT_EQ(grid->GetNumberOfCells(), 3);
  EXPECT_EQ(grid->GetNumberOfPoints(), 12);
  EXPECT_EQ(grid->GetCellData()->GetArray("bin")->GetTuple1(2), 30);
  EXPECT_EQ(grid->GetPointData()->GetArray("u")->GetTuple1(7), 4);
}

TEST(WritePvtu, RefusesAFolderThatIsNotThere) {
  const TempFolder folder;
  EXPECT_REFUSED(write_pvtu(folder / "none/m.pvtu", {}, {}, {}), HasSubstr("none"));
  EXPECT_EQ(folder.file_count(), 0);
}

}  // namespace
}  // namespace mesamis
