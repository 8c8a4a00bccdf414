// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include "mesamis/files/refuse.h"
#include "mesamis/files/text_writer.h"
#include "mesamis/files/xml.h"
#include "mesamis/files/xml_text.h"
#include "mesamis/shape_files/object_formats.h"
#include "mesamis/shape_files/polygons.h"

namespace mesamis::detail::shape_files {
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

constexpr const char* kChannels[] = {"r", "g", "b"};

/// Values of 0 to 255 as an AMF colour, from 0 to 1 per channel.
void append_color(std::string& out, const std::array<double, 3>& values) {
  out += "<color>";
  for (std::size_t c = 0; c < 3; ++c) {
    append_number(out, kChannels[c], std::clamp(values[c] / 255, 0.0, 1.0));
  }
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
  if (child == nullptr)
    refuse(file, message("expected <", name, "> in <", parent.name, ">, found none"));
  return *child;
}

double number_in(const fs::path& file, const XmlElement& parent, const char* name) {
  const std::string_view text = trimmed(child_of(file, parent, name).text);
  double value = 0;
  if (!parse_number(text, value)) {
    refuse(file, message("expected a number in <", name, ">, found ", in_quotes(text)));
  }
  return value;
}

/// Gathers points and triangles as their elements end; the tree keeps neither.
class AmfReader {
 public:
  AmfReader(const fs::path& file, MemoryBudget& budget) : file_(file), budget_(budget) {
    sink_.emplace(file_, surface(), budget_);
  }

  /// @return  whether the tree can do without the element.
  bool consume(const XmlElement& element, std::string_view path) {
    if (path == "amf/object/mesh/vertices/vertex") {
      add_vertex(element);
    } else if (path == "amf/object/mesh/volume/triangle") {
      add_triangle(element);
    } else if (path == "amf/object/mesh/vertices") {
      has_vertices_ = true;
    } else if (path == "amf/object/mesh") {
      end_mesh();
    } else if (path == "amf/object") {
      end_object(element);
    } else if (path == "amf/object/metadata" && element.attribute("type") == "name") {
      facts_.name = trimmed(element.text);
    } else if (path == "amf/object/color") {
      facts_.colour = colour_in(element);
    } else {
      return !is_part_of_item(path) && path != "amf/metadata";
    }
    return true;
  }

  ParsedObjects result() { return std::move(result_); }

 private:
  TriMesh& surface() { return result_.file.surface; }

  /// Whether the element belongs to a vertex or a triangle that has not ended.
  static bool is_part_of_item(std::string_view path) {
    return path.starts_with("amf/object/mesh/vertices/vertex/") ||
           path.starts_with("amf/object/mesh/volume/triangle/") ||
           path.starts_with("amf/object/color/");
  }

  void add_vertex(const XmlElement& vertex) {
    const XmlElement& at = child_of(file_, vertex, "coordinates");
    const Vec3 point{number_in(file_, at, "x"), number_in(file_, at, "y"),
                     number_in(file_, at, "z")};
    append_within(budget_, surface().points, point, "points");
  }

  void add_triangle(const XmlElement& triangle) {
    const double corners[] = {number_in(file_, triangle, "v1"), number_in(file_, triangle, "v2"),
                              number_in(file_, triangle, "v3")};
    sink_->add(corners, false);
  }

  void end_mesh() {
    if (!has_vertices_) refuse(file_, "expected <vertices> in <mesh>, found none");
    has_vertices_ = false;
    sink_.emplace(file_, surface(), budget_);
  }

  /// None where a channel is no number: AMF allows formulas.
  static std::optional<Colour> colour_in(const XmlElement& color) {
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c) {
      const XmlElement* channel = color.child(kChannels[c]);
      double share = 0;
      if (channel == nullptr || !parse_number(trimmed(channel->text), share)) return std::nullopt;
      colour[c] = channel_of(share);
    }
    return colour;
  }

