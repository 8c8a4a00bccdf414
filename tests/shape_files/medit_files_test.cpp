// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <limits>
#include <random>

#include "mesamis/shape_files/mesh_files.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

TetMesh odd_mesh() {
  TetMesh mesh = box_mesh({{-1, -2, -3}, {4, 5, 6}}, {2, 3, 1});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (Vec3& p : mesh.points) p += Vec3{uniform(random), uniform(random), uniform(random)};
  mesh.points[0] = {1.0 / 3, -0.0, std::numeric_limits<double>::min()};
  mesh.points[1] = {1e300, -1e-300, 12345678901234567890.0};
  return mesh;
}

TetMesh read_text(const TempFolder& folder, const std::string& text) {
  write_bytes(folder / "m.mesh", text);
  return read_medit_mesh(folder / "m.mesh");
}

const std::string kOneCell =
    "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
    "Tetrahedra\n1\n1 2 3 4 0\nEnd\n";

TEST(Medit, MeshReadsBackBitEqual) {
  const TempFolder folder;
  const TetMesh mesh = odd_mesh();
  write_medit_mesh(folder / "m.mesh", mesh);
  const TetMesh back = read_medit_mesh(folder / "m.mesh");
  EXPECT_EQ(back.points, mesh.points);
  EXPECT_TRUE(std::signbit(back.points[0].y));
  EXPECT_EQ(back.cells, mesh.cells);
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(Medit, MetricReadsBackBitEqualInTheFormatsOrder) {
  const TempFolder folder;
  const std::vector<Sym3> metrics{{11, 12, 13, 22, 23, 33}, {0.1, 1e-17, -3e100, 1.0 / 7, 5, 6}};
  write_medit_metric(folder / "m.sol", metrics);
  EXPECT_EQ(read_medit_metric(folder / "m.sol"), metrics);
  EXPECT_THAT(read_bytes(folder / "m.sol"), HasSubstr("\n2\n1 3\n11 12 22 13 23 33\n"));
}

TEST(Medit, ReferencesAndFieldsOfCellsAreWrittenAndSkippedOnReading) {
  const TempFolder folder;
  const TetMesh mesh = box_mesh({{0, 0, 0}, {1, 1, 1}}, {1, 1, 1});
  const std::vector<Index> references{1, 2, 3, 4, 5, 17};
  write_medit_mesh(folder / "m.mesh", mesh, Frame::kLps, references);
  EXPECT_EQ(read_medit_mesh(folder / "m.mesh").cells, mesh.cells);
  EXPECT_THAT(read_bytes(folder / "m.mesh"), HasSubstr(" 17\n\nEnd"));
  const std::vector<Index> few{1};
  EXPECT_REFUSED(write_medit_mesh(folder / "m.mesh", mesh, Frame::kLps, few),
                 HasSubstr("a reference for each of 6 cells, found 1"));
  const std::vector<std::vector<double>> sizes{{0.5, 2}}, of_cells{{1, 2, 3}, {4, 5, 6}};
  write_medit_scalars(folder / "h.sol", sizes, of_cells);
  EXPECT_EQ(read_medit_metric(folder / "h.sol").size(), 2u);
  EXPECT_THAT(read_bytes(folder / "h.sol"),
              HasSubstr("\nSolAtTetrahedra\n3\n2 1 1\n1 4\n2 5\n3 6\n"));
}

TEST(Medit, SizesBecomeIsotropicMetrics) {
  const TempFolder folder;
  const std::vector<std::vector<double>> sizes{{0.5, 2}};
  write_medit_scalars(folder / "h.sol", sizes);
  const auto metrics = read_medit_metric(folder / "h.sol");
  EXPECT_EQ(metrics, (std::vector<Sym3>{4 * kIdentity3, 0.25 * kIdentity3}));
}

TEST(Medit, ToleratesLayoutCommentsAndOtherSections) {
  const TempFolder folder;
  const TetMesh mesh =
      read_text(folder,
                "# made on an old Mac\r#\n MeshVersionFormatted\n1 Dimension\t3\r\nCorners 2 1 2\n"
                "Triangles\n1\n1 2 3 7\nVertices 4 # four\n0 0 0 1\n+1 0 0 2 0 1 0 3\n0 0 1.e0 4\n"
                "Normals 1\n0 0 1.5\nTetrahedra 1 1 2 3 4 99");
  EXPECT_EQ(mesh.points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(mesh.cells, (std::vector<Cell>{{0, 1, 2, 3}}));
}

TEST(Medit, CellsMayComeBeforeTheirVertices) {
  const TempFolder folder;
  const TetMesh mesh = read_text(folder,
                                 "MeshVersionFormatted 2 Dimension 3 Tetrahedra 1 1 2 3 4 0 "
                                 "Vertices 4 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0 End ignored");
  EXPECT_EQ(mesh.cells.size(), 1u);
}

TEST(Medit, NamesFileLineAndSectionOfWhatIsWrong) {
  const TempFolder folder;
  const auto replaced = [](const std::string& from, const std::string& to) {
    std::string text = kOneCell;
    return text.replace(text.find(from), from.size(), to);
  };
  ASSERT_EQ(read_text(folder, kOneCell).cells.size(), 1u);
  EXPECT_REFUSED(read_text(folder, ""), HasSubstr("MeshVersionFormatted"));
  EXPECT_REFUSED(read_text(folder, "solid ascii"), HasSubstr("found \"solid\""));
  EXPECT_REFUSED(read_text(folder, replaced("n 3", "n 2")), HasSubstr(":2: Dimension"));
  EXPECT_REFUSED(read_text(folder, replaced("Dimension 3", "")), HasSubstr(":3: Vertices"));
  EXPECT_REFUSED(read_text(folder, replaced("1 0 0 0", "1 x 0 0")),
                 HasSubstr("m.mesh:6: Vertices: expected a coordinate, found \"x\""));
  EXPECT_REFUSED(read_text(folder, replaced("1 0 0 0", "nan 0 0 0")), HasSubstr(":6:"));
  EXPECT_REFUSED(read_text(folder, replaced("1 0 0 0", "1e999 0 0 0")), HasSubstr(":6:"));
  EXPECT_REFUSED(read_text(folder, replaced("1 2 3 4", "1 2 3 5")), HasSubstr("names vertex 5"));
  EXPECT_REFUSED(read_text(folder, replaced("1 2 3 4", "0 1 2 3")), HasSubstr(":11: Tetrahedra"));
  EXPECT_REFUSED(read_text(folder, replaced("1 2 3 4", "1 2 3.5 4")), HasSubstr("\"3.5\""));
  EXPECT_REFUSED(read_text(folder, replaced("\n4\n", "\n5\n")), HasSubstr("Vertices"));
  EXPECT_REFUSED(read_text(folder, replaced("\n4\n", "\n-4\n")), HasSubstr("-4"));
}

TEST(Medit, NeverTakesMemoryForMoreThanTheFileHolds) {
  const TempFolder folder;
  EXPECT_REFUSED(read_text(folder, "MeshVersionFormatted 2 Dimension 3 Vertices 2000000000 0 0"),
                 HasSubstr("2000000000"));
  EXPECT_REFUSED(read_text(folder, "MeshVersionFormatted 2 Dimension 3 Tetrahedra 99999999999999"),
                 HasSubstr("out of range"));
  write_bytes(folder / "m.sol", "MeshVersionFormatted 2 Dimension 3 SolAtVertices 1000000 1 3 1");
  EXPECT_REFUSED(read_medit_metric(folder / "m.sol"), HasSubstr("1000000"));
}

TEST(Medit, EveryTruncationIsRefusedOrHarmless) {
  const TempFolder folder;
  const auto whole = kOneCell.find("0\nEnd");
  for (std::size_t length = 0; length <= whole; ++length) {
    EXPECT_REFUSED(read_text(folder, kOneCell.substr(0, length)), HasSubstr("m.mesh"));
  }
  EXPECT_EQ(read_text(folder, kOneCell.substr(0, whole + 1)).cells.size(), 1u);
}

TEST(Medit, DamagedBytesNeverCrash) {
  const TempFolder folder;
  write_medit_metric(folder / "good.sol", std::vector<Sym3>(5, kIdentity3));
  const std::string sol = read_bytes(folder / "good.sol");
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    std::string text = i % 2 ? sol : kOneCell;
    for (int j = 0; j < 3; ++j) text[random() % text.size()] = static_cast<char>(random());
    write_bytes(folder / "bad", text);
    try {
      if (i % 2) {
        for (const Sym3& m : read_medit_metric(folder / "bad")) {
          EXPECT_TRUE(std::isfinite(trace(m)));
        }
      } else {
        for (const Cell& cell : read_medit_mesh(folder / "bad").cells) EXPECT_GE(cell[0], 0);
      }
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
    }
  }
}

TEST(Medit, RefusesSolutionsThatAreNoMetric) {
  const TempFolder folder;
  const auto read = [&folder](const std::string& body) {
    write_bytes(folder / "m.sol", "MeshVersionFormatted 2\nDimension 3\n" + body);
    return read_medit_metric(folder / "m.sol");
  };
  EXPECT_EQ(read("SolAtVertices 1 1 1 2").size(), 1u);
  EXPECT_REFUSED(read("SolAtVertices 1 2 1 1 2 2"), HasSubstr("expected one field"));
  EXPECT_REFUSED(read("SolAtVertices 1 1 2 1 1 1"), HasSubstr("found type 2"));
  EXPECT_REFUSED(read("SolAtVertices 2 1 1 1 0"), HasSubstr("must be positive"));
  EXPECT_REFUSED(read("SolAtVertices 1 1 1 1e-200"), HasSubstr("SolAtVertices"));
  EXPECT_REFUSED(read("SolAtTetrahedra 1 1 1 1"), HasSubstr("no SolAtVertices"));
}

TEST(Medit, RefusesToWriteWhatCannotBeReadBack) {
  const TempFolder folder;
  const std::vector<Sym3> metrics{{std::nan(""), 0, 0, 1, 0, 1}};
  EXPECT_REFUSED(write_medit_metric(folder / "m.sol", metrics), HasSubstr("not finite"));
  const std::vector<std::vector<double>> fields{{1, 2}, {1}};
  EXPECT_REFUSED(write_medit_scalars(folder / "m.sol", fields), HasSubstr("cannot share"));
  EXPECT_EQ(folder.file_count(), 0);
  EXPECT_THROW(write_medit_mesh(folder / "no/m.mesh", odd_mesh()), InputError);
  EXPECT_REFUSED(read_medit_mesh(folder / "none.mesh"), HasSubstr("none.mesh"));
}

}  // namespace
}  // namespace mesamis
