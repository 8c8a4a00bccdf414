// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <random>

#include "mesamis/shape_files/mesh_files.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

struct Example {
  TetMesh mesh = box_mesh({{-1, -2, -3}, {4, 5, 6}}, {3, 2, 2});
  std::vector<MeshArray> point_arrays{{"u", 1, {}}, {"gradient", 3, {}}, {"metric", 6, {}}};
  std::vector<MeshArray> cell_arrays{{"s1", 1, {}}};

  Example() {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    for (MeshArray& array : point_arrays) {
      array.values.resize(mesh.points.size() * static_cast<std::size_t>(array.components));
      for (double& value : array.values) value = normal(random);
    }
    cell_arrays[0].values.resize(mesh.cells.size());
    for (double& value : cell_arrays[0].values) value = normal(random);
  }
  void write(const std::filesystem::path& path, Frame frame = Frame::kLps) const {
    write_vtu(path, mesh, {point_arrays, cell_arrays, frame});
  }
};

void expect_equal(const std::vector<MeshArray>& a, const std::vector<MeshArray>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].components, b[i].components);
    EXPECT_EQ(a[i].values, b[i].values);
  }
}

TEST(Vtu, ReadsBackBitEqualInEitherFrame) {
  const TempFolder folder;
  const Example example;
  for (const Frame frame : {Frame::kLps, Frame::kRas}) {
    example.write(folder / "m.vtu", frame);
    const MeshWithArrays back = read_vtu(folder / "m.vtu");
    EXPECT_EQ(back.mesh.points, example.mesh.points);
    EXPECT_EQ(back.mesh.cells, example.mesh.cells);
    expect_equal(back.point_arrays, example.point_arrays);
    expect_equal(back.cell_arrays, example.cell_arrays);
  }
  EXPECT_EQ(folder.file_count(), 1);
}

/// The same file with its frame's name spoilt, so that the reader leaves coordinates alone.
MeshWithArrays read_as_written(const TempFolder& folder) {
  std::string bytes = read_bytes(folder / "m.vtu");
  const auto at = bytes.find("Name=\"SPACE\"");
  EXPECT_NE(at, std::string::npos);
  write_bytes(folder / "raw.vtu", bytes.replace(at, 12, "Name=\"OTHER\""));
  return read_vtu(folder / "raw.vtu");
}

TEST(Vtu, RasTurnsPointsVectorsAndTensorsByHalfATurn) {
  const TempFolder folder;
  const Example example;
  example.write(folder / "m.vtu", Frame::kRas);
  const MeshWithArrays back = read_as_written(folder);
  const Vec3 p = example.mesh.points[5];
  EXPECT_EQ(back.mesh.points[5], (Vec3{-p.x, -p.y, p.z}));
  const auto cell = static_cast<Index>(back.mesh.cells.size() / 2);
  EXPECT_GT(cell_volume(back.mesh, cell), 0);
  EXPECT_EQ(back.point_arrays[0].values, example.point_arrays[0].values);
  // e'Me does not depend on the frame.
  const auto form = [](const MeshWithArrays& m, const MeshArray& tensor, int a, int b) {
    const double* t = tensor.values.data() + 6 * 7;
    const Vec3 e =
        m.mesh.points[static_cast<std::size_t>(a)] - m.mesh.points[static_cast<std::size_t>(b)];
    return quadratic_form({t[0], t[3], t[5], t[1], t[4], t[2]}, e);
  };
  const MeshWithArrays original{example.mesh, {}, {}};
  EXPECT_NEAR(form(back, back.point_arrays[2], 3, 20),
              form(original, example.point_arrays[2], 3, 20), 1e-12);
  const auto component_along_edge = [](const MeshWithArrays& m, const MeshArray& v) {
    const double* w = v.values.data() + 3 * 4;
    return dot({w[0], w[1], w[2]}, m.mesh.points[20] - m.mesh.points[3]);
  };
  EXPECT_NEAR(component_along_edge(back, back.point_arrays[1]),
              component_along_edge(original, example.point_arrays[1]), 1e-12);
}

TEST(Vtu, IsAppendedRawAndSaysItsUnits) {
  const TempFolder folder;
  Example().write(folder / "m.vtu");
  const std::string bytes = read_bytes(folder / "m.vtu");
  EXPECT_THAT(bytes, HasSubstr("<AppendedData encoding=\"raw\">"));
  EXPECT_THAT(bytes, HasSubstr("LengthUnit"));
}

