// SPDX-License-Identifier: Apache-2.0
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkXMLPolyDataWriter.h>

#include "mesamis/base/error.h"
#include "mesamis/io/detail/polygons.h"
#include "mesamis/io/detail/refuse.h"
#include "mesamis/io/detail/surface_formats.h"
#include "mesamis/io/detail/vtk_data.h"
#include "mesamis/io/detail/vtk_messages.h"
#include "mesamis/io/detail/vtk_xml.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFrameField = "SPACE";

void add_points(const fs::path& file, const VtkXml& xml, const XmlElement& piece,
                TriMesh& surface) {
  const std::size_t count = count_in(file, piece, "NumberOfPoints");
  if (count == 0) return;
  const XmlElement* points = piece.child("Points");
  const XmlElement* array = points == nullptr ? nullptr : points->child("DataArray");
  if (array == nullptr) refuse(file, "expected an array of points, found none");
  const std::vector<double> values = xml.values(*array);
  if (values.size() % 3 != 0 || values.size() / 3 != count) {
    refuse(file, say("expected ", count, " points, found ", values.size(), " coordinates"));
  }
  for (std::size_t i = 0; i < count; ++i) {
    surface.points.push_back({values[3 * i], values[3 * i + 1], values[3 * i + 2]});
  }
}

/// The polygons or strips of a piece whose points begin at first_point.
void add_cells(const fs::path& file, const VtkXml& xml, const XmlElement& piece,
               const std::string& kind, PolygonSink& sink) {
  const std::size_t count = count_in(file, piece, "NumberOf" + kind);
  if (count == 0) return;
  std::vector<double> connectivity, offsets;
  if (const XmlElement* cells = piece.child(kind)) {
    for (const XmlElement& array : cells->children) {
      if (array.attribute("Name") == "connectivity") connectivity = xml.values(array);
      if (array.attribute("Name") == "offsets") offsets = xml.values(array);
    }
  }
  if (offsets.size() != count) {
    refuse(file, say("expected ", count, " offsets in ", kind, ", found ", offsets.size()));
  }
  offsets.insert(offsets.begin(), 0);
  sink.add_all(connectivity, offsets, kind == "Strips");
}

std::optional<Frame> stated_frame(const VtkXml& xml) {
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

bool has_one_component(const XmlElement& array) {
  const std::string components = array.attribute("NumberOfComponents");
  return array.name == "DataArray" && (components.empty() || components == "1");
}

}  // namespace

std::string vtp_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  const VtkMessages messages;
  const auto data = vtk_surface(surface);
  if (options.frame) add_text(*data->GetFieldData(), kFrameField, frame_name(*options.frame));
  add_text(*data->GetFieldData(), "LengthUnit", "mm");
  if (!options.name.empty()) add_text(*data->GetFieldData(), "Name", options.name);
  if (!options.grey.empty()) {
    add_array(*data->GetPointData(), {"grey", 1, options.grey}, surface.points.size(), "point");
  }
  for (const PointArray& array : options.point_arrays) {
    add_array(*data->GetPointData(), {array.name, 1, array.values}, surface.points.size(), "point");
  }
  const auto writer = vtkSmartPointer<vtkXMLPolyDataWriter>::New();
  writer->WriteToOutputStringOn();
  writer->SetInputData(data);
  set_form(*writer);
  if (writer->Write() == 0 || writer->GetErrorCode() != 0) {
    throw InputError("surface: VTK could not format it: " + messages.first_error());
  }
  return writer->GetOutputString();
}

SurfaceFile parse_vtp(const fs::path& file, std::string_view bytes) {
  const VtkXml xml(file, bytes, "PolyData");
  TriMesh surface;
  for (const XmlElement& piece : xml.data_set().children) {
    if (piece.name != "Piece") continue;
    PolygonSink sink(file, surface);
    add_points(file, xml, piece, surface);
    add_cells(file, xml, piece, "Polys", sink);
    add_cells(file, xml, piece, "Strips", sink);
  }
  return {std::move(surface), stated_frame(xml)};
}

std::vector<double> parse_vtp_array(const fs::path& file, std::string_view bytes,
                                    const std::string& name) {
  const VtkXml xml(file, bytes, "PolyData");
  const XmlElement& piece = only_piece(file, xml);
  const XmlElement* data = piece.child("PointData");
  std::string known;
  for (const XmlElement& array : data == nullptr ? std::vector<XmlElement>{} : data->children) {
    if (!has_one_component(array)) continue;
    const std::string found = array.attribute("Name");
    if (found != name) {
      known += (known.empty() ? "" : ", ") + shown(found);
      continue;
    }
    std::vector<double> values = xml.values(array);
    const std::size_t points = count_in(file, piece, "NumberOfPoints");
    if (values.size() == points) return values;
    refuse(file, say("the array ", in_quotes(name), " has ", values.size(), " values, expected ",
                     points));
  }
  refuse(file, say("has no array ", in_quotes(name), " of one component to colour by, there is ",
                   known.empty() ? "none" : known));
}

}  // namespace mesamis::detail
