// SPDX-License-Identifier: Apache-2.0
// Legacy VTK files, read without VTK: its own reader crashes on damaged ones.
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

struct NamedType {
  const char* name;
  NumberType type;
};
constexpr NamedType kTypes[] = {
    {"char", NumberType::kInt8},          {"unsigned_char", NumberType::kUint8},
    {"short", NumberType::kInt16},        {"unsigned_short", NumberType::kUint16},
    {"int", NumberType::kInt32},          {"unsigned_int", NumberType::kUint32},
    {"long", NumberType::kInt64},         {"unsigned_long", NumberType::kUint64},
    {"vtktypeint64", NumberType::kInt64}, {"vtktypeuint64", NumberType::kUint64},
    {"vtkIdType", NumberType::kInt32},    {"float", NumberType::kFloat32},
    {"double", NumberType::kFloat64}};

class LegacyParser {
 public:
  LegacyParser(const fs::path& file, std::string_view bytes, MemoryBudget& budget)
      : file_(file), rest_(bytes), budget_(budget), sink_(file, surface_, budget) {}

  SurfaceFile parse() {
    read_head();
    for (auto word = take_word(rest_); !word.empty(); word = take_word(rest_)) {
      const std::string keyword = lower(word);
      if (keyword == "points") {
        read_points();
      } else if (keyword == "polygons" || keyword == "triangle_strips") {
        read_cells(keyword == "triangle_strips");
      } else if (keyword == "vertices" || keyword == "lines") {
        Lists unused = read_lists();
        free(unused);
      } else if (keyword == "field") {
        read_field();
      } else if (keyword == "metadata") {
        skip_paragraph();
      } else if (keyword == "point_data" || keyword == "cell_data") {
        break;  // attributes come last
      } else {
        refuse(file_, "expected a section of polygonal data, found " + in_quotes(word));
      }
    }
    return {std::move(surface_), frame_};
  }

 private:
  /// Offsets and corners, or counts and corners in one list: as versions from 5.1 and before.
  struct Lists {
    std::vector<double> offsets, corners;
  };

  void read_head() {
    std::string_view line;
    take_line(rest_, line);
    if (!line.starts_with("# vtk DataFile Version")) refuse(file_, "is not a legacy VTK file");
    std::string_view version = line.substr(line.find("Version") + 7);
    if (!parse_number(take_word(version), version_)) refuse(file_, "expected a version number");
    take_line(rest_, line);  // title
    frame_ = frame_named_in(line);
    const std::string format = lower(take_word(rest_));
    if (format != "ascii" && format != "binary") {
      refuse(file_, "expected ASCII or BINARY, found " + in_quotes(format));
    }
    binary_ = format == "binary";
    const std::string dataset = lower(take_word(rest_)), kind = lower(take_word(rest_));
    if (dataset != "dataset" || kind != "polydata") {
      refuse(file_, "expected DATASET POLYDATA, found " + in_quotes(dataset + " " + kind));
    }
  }

  std::size_t next_count() {
    const std::string_view word = take_word(rest_);
    std::int64_t count = 0;
    // Each item takes a byte at least: more cannot be in the file.
    if (!parse_number(word, count) || count < 0 ||
        static_cast<std::uint64_t>(count) > rest_.size()) {
      refuse(file_, "expected a count that fits the file, found " + in_quotes(word));
    }
    return static_cast<std::size_t>(count);
  }

  NumberType next_type() {
    const std::string name(take_word(rest_));
    const auto* found = std::find_if(std::begin(kTypes), std::end(kTypes),
                                     [&](const NamedType& t) { return name == t.name; });
    if (found == std::end(kTypes)) {
      refuse(file_, "expected a type of numbers, found " + in_quotes(name));
    }
    return found->type;
  }

  /// Text between white space, or big endian from the next line on.
  std::vector<double> next_values(std::size_t count, NumberType type) {
    if (binary_) return next_binary_values(count, type);
    std::vector<double> values = claimed_values(count);
    for (double& value : values) {
      const std::string_view word = take_word(rest_);
      if (!parse_number(word, value)) {
        refuse(file_, word.empty() ? "the file ends before its last value"
                                   : "expected a number, found " + in_quotes(word));
      }
    }
    return values;
  }