TEST(Vtu, RefusesArraysThatDoNotFit) {
  const TempFolder folder;
  Example example;
  example.point_arrays[2].values.pop_back();
  EXPECT_REFUSED(example.write(folder / "m.vtu"), HasSubstr("point array 'metric'"));
  for (const int components : {0, -1, 1001}) {
    example = {};
    example.cell_arrays[0].components = components;
    EXPECT_REFUSED(example.write(folder / "m.vtu"), HasSubstr("expected 1 to 1000"));
  }
  EXPECT_EQ(folder.file_count(), 0);
  EXPECT_THROW(Example().write(folder / "none/m.vtu"), InputError);
}

TEST(Vtu, RefusesOtherFilesAndOtherCells) {
  const TempFolder folder;
  EXPECT_REFUSED(read_vtu(folder / "none.vtu"), HasSubstr("none.vtu"));
  write_bytes(folder / "text.vtu", "no mesh at all");
  EXPECT_REFUSED(read_vtu(folder / "text.vtu"), HasSubstr("is not a VTK XML file"));
  const auto one_cell = [&folder](const std::string& type, const std::string& corners) {
    write_bytes(folder / "a.vtu",
                "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid>"
                "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points>"
                "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
                "0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>"
                "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" +
                    corners +
                    "</DataArray>"
                    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray>"
                    "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" +
                    type + "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>");
    return read_vtu(folder / "a.vtu").mesh.cells.size();
  };
  EXPECT_EQ(one_cell("10", "0 1 2 3"), 1u);
  EXPECT_REFUSED(one_cell("9", "0 1 2 3"), HasSubstr("VTK type 9"));
  EXPECT_REFUSED(one_cell("10", "0 1 2 4"), HasSubstr("names a missing point"));
  EXPECT_REFUSED(one_cell("10", "0 1 2 -1"), HasSubstr("names a missing point"));
  EXPECT_REFUSED(one_cell("24", "0 1 2 3"), HasSubstr("cell 0 has not ten points"));
}

TEST(Vtu, RefusesAHeaderThatPromisesTooMuch) {
  const TempFolder folder;
  Example().write(folder / "m.vtu");
  std::string bytes = read_bytes(folder / "m.vtu");
  const auto at = bytes.find("NumberOfPoints=\"") + 16;
  write_bytes(folder / "m.vtu", bytes.insert(at, "9999999"));
  EXPECT_REFUSED(read_vtu(folder / "m.vtu"), HasSubstr("expected 2999999"));
}

/// Half a turn of components that are counted in 64 bits would never end.
TEST(Vtu, AbsurdNumbersOfComponentsAreRefused) {
  const TempFolder folder;
  write_bytes(
      folder / "a.vtu",
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><FieldData>"
      "<Array type=\"String\" Name=\"SPACE\" format=\"ascii\">82 65 83 0</Array></FieldData>"
      "<Piece NumberOfPoints=\"1\" NumberOfCells=\"0\"><CellData>"
      "<DataArray type=\"Float64\" Name=\"s\" NumberOfComponents=\"1099511627776\" "
      "format=\"ascii\"></DataArray></CellData><Points>"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0"
      "</DataArray></Points></Piece></UnstructuredGrid></VTKFile>");
  EXPECT_REFUSED(read_vtu(folder / "a.vtu"), HasSubstr("1 to 1000 components"));
}

TEST(Vtu, DamageIsRefusedOrHarmless) {
  const TempFolder folder;
  Example().write(folder / "m.vtu");
  const std::string bytes = read_bytes(folder / "m.vtu");
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = bytes;
    if (i % 2) {
      damaged.resize(random() % bytes.size());
    } else {
      damaged[random() % bytes.size()] = static_cast<char>(random());
    }
    write_bytes(folder / "bad.vtu", damaged);
    try {
      const MeshWithArrays mesh = read_vtu(folder / "bad.vtu");
      for (const Cell& cell : mesh.mesh.cells) {
        EXPECT_LT(static_cast<std::size_t>(cell[3]), mesh.mesh.points.size());
      }
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
    }
  }
}

}  // namespace
}  // namespace mesamis
