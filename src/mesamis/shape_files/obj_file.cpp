// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <map>

#include "mesamis/files/byte_source.h"
#include "mesamis/files/refuse.h"
#include "mesamis/files/text_scan.h"
#include "mesamis/files/text_writer.h"
#include "mesamis/shape_files/object_formats.h"

namespace mesamis::detail::shape_files {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLabelComment = "label";

class ObjParser {
 public:
  ObjParser(const fs::path& file, std::string_view text, MemoryBudget& budget)
      : file_(file), text_(text), budget_(budget) {}

  ParsedObjects parse() {
    for (std::string_view line; next_line(line); ++line_number_) {
      const std::string_view whole = line, keyword = take_word(line);
      if (keyword == "v") add_point(line);
      if (keyword == "f") add_face(line);
      if (keyword == "o") begin_object(trimmed(line));
      if (keyword == "g" && !has_objects_) begin_group(trimmed(line));
      if (keyword == "usemtl") material_ = trimmed(line);
      if (keyword == "mtllib" && materials_file_.empty()) materials_file_ = trimmed(line);
      if (keyword.starts_with('#')) read_comment(whole, line);
    }
    result_.file = {std::move(surface_), frame_};
    return std::move(result_);
  }

  /// What the first mtllib names; empty: nothing.
  const std::string& materials_file() const { return materials_file_; }
  /// The material of each object's first face; empty: none.
  const std::vector<std::string>& materials() const { return materials_; }

 private:
  /// A backslash at the end of a line joins the next one to it.
  bool next_line(std::string_view& line) {
    if (!take_line(text_, line)) return false;
    if (!line.ends_with('\\')) return true;
    joined_.clear();
    for (bool more = true; more;) {
      more = line.ends_with('\\');
      if (more) line.remove_suffix(1);
      joined_ += line;
      if (more) {
        joined_ += ' ';
        ++line_number_;
        more = take_line(text_, line);
      }
    }
    line = joined_;
    return true;
  }

  void read_comment(std::string_view whole, std::string_view rest) {
    if (!frame_) frame_ = frame_named_in(whole);
    if (take_word(rest) == kLabelComment && object_ < 0)
      next_.label = object_label_in(trimmed(rest));
  }

  void begin_object(std::string_view name) {
    has_objects_ = true;
    object_ = -1;
    next_ = {std::string(name), {}, {}};
  }

  /// Faces of a group may stand in several places.
  void begin_group(std::string_view name) {
    const auto found = groups_.find(name);
    object_ = found == groups_.end() ? -1 : found->second;
    next_ = {std::string(name), {}, {}};
  }

  /// An object is one once it has a face.
  Index current_object() {
    if (object_ >= 0) return object_;
    object_ = static_cast<Index>(result_.objects.size());
    // Names are copied for each object, however long they are.
    budget_.claim(3, next_.name.size() + material_.size(), "names of objects");
    budget_.claim(1, sizeof(*groups_.begin()) + kNodeBytes, "groups");
    if (!has_objects_) groups_.emplace(next_.name, object_);
    append_within(budget_, result_.objects, next_, "objects");
    append_within(budget_, materials_, material_, "names of materials");
    return object_;
  }

  [[noreturn]] void refuse_line(const std::string& what) const {
    refuse(file_, message("line ", line_number_, ": ", what));
  }

