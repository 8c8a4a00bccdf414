// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mesamis/files/refuse.h"
#include "mesamis/shape_files/object_formats.h"
#include "mesamis/shape_files/polygons.h"
#include "mesamis/shape_files/surface_formats.h"
#include "mesamis/shape_files/vtk_xml.h"
#include "mesamis/shape_files/vtp_names.h"

namespace mesamis::detail::shape_files {
namespace {

namespace fs = std::filesystem;

constexpr Index kMost = std::numeric_limits<Index>::max();

const XmlElement* named_child(const XmlElement* parent, std::string_view name) {
  if (parent == nullptr) return nullptr;
  const auto found = std::find_if(parent->children.begin(), parent->children.end(),
                                  [name](const auto& e) { return e.attribute("Name") == name; });
  return found == parent->children.end() ? nullptr : &*found;
}

/// At most as many as 32-bit indices number.
std::size_t bounded_count(const fs::path& file, const XmlElement& piece, const std::string& what) {
  const std::size_t count = count_in(file, piece, "NumberOf" + what);
  if (count <= kMost) return count;
  refuse(file, message("expected at most ", kMost, " ", lower(what), ", found ", count));
}

/// The texts and the numbers of the field data.
class Fields {
 public:
  Fields(const fs::path& file, VtkXml& xml)
      : file_(file), xml_(xml), element_(xml.data_set().child("FieldData")) {}

  std::string text(const char* name) {
    const XmlElement* array = named_child(element_, name);
    return array == nullptr ? std::string() : xml_.text(*array);
  }

  std::map<Index, std::string> names_of_labels() {
    const XmlElement* texts = named_child(element_, kNamesField);
    const XmlElement* numbers = named_child(element_, kLabelsField);
    std::map<Index, std::string> names;
    if (texts == nullptr || numbers == nullptr) return names;
    const std::vector<std::string> found = xml_.texts(*texts);
    const std::vector<double> labels = xml_.values(*numbers, found.size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (!is_label(labels[i]))
        refuse(file_, message("expected labels of objects, found ", labels[i]));
      names[static_cast<Index>(labels[i])] = found[i];
    }
    return names;
  }

  static bool is_label(double value) {
    return value >= 0 && value <= kMost && value == std::floor(value);
  }

 private:
  const fs::path& file_;
  VtkXml& xml_;
  const XmlElement* element_;
};

class VtpParser {
 public:
  VtpParser(const fs::path& file, std::string_view bytes, MemoryBudget& budget)
      : file_(file), budget_(budget), xml_(file, bytes, "PolyData", budget), fields_(file_, xml_) {}

  SurfaceFile parse_surface() {
    for (const XmlElement& piece : xml_.data_set().children) {
      if (piece.name == "Piece") add_piece(piece);
    }
    return {std::move(surface_), stated_frame()};
  }

  ParsedObjects parse_objects() {
    for (const XmlElement& piece : xml_.data_set().children) {
      if (piece.name != "Piece") continue;
      add_piece(piece);
      add_objects(piece);
    }
    const std::map<Index, std::string> names = fields_.names_of_labels();
    for (ObjectFacts& object : result_.objects) {
      const auto found = names.find(object.label.value_or(-1));
      if (found != names.end()) object.name = found->second;
    }
    if (result_.objects.size() == 1 && result_.objects[0].name.empty()) {
      result_.objects[0].name = fields_.text(kNameField);
    }
    result_.file = {std::move(surface_), stated_frame()};
    return std::move(result_);
  }

 private:
  std::optional<Frame> stated_frame() { return frame_named(fields_.text(kFrameField)); }

  void add_piece(const XmlElement& piece) {
    PolygonSink sink(file_, surface_, budget_);
    add_points(piece);
    cell_of_.clear();
    first_cell_ = bounded_count(file_, piece, "Verts") + bounded_count(file_, piece, "Lines");
    for (const std::string kind : {"Polys", "Strips"}) add_cells(piece, kind, sink);
  }

  void add_points(const XmlElement& piece) {
    const std::size_t count = bounded_count(file_, piece, "Points");
    if (count == 0) return;
    const XmlElement* points = piece.child("Points");
    const XmlElement* array = points == nullptr ? nullptr : points->child("DataArray");
    if (array == nullptr) refuse(file_, "expected an array of points, found none");
    std::vector<double> values = xml_.values(*array, 3 * count);
    reserve_within(budget_, surface_.points, surface_.points.size() + count, "points");
    for (std::size_t i = 0; i < count; ++i) {
      surface_.points.push_back({values[3 * i], values[3 * i + 1], values[3 * i + 2]});
    }
    free_within(budget_, values);
  }

  const XmlElement& cell_array(const XmlElement& cells, const char* name) const {
    const XmlElement* array = named_child(&cells, name);
    if (array != nullptr) return *array;
    refuse(file_, message("expected an array ", name, " in ", cells.name, ", found none"));
  }

