// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>

#include "mesamis/files/number_type.h"
#include "mesamis/files/refuse.h"
#include "mesamis/files/text_scan.h"
#include "mesamis/shape_files/polygons.h"
#include "mesamis/shape_files/surface_formats.h"

namespace mesamis::detail::shape_files {
namespace {

namespace fs = std::filesystem;

struct Property {
  std::string name;
  NumberType type = NumberType::kFloat32;
  bool is_list = false;
  NumberType count_type = NumberType::kUint8;  // of a list
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

enum class Format { kText, kLittle, kBig };

struct Header {
  Format format = Format::kText;
  std::vector<Element> elements;
  std::optional<Frame> frame;
};

struct NamedType {
  std::string_view name, other_name;
  NumberType type;
};
constexpr NamedType kTypes[] = {
    {"char", "int8", NumberType::kInt8},        {"uchar", "uint8", NumberType::kUint8},
    {"short", "int16", NumberType::kInt16},     {"ushort", "uint16", NumberType::kUint16},
    {"int", "int32", NumberType::kInt32},       {"uint", "uint32", NumberType::kUint32},
    {"float", "float32", NumberType::kFloat32}, {"double", "float64", NumberType::kFloat64}};

NumberType type_named(const fs::path& file, std::string_view name) {
  for (const NamedType& t : kTypes) {
    if (name == t.name || name == t.other_name) return t.type;
  }
  refuse(file, "expected the type of a property, found " + in_quotes(name));
}

void read_format(const fs::path& file, std::string_view line, Header& header) {
  const std::string_view name = take_word(line);
  if (name == "ascii") {
    header.format = Format::kText;
  } else if (name == "binary_little_endian") {
    header.format = Format::kLittle;
  } else if (name == "binary_big_endian") {
    header.format = Format::kBig;
  } else {
    refuse(file, "expected format ascii, binary_little_endian or binary_big_endian, found " +
                     in_quotes(name));
  }
}

void read_element(const fs::path& file, std::string_view line, Header& header) {
  Element element;
  element.name = take_word(line);
  if (!parse_number(take_word(line), element.count) || element.count < 0) {
    refuse(file, "expected a count after element " + in_quotes(element.name));
  }
  header.elements.push_back(std::move(element));
}

void read_property(const fs::path& file, std::string_view line, Header& header) {
  if (header.elements.empty()) refuse(file, "a property comes before the first element");
  Property property;
  std::string_view word = take_word(line);
  property.is_list = word == "list";
  if (property.is_list) {
    property.count_type = type_named(file, take_word(line));
    word = take_word(line);
  }
  property.type = type_named(file, word);
  property.name = take_word(line);
  header.elements.back().properties.push_back(std::move(property));
}

/// Takes the header off the front of the bytes.
Header take_header(const fs::path& file, std::string_view& bytes) {
  Header header;
  std::string_view line, whole = bytes;
  if (!take_line(bytes, line) || trimmed(line) != "ply") {
    refuse(file, "is not a PLY file: the first line is not ply");
  }
  const bool old_mac = whole[bytes.data() - whole.data() - 1] == '\r';
  for (whole = bytes; take_line(bytes, line); whole = bytes) {
    const std::size_t end = line.size();
    const std::string_view keyword = take_word(line);
    if (keyword == "end_header") {
      // Values may begin with a byte that looks like the rest of a line's end.
      if (old_mac) bytes = whole.substr(std::min(end + 1, whole.size()));
      return header;
    }
    if (keyword == "format") read_format(file, line, header);
    if (keyword == "element") read_element(file, line, header);
    if (keyword == "property") read_property(file, line, header);
    if (keyword == "comment" && !header.frame) header.frame = frame_named_in(line);
  }
  refuse(file, "the header has no end");
}

/// The values after the header, one after another.
class Values {
 public:
  Values(const fs::path& file, std::string_view bytes, Format format)
      : file_(file), bytes_(bytes), format_(format) {}

  double next(NumberType type) {
    if (format_ == Format::kText) return next_word();
    const std::size_t size = byte_size(type);
    if (bytes_.size() < size) refuse(file_, "the file ends before its last value");
    const double value = load_number(
        bytes_.data(), type, format_ == Format::kBig ? ByteOrder::kBig : ByteOrder::kLittle);
    bytes_.remove_prefix(size);
    return value;
  }

  /// The entries of a list that follow. No list can be longer than the bytes that are left.
  std::size_t next_count(NumberType type) {
    const double count = next(type);
    if (!(count >= 0 && count <= static_cast<double>(bytes_.size()))) {
      refuse(file_, message("a list of ", count, " entries does not fit into the file"));
    }
    return static_cast<std::size_t>(count);
  }

 private:
  double next_word() {
    const std::string_view word = take_word(bytes_);
    double value = 0;
    if (word.empty()) refuse(file_, "the file ends before its last value");
    if (!parse_number(word, value)) refuse(file_, "expected a number, found " + in_quotes(word));
    return value;
  }