  void add_point(std::string_view line) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = take_word(line);
      if (!parse_number(word, p[axis])) refuse_line("expected three numbers after v");
    }
    append_within(budget_, surface_.points, p, "points");
    if (surface_.points.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
      refuse_line("the points exceed 32-bit indices");
    }
  }

  void add_face(std::string_view line) {
    Triangle fan{};
    std::size_t corners = 0;
    for (auto word = take_word(line); !word.empty(); word = take_word(line), ++corners) {
      fan[std::min<std::size_t>(corners, 2)] = point_named(word);
      if (corners < 2) continue;
      append_within(budget_, surface_.triangles, fan, "triangles");
      append_within(budget_, result_.object_of, Index{0}, "triangles");
      fan[1] = fan[2];
    }
    if (corners < 3) refuse_line(message("expected a face of at least 3 points, found ", corners));
    const Index object = current_object();
    std::fill(result_.object_of.end() - static_cast<std::ptrdiff_t>(corners - 2),
              result_.object_of.end(), object);
  }

  /// "7", "7/1", "7//3", "7/1/3": counted from 1, or from the last point backwards if negative.
  Index point_named(std::string_view word) const {
    std::int64_t number = 0;
    const auto count = static_cast<std::int64_t>(surface_.points.size());
    if (!parse_number(word.substr(0, word.find('/')), number) || number == 0 || number < -count ||
        number > std::numeric_limits<Index>::max()) {
      refuse_line("expected the number of a point, found " + in_quotes(word));
    }
    return static_cast<Index>(number > 0 ? number - 1 : count + number);
  }

  static constexpr std::size_t kNodeBytes = 64;  // of a map, beside its value

  const fs::path& file_;
  std::string_view text_;
  MemoryBudget& budget_;
  std::string joined_;  // a line in several parts
  std::size_t line_number_ = 1;
  TriMesh surface_;
  std::optional<Frame> frame_;
  ParsedObjects result_;
  bool has_objects_ = false;  // else groups are objects
  ObjectFacts next_;          // of the object that begins with the next face, if there is none
  Index object_ = -1;         // that faces belong to; -1: the next one
  std::map<std::string, Index, std::less<>> groups_;
  std::string material_, materials_file_;
  std::vector<std::string> materials_;
};

/// Only a file in the same folder is read.
std::map<std::string, Colour> colours_beside(const fs::path& file, const std::string& materials,
                                             MemoryBudget& budget) {
  const fs::path path = file.parent_path() / materials;
  std::error_code error;
  if (materials.empty() || fs::path(materials).filename() != materials ||
      !fs::is_regular_file(path, error)) {
    return {};
  }
  return parse_mtl(path, read_all(path, budget), budget);
}

/// @param first  how many points of the file come before those of the surface.
void append_faces(std::string& out, const TriMesh& surface, std::int64_t first) {
  for (const Triangle& t : surface.triangles) {
    out += 'f';
    for (const Index p : t) out += ' ' + std::to_string(first + p + 1);
    out += '\n';
  }
}

void append_points(std::string& out, const TriMesh& surface) {
  for (const Vec3& p : surface.points) {
    out += 'v';
    for (int axis = 0; axis < 3; ++axis) append_shortest(out += ' ', p[axis]);
    out += '\n';
  }
}

}  // namespace

std::string obj_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  std::string out = "# " + frame_note(options.frame) + "\n";
  if (!options.name.empty()) out += "o " + options.name + "\n";
  append_points(out, surface);
  append_faces(out, surface, 0);
  return out;
}

std::string obj_object_bytes(std::span<const NamedSurface> objects,
                             const SurfaceWriteOptions& options, const std::string& materials) {
  std::string out = "# " + frame_note(options.frame) + "\nmtllib " + materials + "\n";
  const std::vector<std::string> material_names = safe_names(objects);
  std::int64_t first = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto& [name, colour, label, surface] = objects[i];
    out += "o " + name + "\n# " + kLabelComment + ' ' + std::to_string(label) + '\n';
    append_points(out, surface);
    out += "usemtl " + material_names[i] + "\n";
    append_faces(out, surface, first);
    first += std::ssize(surface.points);
  }
  return out;
}

SurfaceFile parse_obj(const fs::path& file, std::string_view bytes, MemoryBudget& budget) {
  return ObjParser(file, bytes, budget).parse().file;
}

ParsedObjects parse_obj_objects(const fs::path& file, std::string_view bytes,
                                MemoryBudget& budget) {
  ObjParser parser(file, bytes, budget);
  ParsedObjects result = parser.parse();
  const std::map<std::string, Colour> colours =
      colours_beside(file, parser.materials_file(), budget);
  for (std::size_t i = 0; i < result.objects.size(); ++i) {
    const auto found = colours.find(parser.materials()[i]);
    if (found != colours.end()) result.objects[i].colour = found->second;
  }
  return result;
}

}  // namespace mesamis::detail::shape_files