  void add_cells(const XmlElement& piece, const std::string& kind, PolygonSink& sink) {
    const std::size_t count = bounded_count(file_, piece, kind);
    if (count == 0) return;
    const XmlElement* cells = piece.child(kind);
    if (cells == nullptr)
      refuse(file_, message("expected ", count, " cells, found no list of them"));
    const std::vector<double> ends = xml_.values(cell_array(*cells, "offsets"), count);
    const double corners = ends.back();
    if (!(corners >= 0 && corners <= kMost)) {
      refuse(file_, message("expected at most ", kMost, " corners in ", kind, ", found ", corners));
    }
    std::vector<double> connectivity =
        xml_.values(cell_array(*cells, "connectivity"), static_cast<std::size_t>(corners));
    std::vector<double> offsets;
    reserve_within(budget_, offsets, count + 1, "offsets");
    offsets.push_back(0);
    offsets.insert(offsets.end(), ends.begin(), ends.end());
    sink.add_all(connectivity, offsets, kind == "Strips");
    budget_.give_back(ends.size() * sizeof(double));
    free_within(budget_, connectivity);
    for (std::size_t i = 0; i < count; ++i) {  // as many triangles as the sink makes
      const double triangles = std::max(0.0, offsets[i + 1] - offsets[i] - 2);
      const std::size_t size = cell_of_.size() + static_cast<std::size_t>(triangles);
      if (size > cell_of_.capacity()) {
        reserve_within(budget_, cell_of_, std::max(size, 2 * cell_of_.size()), "cells");
      }
      cell_of_.resize(size, first_cell_ + i);
    }
    free_within(budget_, offsets);
    first_cell_ += count;
  }

  /// The values of a cell array of a piece that has been added; none if there is no such array.
  std::vector<double> cell_values(const XmlElement& piece, const char* name,
                                  std::size_t components) {
    const XmlElement* array = named_child(piece.child("CellData"), name);
    if (array == nullptr || components_in(file_, *array) != components) return {};
    return xml_.values(*array, first_cell_ * components);
  }

  std::vector<double> labels_of_cells(const XmlElement& piece) {
    std::vector<double> labels = cell_values(piece, kLabelArray, 1);
    if (!std::all_of(labels.begin(), labels.end(), Fields::is_label)) labels.clear();
    return labels;
  }

  std::vector<double> colours_of_cells(const XmlElement& piece) {
    const XmlElement* array = named_child(piece.child("CellData"), kColourArray);
    if (array == nullptr || array->attribute("type") != "UInt8") return {};
    return cell_values(piece, kColourArray, 3);
  }

  /// To which object each triangle of a piece that has been added belongs.
  void add_objects(const XmlElement& piece) {
    if (cell_of_.empty()) return;
    std::vector<double> labels = labels_of_cells(piece), colours = colours_of_cells(piece);
    for (const std::size_t cell : cell_of_) {
      const Index label = labels.empty() ? -1 : static_cast<Index>(labels[cell]);
      const auto next = static_cast<Index>(result_.objects.size());
      const auto [found, is_new] = object_of_label_.try_emplace(label, next);
      if (is_new) {
        append_within(budget_, result_.objects, facts_of(label, cell, colours), "objects");
      }
      append_within(budget_, result_.object_of, found->second, "triangles");
    }
    free_within(budget_, labels);
    free_within(budget_, colours);
  }

  static ObjectFacts facts_of(Index label, std::size_t cell, const std::vector<double>& colours) {
    ObjectFacts facts;
    if (label >= 0) facts.label = label;
    if (!colours.empty()) {
      const auto channel = [&](std::size_t c) {
        return static_cast<std::uint8_t>(colours[3 * cell + c]);
      };
      facts.colour = {channel(0), channel(1), channel(2)};
    }
    return facts;
  }

  const fs::path& file_;
  MemoryBudget& budget_;
  VtkXml xml_;
  Fields fields_;
  TriMesh surface_;
  ParsedObjects result_;
  std::map<Index, Index> object_of_label_;  // -1: cells without a label
  std::vector<std::size_t> cell_of_;        // the cells of the last piece's triangles
  std::size_t first_cell_ = 0;              // of those that are added next
};

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

}  // namespace

SurfaceFile parse_vtp(const fs::path& file, std::string_view bytes, MemoryBudget& budget) {
  return VtpParser(file, bytes, budget).parse_surface();
}

ParsedObjects parse_vtp_objects(const fs::path& file, std::string_view bytes,
                                MemoryBudget& budget) {
  return VtpParser(file, bytes, budget).parse_objects();
}

std::vector<double> parse_vtp_array(const fs::path& file, std::string_view bytes,
                                    const std::string& name, MemoryBudget& budget) {
  VtkXml xml(file, bytes, "PolyData", budget);
  const XmlElement& piece = only_piece(file, xml);
  const XmlElement* data = piece.child("PointData");
  const std::vector<XmlElement> none;
  std::string known;
  for (const XmlElement& array : data == nullptr ? none : data->children) {
    if (!has_one_component(file, array)) continue;
    const std::string found = array.attribute("Name");
    if (found != name) {
      known += (known.empty() ? "" : ", ") + shown(found);
      continue;
    }
    return xml.values(array, count_in(file, piece, "NumberOfPoints"));
  }
  refuse(file,
         message("has no array ", in_quotes(name), " of one component to colour by, there is ",
                 known.empty() ? "none" : known));
}

}  // namespace mesamis::detail::shape_files
