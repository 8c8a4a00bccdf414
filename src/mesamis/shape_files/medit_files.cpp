// SPDX-License-Identifier: Apache-2.0
// The Medit side of mesh_files.h: ASCII .mesh and .sol.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "mesamis/base/error.h"
#include "mesamis/files/byte_source.h"
#include "mesamis/files/memory_budget.h"
#include "mesamis/files/refuse.h"
#include "mesamis/files/text_scan.h"
#include "mesamis/files/text_writer.h"
#include "mesamis/shape_files/mesh_checks.h"
#include "mesamis/shape_files/mesh_files.h"

namespace mesamis {

namespace {

// ---------------------------------------------------------------- writing

constexpr const char* kSolutionHeader = "MeshVersionFormatted 2\n\nDimension 3\n";

void write_section_header(TextWriter& out, const char* section, std::size_t count,
                          std::size_t fields, int type) {
  out << "\n" << section << "\n" << count << "\n" << fields;
  for (std::size_t f = 0; f < fields; ++f) out << " " << type;
  out << "\n";
}

void require_equal_sizes(const std::filesystem::path& path,
                         std::span<const std::vector<double>> fields) {
  for (const auto& field : fields) {
    if (field.size() == fields[0].size()) continue;
    refuse(path, "fields of " + std::to_string(fields[0].size()) + " and " +
                     std::to_string(field.size()) + " values cannot share a file");
  }
}

void write_scalars(TextWriter& out, const char* section,
                   std::span<const std::vector<double>> fields) {
  const std::size_t count = fields.empty() ? 0 : fields[0].size();
  write_section_header(out, section, count, fields.size(), 1);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t f = 0; f < fields.size(); ++f) {
      if (f > 0) out << " ";
      out.number(fields[f][i]);
    }
    out << "\n";
  }
}

// ---------------------------------------------------------------- reading

std::string read_text(const std::filesystem::path& path, MemoryBudget& budget) {
  ByteSource source(path, Packing::kPlain);
  std::string text;
  reserve_within(budget, text, source.most_bytes(), "bytes of the file");
  text.resize(source.most_bytes());
  text.resize(source.read(text.data(), text.size()));
  return text;
}

/// The words of a Medit file, one after the other, comments left out.
class Words {
 public:
  Words(const std::filesystem::path& path, const ReadLimits& limits)
      : budget_(path, limits),
        name_(path.string()),
        text_(read_text(path, budget_)),
        at_(text_.data()) {}

  /// The next word, empty at the end of the file.
  std::string_view next() {
    while (at_ != end() && (is_space(*at_) || *at_ == '#')) {
      at_ = *at_ == '#' ? std::find_if(at_, end(), ends_line) : at_ + 1;
    }
    word_ = at_;
    while (at_ != end() && !is_space(*at_) && *at_ != '#') ++at_;
    return {word_, at_};
  }

  template <class Number>
  Number number(const char* expected) {
    const std::string_view word = next();
    const char* first = word.data();
    const char* last = first + word.size();
    if (first != last && *first == '+') ++first;
    Number value{};
    const auto [stop, error] = std::from_chars(first, last, value);
    if (error != std::errc() || stop != last || first == last || !std::isfinite(value)) {
      refuse(std::string("expected ") + expected + ", found " + quoted(word));
    }
    return value;
  }

  std::size_t count() {
    const auto value = number<std::int64_t>("a count");
    if (value < 0 || value > std::numeric_limits<Index>::max()) {
      refuse("a count of " + std::to_string(value) + " is out of range");
    }
    return static_cast<std::size_t>(value);
  }

  /// Checks that `count` items of `words` words each can follow, before memory is taken for them.
  void require_room(std::size_t count, std::size_t words) const {
    const auto most = static_cast<std::size_t>(end() - at_) / (2 * words);
    if (count <= most) return;
    refuse("expected " + std::to_string(count) + " entries, found room for " +
           std::to_string(most) + " at most");
  }

