// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"
#include "mesamis/shape_files/polygons.h"
#include "mesamis/shape_files/surface_formats.h"
#include "mesamis/shape_files/vtk_xml.h"
#include "mesamis/shape_files/vtk_xml_writer.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFrameField = "SPACE";
constexpr auto kMostPoints = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());

void add_points(const fs::path& file, VtkXml& xml, const XmlElement& piece, TriMesh& surface) {
  const std::size_t count = count_in(file, piece, "NumberOfPoints");
  if (count == 0) return;
  const XmlElement* points = piece.child("Points");
  const XmlElement* array = points == nullptr ? nullptr : points->child("DataArray");
  if (array == nullptr) refuse(file, "expected an array of points, found none");
  if (count > kMostPoints) {
    refuse(file, say("expected at most ", kMostPoints, " points, found ", count));
  }
  const std::vector<double> values = xml.values(*array, 3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    surface.points.push_back({values[3 * i], values[3 * i + 1], values[3 * i + 2]});
  }
}

/// The array of cells by its name.
const XmlElement& named_array(const fs::path& file, const XmlElement& cells, const char* name) {
  for (const XmlElement& array : cells.children) {
    if (array.attribute("Name") == name) return array;
  }
  refuse(file, say("expected an array ", name, " in ", cells.name, ", found none"));
}

/// The polygons or strips of a piece.
void add_cells(const fs::path& file, VtkXml& xml, const XmlElement* cells, std::size_t count,
               PolygonSink& sink) {
  if (count == 0) return;
  if (cells == nullptr) refuse(file, say("expected ", count, " cells, found no list of them"));
  std::vector<double> offsets = xml.values(named_array(file, *cells, "offsets"), count);
  const double corners = offsets.back();
  if (!(corners >= 0 && corners <= static_cast<double>(kMostPoints))) {
    refuse(file,
           say("expected at most ", kMostPoints, " corners in ", cells->name, ", found ", corners));
  }
  const std::vector<double> connectivity =
      xml.values(named_array(file, *cells, "connectivity"), static_cast<std::size_t>(corners));
  offsets.insert(offsets.begin(), 0);
  sink.add_all(connectivity, offsets, cells->name == "Strips");
}

std::optional<Frame> stated_frame(VtkXml& xml) {
  const XmlElement* fields = xml.data_set().child("FieldData");
  if (fields == nullptr) return std::nullopt;
  for (const XmlElement& array : fields->children) {
    if (array.attribute("Name") == kFrameField) return frame_named(xml.text(array));
  }
  return std::nullopt;
}

/// The only piece of a file.
const XmlElement& only_piece(const fs::path& file, const VtkXml& xml) {
  const XmlElement* piece = nullptr;
  for (const XmlElement& child : xml.data_set().children) {
    if (child.name != "Piece") continue;
    if (piece != nullptr) refuse(file, "expected one piece to colour, found several");
    piece = &child;
  }
  if (piece == nullptr) refuse(file, "holds no points");
  return *piece;
}

bool has_one_component(const fs::path& file, const XmlElement& array) {
  return array.name == "DataArray" && components_in(file, array) == 1;
}

VtkArray array_of(std::string name, const std::vector<double>& values) {
  return vtk_array<double>(std::move(name), 1, values.size(),
                           [&values](std::size_t i) { return values[i]; });
}

std::vector<VtkArray> field_data(const SurfaceWriteOptions& options) {
  std::vector<VtkArray> fields;
  if (options.frame) fields.push_back(vtk_text(kFrameField, frame_name(*options.frame)));
  fields.push_back(vtk_text("LengthUnit", "mm"));
  if (!options.name.empty()) fields.push_back(vtk_text("Name", options.name));
  return fields;
}

VtkArrayGroup point_data(const SurfaceWriteOptions& options) {
  VtkArrayGroup group{"PointData", {}};
  if (!options.grey.empty()) group.arrays.push_back(array_of("grey", options.grey));
  for (const auto& [name, values] : options.point_arrays) {
    group.arrays.push_back(array_of(name, values));
  }
  return group;
}

VtkArrayGroup no_cells(const char* element) {
  constexpr auto kNothing = [](std::size_t) { return 0; };
  return {element,
          {vtk_array<std::int64_t>("connectivity", 1, 0, kNothing),
           vtk_array<std::int64_t>("offsets", 1, 0, kNothing)}};
}

VtkArrayGroup triangle_cells(const std::vector<Triangle>& triangles) {
  if (triangles.size() > std::numeric_limits<std::int32_t>::max() / 3) {
    throw InputError(say("mesh: ", triangles.size(), " cells are too many for a VTK file"));
  }
  auto corner = [&triangles](std::size_t i) { return triangles[i / 3][i % 3]; };
  auto end_of_triangle = [](std::size_t t) { return 3 * (t + 1); };
  return {"Polys",
          {vtk_array<std::int32_t>("connectivity", 1, 3 * triangles.size(), corner),
           vtk_array<std::int32_t>("offsets", 1, triangles.size(), end_of_triangle)}};
}

}  // namespace

std::string vtp_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  const std::vector<Vec3>& points = surface.points;
  auto coordinate = [&points](std::size_t i) { return points[i / 3][static_cast<int>(i % 3)]; };
  return vtk_xml_bytes(
      {"PolyData",
       field_data(options),
       {{"NumberOfPoints", points.size()},
        {"NumberOfVerts", 0},
        {"NumberOfLines", 0},
        {"NumberOfStrips", 0},
        {"NumberOfPolys", surface.triangles.size()}},
       {point_data(options),
        {"CellData", {}},
        {"Points", {vtk_array<double>("Points", 3, 3 * points.size(), coordinate)}},
        no_cells("Verts"),
        no_cells("Lines"),
        no_cells("Strips"),
        triangle_cells(surface.triangles)}});
}

SurfaceFile parse_vtp(const fs::path& file, std::string_view bytes) {
  VtkXml xml(file, bytes, "PolyData");
  TriMesh surface;
  for (const XmlElement& piece : xml.data_set().children) {
    if (piece.name != "Piece") continue;
    PolygonSink sink(file, surface);
    add_points(file, xml, piece, surface);
    for (const std::string kind : {"Polys", "Strips"}) {
      add_cells(file, xml, piece.child(kind), count_in(file, piece, "NumberOf" + kind), sink);
    }
  }
  return {std::move(surface), stated_frame(xml)};
}

std::vector<double> parse_vtp_array(const fs::path& file, std::string_view bytes,
                                    const std::string& name) {
  VtkXml xml(file, bytes, "PolyData");
  const XmlElement& piece = only_piece(file, xml);
  const XmlElement* data = piece.child("PointData");
  std::string known;
  for (const XmlElement& array : data == nullptr ? std::vector<XmlElement>{} : data->children) {
    if (!has_one_component(file, array)) continue;
    const std::string found = array.attribute("Name");
    if (found != name) {
      known += (known.empty() ? "" : ", ") + shown(found);
      continue;
    }
    return xml.values(array, count_in(file, piece, "NumberOfPoints"));
  }
  refuse(file, say("has no array ", in_quotes(name), " of one component to colour by, there is ",
                   known.empty() ? "none" : known));
}

}  // namespace mesamis::detail
