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

}  // namespace

std::string vtp_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  const VtkMessages messages;
  const auto data = vtk_surface(surface);
  add_text(*data->GetFieldData(), "SPACE", options.frame == Frame::kRas ? "RAS" : "LPS");
  add_text(*data->GetFieldData(), "LengthUnit", "mm");
  if (!options.name.empty()) add_text(*data->GetFieldData(), "Name", options.name);
  if (!options.grey.empty()) {
    add_array(*data->GetPointData(), {"grey", 1, options.grey}, surface.points.size(), "point");
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

TriMesh parse_vtp(const fs::path& file, std::string_view bytes) {
  const VtkXml xml(file, bytes, "PolyData");
  TriMesh surface;
  for (const XmlElement& piece : xml.data_set().children) {
    if (piece.name != "Piece") continue;
    PolygonSink sink(file, surface);
    add_points(file, xml, piece, surface);
    add_cells(file, xml, piece, "Polys", sink);
    add_cells(file, xml, piece, "Strips", sink);
  }
  return surface;
}

}  // namespace mesamis::detail