  /// Room for as many elements, claimed.
  template <class Element>
  void reserve(std::vector<Element>& array, std::size_t count) {
    reserve_within(budget_, array, count, "entries");
  }

  void enter(std::string_view section) { section_ = section; }

  [[noreturn]] void refuse(const std::string& what) const {
    const auto ends = std::count(text_.data(), word_, '\n');
    const auto line = 1 + (ends > 0 ? ends : std::count(text_.data(), word_, '\r'));
    mesamis::refuse(name_ + ":" + std::to_string(line),
                    (section_.empty() ? "" : section_ + ": ") + what);
  }

  static std::string quoted(std::string_view word) {
    return word.empty() ? "the end of the file" : in_quotes(word);
  }

 private:
  const char* end() const { return text_.data() + text_.size(); }
  static bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
  }
  MemoryBudget budget_;
  std::string name_, text_, section_;
  const char* at_;
  const char* word_ = at_;
};

bool is_keyword(std::string_view word) { return !word.empty() && word[0] >= 'A' && word[0] <= 'Z'; }

void read_header(Words& words) {
  if (const auto word = words.next(); word != "MeshVersionFormatted") {
    words.refuse("not a Medit ASCII file: expected MeshVersionFormatted, found " +
                 Words::quoted(word));
  }
  words.enter("MeshVersionFormatted");
  words.number<int>("a version");
}

void read_dimension(Words& words) {
  if (words.number<int>("the dimension") != 3) words.refuse("expected 3");
}

void read_vertices(Words& words, std::vector<Vec3>& points) {
  if (!points.empty()) words.refuse("a second list of vertices");
  const std::size_t count = words.count();
  words.require_room(count, 4);
  words.reserve(points, count);
  points.resize(count);
  for (Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = words.number<double>("a coordinate");
    words.number<std::int64_t>("a reference");
  }
}

/// Indices of the file start with 1; whether they exist is known when all vertices are.
void read_cells(Words& words, std::vector<Cell>& cells) {
  if (!cells.empty()) words.refuse("a second list of tetrahedra");
  const std::size_t count = words.count();
  words.require_room(count, 5);
  words.reserve(cells, count);
  cells.resize(count);
  for (Cell& cell : cells) {
    for (Index& corner : cell) {
      corner = words.number<Index>("a vertex number");
      if (corner < 1) words.refuse("vertex numbers start with 1, found " + std::to_string(corner));
      --corner;
    }
    words.number<std::int64_t>("a reference");
  }
}

void require_complete(const TetMesh& mesh, const std::string& name) {
  if (mesh.points.empty()) refuse(name, "holds no Vertices");
  if (mesh.cells.empty()) refuse(name, "holds no Tetrahedra");
  const auto points = static_cast<Index>(mesh.points.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Index corner = *std::max_element(mesh.cells[c].begin(), mesh.cells[c].end());
    if (corner >= points) {
      refuse(name, "tetrahedron " + std::to_string(c + 1) + " names vertex " +
                       std::to_string(corner + 1) + ", there are " + std::to_string(points));
    }
  }
}

enum class SolutionType { kScalar = 1, kTensor = 3 };

SolutionType read_metric_type(Words& words) {
  if (words.number<int>("the number of fields") != 1) words.refuse("expected one field");
  const int type = words.number<int>("the field's type");
  if (type != 1 && type != 3) {
    words.refuse("expected a scalar (1) or a symmetric tensor (3), found type " +
                 std::to_string(type));
  }
  return static_cast<SolutionType>(type);
}

Sym3 read_tensor(Words& words) {
  Sym3 m;
  for (double* entry : {&m.xx, &m.xy, &m.yy, &m.xz, &m.yz, &m.zz}) {
    *entry = words.number<double>("a tensor's entry");
  }
  return m;
}