  std::vector<double> claimed_values(std::size_t count) {
    budget_.claim(count, sizeof(double), "values");
    return std::vector<double>(count);
  }

  std::vector<double> next_binary_values(std::size_t count, NumberType type) {
    std::string_view line;
    take_line(rest_, line);
    const std::size_t size = byte_size(type);
    if (rest_.size() / size < count) refuse(file_, "the file ends before its last value");
    std::vector<double> values = claimed_values(count);
    for (std::size_t i = 0; i < count; ++i) {
      values[i] = load_number(rest_.data() + i * size, type, ByteOrder::kBig);
    }
    rest_.remove_prefix(count * size);
    return values;
  }

  void read_points() {
    const std::size_t count = next_count();
    std::vector<double> values = next_values(3 * count, next_type());
    free_within(budget_, surface_.points);
    reserve_within(budget_, surface_.points, count, "points");
    for (std::size_t i = 0; i < count; ++i) {
      surface_.points.push_back({values[3 * i], values[3 * i + 1], values[3 * i + 2]});
    }
    free_within(budget_, values);
  }

  Lists read_lists() {
    const std::size_t count = next_count(), size = next_count();
    if (version_ >= 5.1)
      return {next_named_values("offsets", count), next_named_values("connectivity", size)};
    return {{}, next_values(size, NumberType::kInt32)};
  }

  std::vector<double> next_named_values(const char* name, std::size_t count) {
    const std::string found = lower(take_word(rest_));
    if (found != name) refuse(file_, message("expected ", name, ", found ", in_quotes(found)));
    return next_values(count, next_type());
  }

  void read_cells(bool strips) {
    Lists lists = read_lists();
    if (version_ >= 5.1) {
      sink_.add_all(lists.corners, lists.offsets, strips);
      return free(lists);
    }
    const std::span<const double> list(lists.corners);
    for (std::size_t at = 0; at < list.size();) {
      const double count = list[at];
      const auto left = static_cast<double>(list.size() - at - 1);
      if (!(count >= 0 && count <= left)) {
        refuse(file_, message("a polygon of ", count, " corners does not fit its list"));
      }
      sink_.add(list.subspan(at + 1, static_cast<std::size_t>(count)), strips);
      at += 1 + static_cast<std::size_t>(count);
    }
    free(lists);
  }

  void free(Lists& lists) {
    free_within(budget_, lists.offsets);
    free_within(budget_, lists.corners);
  }

  /// FIELD name count, then for each array: name components tuples type, values. All that counts is
  /// a text SPACE.
  void read_field() {
    take_word(rest_);
    const std::size_t arrays = next_count();
    for (std::size_t a = 0; a < arrays; ++a) {
      const bool names_frame = take_word(rest_) == "SPACE";
      const std::size_t components = next_count(), tuples = next_count();
      if (components != 0 && tuples > rest_.size() / components) {
        refuse(file_, "an array of field data does not fit the file");
      }
      if (!binary_ && lower(rest_.substr(0, 7)) == " string") {
        take_word(rest_);
        for (std::size_t i = 0; i < components * tuples; ++i) {
          const std::string_view word = take_word(rest_);
          if (names_frame && !frame_) frame_ = frame_named(word);
        }
      } else {
        std::vector<double> unused = next_values(components * tuples, next_type());
        free_within(budget_, unused);
      }
    }
  }

  /// Up to the next empty line.
  void skip_paragraph() {
    std::string_view line;
    take_line(rest_, line);
    while (take_line(rest_, line) && !trimmed(line).empty()) {
    }
  }

  const fs::path& file_;
  std::string_view rest_;
  MemoryBudget& budget_;
  TriMesh surface_;
  std::optional<Frame> frame_;
  PolygonSink sink_;
  double version_ = 0;
  bool binary_ = false;
};

}  // namespace

SurfaceFile parse_vtk(const fs::path& file, std::string_view bytes, MemoryBudget& budget) {
  return LegacyParser(file, bytes, budget).parse();
}

}  // namespace mesamis::detail::shape_files
