// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "mesamis/files/refuse.h"
#include "mesamis/files/text_scan.h"
#include "mesamis/shape_files/surface_formats.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

class ObjParser {
 public:
  ObjParser(const fs::path& file, std::string_view text) : file_(file), text_(text) {}

  SurfaceFile parse() {
    for (std::string_view line; take_line(text_, line); ++line_number_) {
      const std::string_view whole = line, keyword = take_word(line);
      if (keyword == "v") add_point(line);
      if (keyword == "f") add_face(line);
      if (keyword.starts_with('#') && !frame_) frame_ = frame_named_in(whole);
    }
    return {std::move(surface_), frame_};
  }

 private:
  [[noreturn]] void refuse_line(const std::string& what) const {
    refuse(file_, say("line ", line_number_, ": ", what));
  }

  void add_point(std::string_view line) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = take_word(line);
      if (!parse_number(word, p[axis])) refuse_line("expected three numbers after v");
    }
    surface_.points.push_back(p);
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
      surface_.triangles.push_back(fan);
      fan[1] = fan[2];
    }
    if (corners < 3) refuse_line(say("expected a face of at least 3 points, found ", corners));
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

  const fs::path& file_;
  std::string_view text_;
  std::size_t line_number_ = 1;
  TriMesh surface_;
  std::optional<Frame> frame_;
};

}  // namespace

std::string obj_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  std::string out = "# " + frame_note(options.frame) + "\n";
  if (!options.name.empty()) out += "o " + options.name + "\n";
  for (const Vec3& p : surface.points) {
    out += 'v';
    for (int axis = 0; axis < 3; ++axis) append_shortest(out += ' ', p[axis]);
    out += '\n';
  }
  for (const Triangle& t : surface.triangles) {
    out += 'f';
    for (const Index p : t) out += ' ' + std::to_string(std::int64_t{p} + 1);
    out += '\n';
  }
  return out;
}

SurfaceFile parse_obj(const fs::path& file, std::string_view bytes) {
  return ObjParser(file, bytes).parse();
}

}  // namespace mesamis::detail