Sym3 read_size(Words& words) {
  const auto h = words.number<double>("a size");
  const double m = 1 / (h * h);
  if (!(h > 0) || !std::isfinite(m) || m == 0)
    words.refuse("a size must be positive and not absurd");
  return m * kIdentity3;
}

std::vector<Sym3> read_solution(Words& words) {
  const std::size_t count = words.count();
  const SolutionType type = read_metric_type(words);
  words.require_room(count, type == SolutionType::kTensor ? 6 : 1);
  std::vector<Sym3> metrics;
  words.reserve(metrics, count);
  for (std::size_t i = 0; i < count; ++i) {
    metrics.push_back(type == SolutionType::kTensor ? read_tensor(words) : read_size(words));
  }
  return metrics;
}

}  // namespace

void write_medit_mesh(const OutputPath& path, const TetMesh& mesh, Frame frame,
                      std::span<const Index> references) {
  if (!references.empty() && references.size() != mesh.cells.size()) {
    refuse(path, "expected a reference for each of " + std::to_string(mesh.cells.size()) +
                     " cells, found " + std::to_string(references.size()));
  }
  TextWriter out(path);
  out << "MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n" << mesh.points.size() << "\n";
  for (const Vec3& point : mesh.points) {
    const Vec3 p = in_frame(point, frame);
    for (int axis = 0; axis < 3; ++axis) {
      out.number(p[axis]);
      out << " ";
    }
    out << "0\n";
  }
  out << "\nTetrahedra\n" << mesh.cells.size() << "\n";
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (const Index corner : mesh.cells[c]) out << std::int64_t{corner} + 1 << " ";
    out << (references.empty() ? 0 : references[c]) << "\n";
  }
  out << "\nEnd\n";
  out.commit();
}

TetMesh read_medit_mesh(const std::filesystem::path& path, const ReadLimits& limits) {
  Words words(path, limits);
  read_header(words);
  TetMesh mesh;
  bool dimension = false;
  for (auto word = words.next(); !word.empty() && word != "End"; word = words.next()) {
    if (!is_keyword(word)) continue;  // what a section unknown to us holds
    words.enter(word);
    if (word == "Dimension") {
      read_dimension(words);
      dimension = true;
    } else if (word == "Vertices") {
      if (!dimension) words.refuse("expected Dimension 3 before it");
      read_vertices(words, mesh.points);
    } else if (word == "Tetrahedra") {
      read_cells(words, mesh.cells);
    }
  }
  require_complete(mesh, path.string());
  return mesh;
}

void write_medit_scalars(const OutputPath& path, std::span<const std::vector<double>> fields,
                         std::span<const std::vector<double>> cell_fields) {
  require_equal_sizes(path, fields);
  require_equal_sizes(path, cell_fields);
  TextWriter out(path);
  out << kSolutionHeader;
  write_scalars(out, "SolAtVertices", fields);
  if (!cell_fields.empty()) write_scalars(out, "SolAtTetrahedra", cell_fields);
  out << "\nEnd\n";
  out.commit();
}

void write_medit_metric(const OutputPath& path, std::span<const Sym3> metrics) {
  TextWriter out(path);
  out << kSolutionHeader;
  write_section_header(out, "SolAtVertices", metrics.size(), 1, 3);
  for (const Sym3& m : metrics) {
    for (const double entry : {m.xx, m.xy, m.yy, m.xz, m.yz}) {
      out.number(entry);
      out << " ";
    }
    out.number(m.zz);
    out << "\n";
  }
  out << "\nEnd\n";
  out.commit();
}

std::vector<Sym3> read_medit_metric(const std::filesystem::path& path, const ReadLimits& limits) {
  Words words(path, limits);
  read_header(words);
  for (auto word = words.next(); !word.empty() && word != "End"; word = words.next()) {
    if (!is_keyword(word)) continue;
    words.enter(word);
    if (word == "Dimension") read_dimension(words);
    if (word == "SolAtVertices") return read_solution(words);
  }
  refuse(path.string(), "holds no SolAtVertices");
}

}  // namespace mesamis
