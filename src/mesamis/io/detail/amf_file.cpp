// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "mesamis/io/detail/polygons.h"
#include "mesamis/io/detail/refuse.h"
#include "mesamis/io/detail/surface_formats.h"
#include "mesamis/io/detail/xml.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

void append_number(std::string& out, const char* tag, double value) {
  ((out += '<') += tag) += '>';
  append_shortest(out, value);
  ((out += "</") += tag) += '>';
}

void append_metadata(std::string& out, const std::string& type, const std::string& text) {
  out += "<metadata type=\"" + xml_escaped(type) + "\">" + xml_escaped(text) + "</metadata>\n";
}

/// A grey value of 0 to 255 as an AMF colour, from 0 to 1 per channel.
void append_color(std::string& out, double grey) {
  const double share = std::clamp(grey / 255, 0.0, 1.0);
  out += "<color>";
  for (const char* channel : {"r", "g", "b"}) append_number(out, channel, share);
  out += "</color>";
}

/// Millimetres per unit, as the root of the file names it.
double unit_in_mm(const fs::path& file, const std::string& name) {
  constexpr std::pair<const char*, double> kUnits[] = {{"", 1},         {"millimeter", 1},
                                                       {"inch", 25.4},  {"feet", 304.8},
                                                       {"meter", 1000}, {"micron", 1e-3}};
  for (const auto& [unit, mm] : kUnits) {
    if (name == unit) return mm;
  }
  refuse(file, "expected a unit of AMF, found " + in_quotes(name));
}

const XmlElement& child_of(const fs::path& file, const XmlElement& parent, const char* name) {
  const XmlElement* child = parent.child(name);
  if (child == nullptr) refuse(file, say("expected <", name, "> in <", parent.name, ">"));
  return *child;
}

double number_in(const fs::path& file, const XmlElement& parent, const char* name) {
  const std::string_view text = trimmed(child_of(file, parent, name).text);
  double value = 0;
  if (!parse_number(text, value)) {
    refuse(file, say("expected a number in <", name, ">, found ", in_quotes(text)));
  }
  return value;
}

void add_mesh(const fs::path& file, const XmlElement& mesh, double unit, TriMesh& surface) {
  PolygonSink sink(file, surface);
  for (const XmlElement& vertex : child_of(file, mesh, "vertices").children) {
    if (vertex.name != "vertex") continue;
    const XmlElement& at = child_of(file, vertex, "coordinates");
    surface.points.push_back({unit * number_in(file, at, "x"), unit * number_in(file, at, "y"),
                              unit * number_in(file, at, "z")});
  }
  for (const XmlElement& volume : mesh.children) {
    if (volume.name != "volume") continue;
    for (const XmlElement& triangle : volume.children) {
      if (triangle.name != "triangle") continue;
      const double corners[] = {number_in(file, triangle, "v1"), number_in(file, triangle, "v2"),
                                number_in(file, triangle, "v3")};
      sink.add(corners, false);
    }
  }
}

}  // namespace

SurfaceFile parse_amf(const fs::path& file, std::string_view bytes) {
  const XmlElement root = parse_xml(file, bytes);
  if (root.name != "amf") refuse(file, "expected <amf>, found " + in_quotes(root.name));
  const double unit = unit_in_mm(file, root.attribute("unit"));
  SurfaceFile result;
  for (const XmlElement& object : root.children) {
    if (object.name == "metadata" && !result.frame) result.frame = frame_named_in(object.text);
    if (object.name != "object") continue;
    for (const XmlElement& mesh : object.children) {
      if (mesh.name == "mesh") add_mesh(file, mesh, unit, result.surface);
    }
  }
  return result;
}

std::string amf_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<amf unit=\"millimeter\" version=\"1.1\">\n";
  append_metadata(out, "description", frame_note(options.frame));
  for (const auto& [type, text] : options.metadata) append_metadata(out, type, text);
  out += "<object id=\"0\">\n";
  if (!options.name.empty()) append_metadata(out, "name", options.name);
  out += "<mesh>\n<vertices>\n";
  for (std::size_t n = 0; n < surface.points.size(); ++n) {
    out += "<vertex><coordinates>";
    append_number(out, "x", surface.points[n].x);
    append_number(out, "y", surface.points[n].y);
    append_number(out, "z", surface.points[n].z);
    out += "</coordinates>";
    if (!options.grey.empty()) append_color(out, options.grey[n]);
    out += "</vertex>\n";
  }
  out += "</vertices>\n<volume>\n";
  for (const Triangle& t : surface.triangles) {
    out += "<triangle><v1>" + std::to_string(t[0]) + "</v1><v2>" + std::to_string(t[1]) +
           "</v2><v3>" + std::to_string(t[2]) + "</v3></triangle>\n";
  }
  return out += "</volume>\n</mesh>\n</object>\n</amf>\n";
}

}  // namespace mesamis::detail