  const fs::path& file_;
  std::string_view bytes_;
  Format format_;
};

void skip(Values& values, const Property& property) {
  const std::size_t count = property.is_list ? values.next_count(property.count_type) : 1;
  for (std::size_t i = 0; i < count; ++i) values.next(property.type);
}

Vec3 read_point(Values& values, const Element& element) {
  Vec3 p;
  for (const Property& property : element.properties) {
    const int axis = property.name == "x" ? 0 : property.name == "y" ? 1 : 2;
    if (property.is_list || property.name.size() != 1 || property.name[0] != "xyz"[axis]) {
      skip(values, property);
    } else {
      p[axis] = values.next(property.type);
    }
  }
  return p;
}

bool names_corners(const Property& p) {
  return p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index");
}

/// What the reading of faces needs beside the values.
struct FaceReader {
  PolygonSink& sink;
  MemoryBudget& budget;
  std::vector<double> corners{};  ///< of the last face, kept for its room

  void read(Values& values, const Element& element);
};

void FaceReader::read(Values& values, const Element& element) {
  for (const Property& property : element.properties) {
    if (!names_corners(property)) {
      skip(values, property);
      continue;
    }
    const std::size_t count = values.next_count(property.count_type);
    reserve_within(budget, corners, count, "corners of a face");
    corners.resize(count);
    for (double& corner : corners) corner = values.next(property.type);
    sink.add(corners, false);
  }
}

/// One property of every vertex.
std::vector<double> read_array(const fs::path& file, Values& values, const Element& element,
                               const std::string& name, MemoryBudget& budget) {
  const auto is_wanted = [&name](const Property& p) { return !p.is_list && p.name == name; };
  if (std::none_of(element.properties.begin(), element.properties.end(), is_wanted)) {
    std::string known;
    for (const Property& p : element.properties) known += (known.empty() ? "" : ", ") + p.name;
    refuse(file, "has no array " + in_quotes(name) + " to colour by; there is " +
                     (known.empty() ? "none" : known));
  }
  std::vector<double> array;
  for (std::int64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      if (!is_wanted(property)) {
        skip(values, property);
      } else {
        append_within(budget, array, values.next(property.type), "values");
      }
    }
  }
  return array;
}

bool has_coordinates(const Element& element) {
  int found = 0;
  for (const Property& p : element.properties) {
    found += !p.is_list && (p.name == "x" || p.name == "y" || p.name == "z");
  }
  return found == 3;
}

}  // namespace

std::string ply_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment " + frame_note(options.frame);
  if (!options.name.empty()) out += "\ncomment " + options.name;
  out += message("\nelement vertex ", surface.points.size(), "\nproperty double x",
                 "\nproperty double y", "\nproperty double z");
  for (const PointArray& array : options.point_arrays) out += "\nproperty double " + array.name;
  out += message("\nelement face ", surface.triangles.size(),
                 "\nproperty list uchar int vertex_indices\nend_header\n");
  const std::size_t bytes_per_point = 8 * (3 + options.point_arrays.size());
  out.reserve(out.size() + bytes_per_point * surface.points.size() + 13 * surface.triangles.size());
  for (std::size_t n = 0; n < surface.points.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis) append(out, surface.points[n][axis] + 0.0);  // no -0
    for (const PointArray& array : options.point_arrays) append(out, array.values[n]);
  }
  for (const Triangle& t : surface.triangles) {
    append(out, std::uint8_t{3});
    for (const Index p : t) append(out, p);
  }
  return out;
}

SurfaceFile parse_ply(const fs::path& file, std::string_view bytes, MemoryBudget& budget) {
  const Header header = take_header(file, bytes);
  Values values(file, bytes, header.format);
  TriMesh surface;
  PolygonSink sink(file, surface, budget);
  FaceReader faces{sink, budget};
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;  // nothing to read, however many
    if (element.name == "vertex" && !has_coordinates(element)) {
      refuse(file, "expected the properties x, y and z of the element vertex");
    }
    for (std::int64_t i = 0; i < element.count; ++i) {
      if (element.name == "vertex") {
        append_within(budget, surface.points, read_point(values, element), "points");
      } else if (element.name == "face") {
        faces.read(values, element);
      } else {
        for (const Property& property : element.properties) skip(values, property);
      }
    }
  }
  return {std::move(surface), header.frame};
}

std::vector<double> parse_ply_array(const fs::path& file, std::string_view bytes,
                                    const std::string& name, MemoryBudget& budget) {
  const Header header = take_header(file, bytes);
  Values values(file, bytes, header.format);
  for (const Element& element : header.elements) {
    if (element.name == "vertex") return read_array(file, values, element, name, budget);
    for (std::int64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      for (const Property& property : element.properties) skip(values, property);
    }
  }
  refuse(file, "has no element vertex");
}

}  // namespace mesamis::detail::shape_files
