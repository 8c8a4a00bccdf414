// SPDX-License-Identifier: Apache-2.0
// Small files that claim much memory: each is refused within the limit, and read where there is
// enough.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "mesamis/files/bytes.h"
#include "mesamis/shape_files/file_kind.h"
#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/object_files.h"
#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/test_data.h"
#include "support/throws.h"
#include "support/zip_bytes.h"

namespace mesamis {
namespace {
using testing::AllOf;
using testing::HasSubstr;

constexpr std::size_t kMany = 400'000;

std::string repeated(const std::string& text, std::size_t times) {
  std::string out;
  out.reserve(text.size() * times);
  for (std::size_t i = 0; i < times; ++i) out += text;
  return out;
}

/// Binary STL of equal triangles; the header counts some of them.
std::string stl(std::uint32_t counted, std::size_t there) {
  std::string bytes(80, '\0');
  append(bytes, counted);
  std::string record(50, '\0');
  const float one = 1;
  for (const std::size_t at : {24u, 40u}) {  // x of the second corner, y of the third
    std::string number;
    append(number, one);
    record.replace(at, 4, number);
  }
  return bytes + repeated(record, there);
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// 3MF: objects that each hold the one before several times, as the resources of a model.
std::string threemf_model(std::size_t triangles, int levels, int copies) {
  std::string text =
      "<model unit=\"millimeter\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/"
      "2015/02\"><resources><object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/>"
      "<vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles>" +
      repeated("<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>", triangles) +
      "</triangles></mesh></object>";
  for (int level = 1; level <= levels; ++level) {
    const std::string inner = std::to_string(level), own = std::to_string(level + 1);
    text += "<object id=\"" + own + "\"><components>" +
            repeated("<component objectid=\"" + inner + "\"/>", static_cast<std::size_t>(copies)) +
            "</components></object>";
  }
  return text + "</resources><build><item objectid=\"" + std::to_string(levels + 1) +
         "\"/></build></model>";
}

std::string threemf(const std::string& model) {
  return zip_bytes(
      {{"_rels/.rels",
        "<Relationships><Relationship Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/"
        "3dmodel\" Target=\"/3D/3dmodel.model\" Id=\"r\"/></Relationships>"},
       {"3D/3dmodel.model", model}});
}

struct Bomb {
  const char* name;
  std::function<std::string()> bytes;
  double too_little_gb, enough_gb;
};

/// Each has some hundred kilobytes at most.
const Bomb kBombs[] = {
    {"points.stl.gz", [] { return packed(stl(kMany, kMany)); }, 0.03, 0.2},
    {"polygon.obj.gz",
     [] { return packed(kTriangle + "f 1 2 3" + repeated(" 1", 5 * kMany) + "\n"); }, 0.03, 0.3},
    {"points.obj.gz",
     [] { return packed(kTriangle + "f 1 2 3\n" + repeated("v 0 0 0\n", 3 * kMany)); }, 0.05, 0.2},
    {"names.obj.gz",
     [] {
       return packed(kTriangle + "usemtl " + std::string(100'000, 'a') + "\n" +
                     repeated("o\nf 1 2 3\n", 500));
     },
     0.05, 0.3},
    {"list.ply.gz",
     [] {
       std::string bytes =
           "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
           "property float y\nproperty float z\nelement face 1\n"
           "property list uint uchar vertex_indices\nend_header\n" +
           std::string(36, '\0');
       append(bytes, static_cast<std::uint32_t>(5 * kMany));
       return packed(bytes + std::string(5 * kMany, '\0'));
     },
     0.03, 0.3},
    {"points.amf.gz",
     [] {
       const std::string vertex =
           "<vertex><coordinates><x>0</x><y>0</y><z>0</z></coordinates></vertex>";
       return packed("<amf><object id=\"0\"><mesh><vertices>" + repeated(vertex, 100'000) +
                     "</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle>"
                     "</volume></mesh></object></amf>");
     },
     0.008, 0.1},
    {"tree.vtp.gz",
     [] {
       return packed("<VTKFile type=\"PolyData\"><PolyData>" + repeated("<a b=\"1\"/>", 100'000) +
                     "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points><DataArray "
                     "type=\"Float32\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points>"
                     "<Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2"
                     "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3"
                     "</DataArray></Polys></Piece></PolyData></VTKFile>");
     },
     0.03, 0.2},
    {"list.vtk.gz",
     [] {
       return packed(
           "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
           "0 0 0 1 0 0 0 1 0\nPOLYGONS 1 " +
           std::to_string(2 * kMany + 1) + "\n" + std::to_string(2 * kMany) +
           repeated(" 0", 2 * kMany) + "\n");
     },
     0.01, 0.1},
    {"model.3mf", [] { return threemf(threemf_model(kMany, 0, 0)); }, 0.012, 0.2},
    {"copies.3mf", [] { return threemf(threemf_model(9'000, 2, 10)); }, 0.01, 0.1},
};

TEST(HostileSurfaces, AreRefusedBeforeTheyTakeMoreThanIsAllowed) {
  const TempFolder folder;
  for (const Bomb& bomb : kBombs) {
    SCOPED_TRACE(bomb.name);
    const auto file = folder / bomb.name;
    write_bytes(file, bomb.bytes());
    EXPECT_LT(std::filesystem::file_size(file), 600'000u);
    const ReadLimits little{bomb.too_little_gb}, enough{bomb.enough_gb};
    EXPECT_REFUSED(read_surface(file, little), AllOf(HasSubstr(bomb.name), HasSubstr("memory")));
    EXPECT_REFUSED(read_objects(file, little), AllOf(HasSubstr(bomb.name), HasSubstr("memory")));
    EXPECT_FALSE(read_surface(file, enough).triangles.empty());
  }
}

/// What lies behind the triangles that the header counts is not even unpacked, but for one more.
TEST(HostileSurfaces, AnStlIsUnpackedAsFarAsItsHeaderJustifies) {
  const TempFolder folder;
  std::string bytes = stl(10, kMany);
  write_bytes(folder / "a.stl.gz", packed(bytes));
  EXPECT_REFUSED(read_surface(folder / "a.stl.gz", {1e-4}), HasSubstr("but more follow"));
  bytes.replace(84 + 10 * 50, 50, 50, '\0');
  write_bytes(folder / "a.stl.gz", packed(bytes));
  EXPECT_EQ(read_surface(folder / "a.stl.gz", {1e-4}).triangles.size(), 10u);
}

/// Copies are counted before they are made: 2^30 of them, and 2^64.
TEST(HostileSurfaces, ComponentsOfComponentsAreCountedBeforeTheyAreMade) {
  const TempFolder folder;
  for (const int levels : {30, 31}) {
    write_bytes(folder / "a.3mf", threemf(threemf_model(4, levels, 4)));
    EXPECT_REFUSED(read_surface(folder / "a.3mf"), HasSubstr("too many components"));
  }
  write_bytes(folder / "b.3mf", threemf(threemf_model(20'000, 2, 100)));
  EXPECT_REFUSED(read_surface(folder / "b.3mf"), HasSubstr("points and triangles in all"));
}

/// A count that is 0 in 32 bits, and arrays that share one packed block.
TEST(HostileSurfaces, MeshesWhoseCountsOrArraysClaimTooMuchAreRefused) {
  const TempFolder folder;
  const auto vtu = [](const std::string& data) {
    return "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"1\" "
           "NumberOfCells=\"0\"><PointData>" +
           data +
           "</PointData><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
           "format=\"ascii\">0 0 0</DataArray></Points></Piece></UnstructuredGrid></VTKFile>";
  };
  for (const char* count : {"4294967296", "1099511627776", "18446744073709551616", "-1", "0"}) {
    write_bytes(folder / "a.vtu",
                vtu("<DataArray type=\"Float64\" Name=\"s\" NumberOfComponents=\"" +
                    std::string(count) + "\" format=\"ascii\"></DataArray>"));
    EXPECT_REFUSED(read_mesh(folder / "a.vtu"), HasSubstr("a.vtu: expected")) << count;
  }
  std::string big =
      vtu(repeated("<DataArray type=\"UInt8\" format=\"ascii\">0</DataArray>", 50'000));
  write_bytes(folder / "b.vtu", big);
  EXPECT_REFUSED(read_mesh(folder / "b.vtu", {0.01}), HasSubstr("b.vtu: memory"));
  write_bytes(folder / "c.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n" +
                                     std::to_string(kMany) + "\n" + repeated("0 0 0 0\n", kMany));
  EXPECT_REFUSED(read_mesh(folder / "c.mesh", {0.005}), HasSubstr("c.mesh: memory"));
  EXPECT_REFUSED(read_medit_metric(folder / "c.mesh", {0.003}), HasSubstr("memory"));
}

/// Files that took gigabytes, hung or ended the program.
TEST(HostileSurfaces, FilesThatBrokeReadersAreRefusedWithinAHundredMegabytes) {
  const auto folder = test_data("data/bad/bombs");
  MESAMIS_REQUIRE_DATA(folder);
  constexpr ReadLimits kLimits{0.1};
  for (const char* name : {"compbig.3mf", "laugh.3mf", "laugh.amf", "laugh.vtp"}) {
    EXPECT_REFUSED(read_surface(folder / name, kLimits), HasSubstr(name));
  }
  for (const char* name : {"hang.vtu", "share.vtu", "laugh.vtu"}) {
    EXPECT_REFUSED(read_mesh(folder / name, kLimits), HasSubstr(name));
  }
}

}  // namespace
}  // namespace mesamis