  void end_object(const XmlElement& object) {
    facts_.label = object_label_in(object.attribute("id"));
    const auto number = static_cast<Index>(result_.objects.size());
    budget_.claim(1, facts_.name.size(), "names of objects");
    append_within(budget_, result_.objects, std::exchange(facts_, {}), "objects");
    reserve_within(budget_, result_.object_of, surface().triangles.capacity(), "triangles");
    result_.object_of.resize(surface().triangles.size(), number);
  }

  const fs::path& file_;
  MemoryBudget& budget_;
  ParsedObjects result_;
  ObjectFacts facts_;                // of the object that is read
  std::optional<PolygonSink> sink_;  // of the mesh that is read
  bool has_vertices_ = false;
};

}  // namespace

namespace {

std::string header(const SurfaceWriteOptions& options) {
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<amf unit=\"millimeter\" version=\"1.1\">\n";
  append_metadata(out, "description", frame_note(options.frame));
  for (const auto& [type, text] : options.metadata) append_metadata(out, type, text);
  return out;
}

void begin_object(std::string& out, Index id, const std::string& name) {
  out += "<object id=\"" + std::to_string(id) + "\">\n";
  if (!name.empty()) append_metadata(out, "name", name);
}

/// @param grey  one value per point, or none.
void end_object(std::string& out, const TriMesh& surface, const std::vector<double>& grey) {
  out += "<mesh>\n<vertices>\n";
  for (std::size_t n = 0; n < surface.points.size(); ++n) {
    out += "<vertex><coordinates>";
    append_number(out, "x", surface.points[n].x);
    append_number(out, "y", surface.points[n].y);
    append_number(out, "z", surface.points[n].z);
    out += "</coordinates>";
    if (!grey.empty()) append_color(out, {grey[n], grey[n], grey[n]});
    out += "</vertex>\n";
  }
  out += "</vertices>\n<volume>\n";
  for (const Triangle& t : surface.triangles) {
    out += "<triangle><v1>" + std::to_string(t[0]) + "</v1><v2>" + std::to_string(t[1]) +
           "</v2><v3>" + std::to_string(t[2]) + "</v3></triangle>\n";
  }
  out += "</volume>\n</mesh>\n</object>\n";
}

}  // namespace

std::string amf_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  std::string out = header(options);
  begin_object(out, 0, options.name);
  end_object(out, surface, options.grey);
  return out += "</amf>\n";
}

std::string amf_object_bytes(std::span<const NamedSurface> objects,
                             const SurfaceWriteOptions& options) {
  std::string out = header(options);
  if (!options.name.empty()) append_metadata(out, "name", options.name);
  for (const auto& [name, colour, label, surface] : objects) {
    begin_object(out, label, name);
    append_color(out, {double(colour[0]), double(colour[1]), double(colour[2])});
    end_object(out += '\n', surface, {});
  }
  return out += "</amf>\n";
}

ParsedObjects parse_amf_objects(const fs::path& file, std::string_view bytes,
                                MemoryBudget& budget) {
  AmfReader reader(file, budget);
  const auto consume = [&](const XmlElement& e, std::string_view path) {
    return reader.consume(e, path);
  };
  const XmlElement root = parse_xml(file, bytes, budget, {.consume = consume}).root;
  if (root.name != "amf") refuse(file, "expected <amf>, found " + in_quotes(root.name));
  const double unit = unit_in_mm(file, root.attribute("unit"));
  ParsedObjects result = reader.result();
  for (Vec3& p : result.file.surface.points) p = unit * p;
  for (const XmlElement& metadata : root.children) {
    if (!result.file.frame) result.file.frame = frame_named_in(metadata.text);
  }
  return result;
}

SurfaceFile parse_amf(const fs::path& file, std::string_view bytes, MemoryBudget& budget) {
  return parse_amf_objects(file, bytes, budget).file;
}

}  // namespace mesamis::detail::shape_files
