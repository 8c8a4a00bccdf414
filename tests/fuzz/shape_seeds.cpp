// SPDX-License-Identifier: Apache-2.0
#include "fuzz_seeds.h"
#include "mesamis/mesh/metric.h"
#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "support/scan_bytes.h"
#include "support/shapes.h"
#include "support/zip_bytes.h"

namespace mesamis {
namespace {

TriMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

const std::vector<NamedSurface> kObjects{{"pelvis", {255, 128, 0}, 1, tetrahedron()},
                                         {"femur", {0, 128, 255}, 3, cube({2, 0, 0}, 1)}};

/// Text and other orders that our writers do not write.
void write_by_hand(const SeedFolder& seeds) {
  seeds.add("stl", "text",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
            "endloop\nendfacet\nendsolid a\n");
  const std::string elements =
      "comment SPACE=LPS\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property double z\nproperty float distance\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  seeds.add(
      "ply", "text",
      "ply\nformat ascii 1.0\n" + elements + "0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1 0 4\n4 0 1 2 3\n");
  std::string big = "ply\nformat binary_big_endian 1.0\n" + elements;
  for (const double c : {0.0, 1.0, 2.0, 3.0}) {
    big += bytes_of(static_cast<float>(c), true) + bytes_of(static_cast<float>(c * c), true) +
           bytes_of(c, true) + bytes_of(1.0f, true);
  }
  big += '\3';
  for (const std::int32_t i : {0, 1, 2}) big += bytes_of(i, true);
  seeds.add("ply", "bigendian", big);
  const std::string shape =
      "mtllib shape.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0 1\nv 1 1 0\no a\nusemtl m\n"
      "f 1/1/1 2//2 4 3\ng b\nf -1 -2 -3\n";
  seeds.add("obj", "materials", shape + '\0' + "newmtl m\nKd 1 0.5 0\n");
  seeds.add("mtl", "colours", "newmtl a\nKa 0 0 0\nKd 1 0.5 0.25\nd 1\nnewmtl b\nKd xyz 1 0 0\n");
  const std::string title = "# vtk DataFile Version 3.0\nSPACE=RAS\n";
  seeds.add("vtk", "text",
            title +
                "ASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n"
                "POLYGONS 1 5\n4 0 1 2 3\nTRIANGLE_STRIPS 1 4\n3 0 1 2\nPOINT_DATA 4\n"
                "SCALARS a float 1\nLOOKUP_TABLE default\n1 2 3 4\n");
  std::string binary = title + "BINARY\nDATASET POLYDATA\nPOINTS 3 double\n";
  for (const double c : {0., 0., 0., 1., 0., 0., 0., 1., 0.}) binary += bytes_of(c, true);
  binary += "\nPOLYGONS 1 4\n";
  for (const std::int32_t i : {3, 0, 1, 2}) binary += bytes_of(i, true);
  seeds.add("vtk", "binary", binary + "\n");
}

const std::string kModel =
    "<?xml version=\"1.0\"?><model unit=\"millimeter\" xmlns=\"http://schemas.microsoft.com/"
    "3dmanufacturing/core/2015/02\" "
    "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/"
    "2015/02\"><metadata name=\"Title\">SPACE=LPS</metadata><resources><basematerials id=\"5\">"
    "<base name=\"b\" displaycolor=\"#FF8000\"/></basematerials><object id=\"1\" type=\"model\" "
    "pid=\"5\" pindex=\"0\" partnumber=\"3\" name=\"a\"><mesh><vertices><vertex x=\"0\" y=\"0\" "
    "z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices>"
    "<triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh></object><object id=\"2\">"
    "<components><component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"/></components>"
    "</object></resources><build><item objectid=\"2\"/><item objectid=\"1\"/></build></model>";

/// A grid of VTK with its arrays as text, which mutations keep readable.
std::string xml_grid(const std::string& type, const std::string& attributes,
                     const std::string& cells) {
  const std::string array = "<DataArray format=\"ascii\" type=";
  return "<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"LittleEndian\"><" + type +
         "><Piece NumberOfPoints=\"4\" " + attributes + "><PointData>" + array +
         "\"Float32\" Name=\"distance\">1 2 3 4</DataArray></PointData><Points>" + array +
         "\"Float64\" NumberOfComponents=\"3\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>" +
         cells + "</Piece></" + type + "></VTKFile>\n";
}

void write_xml(const SeedFolder& seeds) {
  const std::string array = "<DataArray format=\"ascii\" type=\"Int32\" Name=";
  seeds.add("vtp", "text",
            xml_grid("PolyData", "NumberOfPolys=\"2\"",
                     "<Polys>" + array + "\"connectivity\">0 1 2 0 2 3</DataArray>" + array +
                         "\"offsets\">3 6</DataArray></Polys><CellData>" + array +
                         "\"label\">1 2</DataArray></CellData>"));
  seeds.add("vtu", "text",
            xml_grid("UnstructuredGrid", "NumberOfCells=\"1\"",
                     "<Cells>" + array + "\"connectivity\">0 1 2 3</DataArray>" + array +
                         "\"offsets\">4</DataArray>" + array + "\"types\">10</DataArray></Cells>"));
  write_surface(seeds.file("encapsulated", "stl.dcm"), tetrahedron(), {.name = "hip"});
  write_surface(seeds.file("encapsulated", "obj.obj.dcm"), tetrahedron(), {.name = "hip"});
  seeds.add("threemf_parts", "pair",
            "<model xmlns:p=\"p\"><resources><object id=\"2\"><components><component "
            "p:path=\"/3D/a.model\" objectid=\"1\"/></components></object></resources><build>"
            "<item objectid=\"2\"/><item p:path=\"/3D/a.model\" objectid=\"1\"/></build></model>" +
                std::string(1, '\0') + kModel);
  seeds.add("threemf_model", "components", kModel);
  seeds.add("threemf", "stored",
            zip_bytes({{"_rels/.rels",
                        "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/"
                        "relationships\"><Relationship Id=\"r\" Target=\"/3D/3dmodel.model\" "
                        "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>"
                        "</Relationships>"},
                       {"3D/3dmodel.model", kModel}},
                      false));
}

void write_meshes(const SeedFolder& seeds) {
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}};
  const std::vector<MeshArray> points{{"u", 1, {0, 1, 2, 3}}}, cells{{"m", 3, {1, 2, 3}}};
  write_vtu(seeds.file("vtu", "appended"), mesh, {points, cells});
  write_medit_mesh(seeds.file("mesh", "tetrahedron"), mesh);
  write_medit_metric(seeds.file("sol", "metric"), std::vector<Sym3>(4, Sym3{1, 2, 3, 0, 0, 0}));
  const std::vector<std::vector<double>> fields{{1, 2, 3, 4}};
  write_medit_scalars(seeds.file("sol", "scalar"), fields);
}

}  // namespace

void write_shape_seeds(const SeedFolder& seeds) {
  // Writers decide by the extension, which belongs to the name.
  const SurfaceWriteOptions options{.name = "seed", .grey = {0, 80, 160, 255}};
  for (const std::string extension : {"stl", "ply", "obj", "vtp", "amf"}) {
    write_surface(seeds.file(extension, "one." + extension), tetrahedron(), options);
  }
  SurfaceWriteOptions arrays{.frame = Frame::kRas};
  arrays.point_arrays = {{"distance", {1, 2, 3, 4}}};
  write_surface(seeds.file("ply", "arrays.ply"), tetrahedron(), arrays);
  write_surface(seeds.file("vtp", "arrays.vtp"), tetrahedron(), arrays);
  for (const std::string extension : {"vtp", "obj", "amf"}) {
    write_objects(seeds.file(extension, "several." + extension), kObjects);
  }
  write_surface(seeds.file("threemf", "one.3mf"), tetrahedron(), options);
  write_objects(seeds.file("threemf", "several.3mf"), kObjects);
  write_by_hand(seeds);
  write_xml(seeds);
  write_meshes(seeds);
}

}  // namespace mesamis
