// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mesamis/files/length_unit.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/text_header.h"

namespace mesamis::detail::volume_files {
namespace {

struct NrrdHeader {
  std::filesystem::path file;
  HeaderFields fields, keys;
  std::vector<std::string> listed;  // data files, behind "data file: LIST"
  std::uint64_t size = 0;           // bytes up to the attached data

  bool has(const std::string& name) const { return fields.count(name) > 0; }
  const std::string& need(const std::string& name) const {
    const auto field = fields.find(name);
    if (field == fields.end()) {
      refuse(file,
             message("expected the field ", in_quotes(name), " in the NRRD header, found none"));
    }
    return field->second;
  }
  std::string or_else(const std::string& name, const std::string& fallback) const {
    const auto field = fields.find(name);
    return field == fields.end() ? fallback : field->second;
  }
};

/// In keys and values of the user "\\n" stands for a line end, "\\\\" for a backslash.
std::string unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const bool escape = text[n] == '\\' && n + 1 < text.size();
    if (escape) ++n;
    plain += escape && text[n] == 'n' ? '\n' : text[n];
  }
  return plain;
}

// "field: value", or "key:=value" of the user.
void parse_line(NrrdHeader& header, const std::string& line) {
  if (line.starts_with('#')) return;
  const auto colon = line.find(": ");
  const auto key = line.find(":=");
  if (key != std::string::npos && (colon == std::string::npos || key < colon)) {
    header.keys.emplace(unescaped(std::string_view(line).substr(0, key)),
                        unescaped(std::string_view(line).substr(key + 2)));
    return;
  }
  const auto end = colon != std::string::npos ? colon : line.find(':');
  if (end == std::string::npos) {
    refuse(header.file,
           message("expected \"field: value\" in the NRRD header, found ", in_quotes(line)));
  }
  std::string name = lower(trimmed(std::string_view(line).substr(0, end)));
  // The standard's other spellings.
  if (name == "datafile") name = "data file";
  if (name == "lineskip") name = "line skip";
  if (name == "byteskip") name = "byte skip";
  if (name == "axismins") name = "axis mins";
  if (name == "axismaxs") name = "axis maxs";
  header.fields.emplace(name, std::string(trimmed(std::string_view(line).substr(end + 1))));
}

NrrdHeader read_header(const std::filesystem::path& file) {
  NrrdHeader header{file, {}, {}, {}, 0};
  HeaderLines lines(file);
  std::string line;
  if (!lines.next(line) || !line.starts_with("NRRD000") || line.size() != 8) {
    refuse(file, message("expected the NRRD magic NRRD000x, found ", in_quotes(line)));
  }
  bool lists = false;
  while (lines.next(line) && !line.empty()) {
    lists ? header.listed.push_back(std::string(trimmed(line))) : parse_line(header, line);
    lists = header.or_else("data file", "").starts_with("LIST");
  }
  header.size = lines.position();
  return header;
}

NumberType sample_type(const NrrdHeader& header) {
  static const std::map<std::string, NumberType> kTypes{
      {"signed char", NumberType::kInt8},
      {"int8", NumberType::kInt8},
      {"int8_t", NumberType::kInt8},
      {"uchar", NumberType::kUint8},
      {"unsigned char", NumberType::kUint8},
      {"uint8", NumberType::kUint8},
      {"uint8_t", NumberType::kUint8},
      {"short", NumberType::kInt16},
      {"short int", NumberType::kInt16},
      {"signed short", NumberType::kInt16},
      {"signed short int", NumberType::kInt16},
      {"int16", NumberType::kInt16},
      {"int16_t", NumberType::kInt16},
      {"ushort", NumberType::kUint16},
      {"unsigned short", NumberType::kUint16},
      {"unsigned short int", NumberType::kUint16},
      {"uint16", NumberType::kUint16},
      {"uint16_t", NumberType::kUint16},
      {"int", NumberType::kInt32},
      {"signed int", NumberType::kInt32},
      {"int32", NumberType::kInt32},
      {"int32_t", NumberType::kInt32},
      {"uint", NumberType::kUint32},
      {"unsigned int", NumberType::kUint32},
      {"uint32", NumberType::kUint32},
      {"uint32_t", NumberType::kUint32},
      {"longlong", NumberType::kInt64},
      {"long long", NumberType::kInt64},
      {"long long int", NumberType::kInt64},
      {"signed long long", NumberType::kInt64},
      {"signed long long int", NumberType::kInt64},
      {"int64", NumberType::kInt64},
      {"int64_t", NumberType::kInt64},
      {"ulonglong", NumberType::kUint64},
      {"unsigned long long", NumberType::kUint64},
      {"uint64", NumberType::kUint64},
      {"unsigned long long int", NumberType::kUint64},
      {"uint64_t", NumberType::kUint64},
      {"float", NumberType::kFloat32},
      {"double", NumberType::kFloat64}};
  const std::string& name = header.need("type");
  const auto type = kTypes.find(lower(name));
  if (type == kTypes.end()) {
    refuse(header.file, message("expected a NRRD type of one number, found ", in_quotes(name)));
  }
  return type->second;
}

bool is_domain(const std::string& kind) {
  return kind == "domain" || kind == "space" || kind == "none" || kind == "???";
}

/// Which axis holds the values of a voxel: the first or the last of four, or none of three.
struct ValueAxis {
  std::size_t dimension = 3, axis = 3;

  bool is_there() const { return dimension == 4; }
};

/// Of four axes, the one that has no direction in space or whose kind is none of space; else the
/// last.
std::size_t find_value_axis(const NrrdHeader& header, const std::vector<std::string>& kinds) {
  const auto directions = words_of(header.or_else("space directions", ""));
  if (!directions.empty() && directions.front() == "none") return 0;
  return kinds.size() == 4 && !is_domain(kinds[0]) ? 0 : 3;
}

ValueAxis require_axes(const NrrdHeader& header) {
  const auto dimension = whole_numbers_of(header.file, "dimension", header.need("dimension"), 1)[0];
  if (dimension != 3 && dimension != 4) {
    refuse(header.file, message("expected a 3-D image, found ", dimension, " dimensions"));
  }
  const auto kinds = words_of(header.or_else("kinds", ""));
  ValueAxis found;
  if (dimension == 4) found = {4, find_value_axis(header, kinds)};
  for (std::size_t a = 0; a < kinds.size(); ++a) {
    if (!is_domain(kinds[a]) && !(found.is_there() && a == found.axis)) {
      refuse(header.file,
             message("expected three axes of space, found an axis of kind ", in_quotes(kinds[a])));
    }
  }
  return found;
}

void set_sizes(ScanFile& scan, const NrrdHeader& header, const ValueAxis& values,
               const Opening& opening) {
  auto sizes = whole_numbers_of(scan.file, "sizes", header.need("sizes"), values.dimension);
  std::int64_t count = 1;
  if (values.is_there()) {
    count = sizes[values.axis];
    sizes.erase(sizes.begin() + static_cast<std::ptrdiff_t>(values.axis));
  }
  set_size(scan, {sizes[0], sizes[1], sizes[2]});
  if (values.axis == 0) {
    set_values(scan, {1, count}, ValueOrder::kChannelsFirst, opening);
  } else {
    set_values(scan, {count, 1}, ValueOrder::kVolumesFirst, opening);
  }
}

/// The name of the space in lower case, without a fourth axis for time: "lps" for "LPST".
struct SpaceName {
  std::string name;
  bool timed = false;
};

SpaceName space_name(const NrrdHeader& header) {
  constexpr std::string_view kTime = "-time";
  SpaceName space{lower(header.or_else("space", ""))};
  const bool is_long = space.name.ends_with(kTime);
  space.timed = is_long || space.name == "rast" || space.name == "last" || space.name == "lpst";
  if (space.timed) space.name.resize(space.name.size() - (is_long ? kTime.size() : 1));
  return space;
}

/// +1 or -1 per world axis: converts the file's frame to LPS.
Vec3 signs_to_lps(const NrrdHeader& header, std::vector<std::string>& warnings) {
  const std::string space = space_name(header).name;
  if (space == "left-posterior-superior" || space == "lps") return {1, 1, 1};
  if (space == "right-anterior-superior" || space == "ras") return {-1, -1, 1};
  if (space == "left-anterior-superior" || space == "las") return {1, -1, 1};
  if (space.empty() || space == "scanner-xyz" || space == "3d-right-handed") {
    warnings.push_back("the header names no anatomical space: axes taken as LPS");
    return {1, 1, 1};
  }
  if (space == "3d-left-handed") {
    warnings.push_back("the header names no anatomical space: axes taken as left, back and feet");
    return {1, 1, -1};
  }
  refuse(header.file, message("expected the space LPS, RAS or LAS, found ",
                              in_quotes(header.or_else("space", ""))));
}

/// How many numbers a vector has: a fourth one, of time, does not count.
std::size_t space_dimension(const NrrdHeader& header) {
  const bool timed = space_name(header).timed;
  return timed || trimmed(header.or_else("space dimension", "3")) == "4" ? 4 : 3;
}

/// "(a,b,c)" as a vector of the file's frame.
Vec3 parse_vector(const NrrdHeader& header, const std::string& field, const std::string& text) {
  std::string numbers = text;
  if (!numbers.starts_with('(') || !numbers.ends_with(')')) {
    refuse(header.file, message("expected vectors (x,y,z) in the field ", in_quotes(field),
                                ", found ", in_quotes(text)));
  }
  std::replace_if(
      numbers.begin(), numbers.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  const auto v = numbers_of(header.file, field, numbers, space_dimension(header));
  return {v[0], v[1], v[2]};
}

/// The vectors of a field; white space inside the brackets is allowed.
std::vector<Vec3> vectors_of(const NrrdHeader& header, const std::string& field,
                             std::string_view text, std::size_t expected) {
  std::vector<Vec3> vectors;
  while (!trimmed(text).empty()) {
    const auto end = text.find(')');
    const auto length = end == std::string_view::npos ? text.size() : end + 1;
    vectors.push_back(parse_vector(header, field, std::string(trimmed(text.substr(0, length)))));
    text.remove_prefix(length);
  }
  if (vectors.size() != expected) {
    refuse(header.file, message("expected ", expected, " vectors in the field ", in_quotes(field),
                                ", found ", vectors.size()));
  }
  return vectors;
}

/// The texts of a field, in quotes or between white space.
std::vector<std::string> quoted_words(std::string_view text) {
  std::vector<std::string> words;
  while (!(text = trimmed(text)).empty()) {
    const bool quoted = text.front() == '"';
    const std::size_t begin = quoted ? 1 : 0;
    const std::size_t end =
        std::min(quoted ? text.find('"', 1) : text.find_first_of(" \t"), text.size());
    words.emplace_back(text.substr(begin, end - begin));
    text.remove_prefix(std::min(end + begin, text.size()));
  }
  return words;
}

/// mm per unit along three axes, as a field names them; 1, with a warning, for what is no length.
Vec3 units_in_mm(ScanFile& scan, const NrrdHeader& header, const std::string& field,
                 const ValueAxis& values) {
  std::vector<std::string> names = quoted_words(header.or_else(field, ""));
  if (names.size() == 4 && values.is_there()) {
    names.erase(names.begin() + static_cast<std::ptrdiff_t>(values.axis));
  }
  Vec3 mm{1, 1, 1};
  for (int a = 0; a < std::min<int>(3, static_cast<int>(names.size())); ++a) {
    const std::string& name = names[static_cast<std::size_t>(a)];
    const auto unit = mm_per_unit(name);
    if (!unit && !name.empty() && name != "???") {
      scan.warnings.push_back(message("the ", field, " ", in_quotes(name), " of axis ", a,
                                      " is no unit of length: mm assumed"));
    }
    mm[a] = unit.value_or(1);
  }
  return mm;
}

/// A field of one number per axis; NaN where there is none.
Vec3 axis_numbers(const NrrdHeader& header, const std::string& field, const ValueAxis& values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (!header.has(field)) return {kNone, kNone, kNone};
  auto n = numbers_of(header.file, field, header.need(field), values.dimension);
  if (values.is_there()) n.erase(n.begin() + static_cast<std::ptrdiff_t>(values.axis));
  return {n[0], n[1], n[2]};
}

/// Axes and first voxel in the file's own frame, mm.
struct Placement {
  StatedAxes axes;
  Vec3 origin;
};

/// Axes with directions in space.
Placement place_in_space(ScanFile& scan, const NrrdHeader& header, const ValueAxis& values) {
  std::string_view text = trimmed(header.need("space directions"));
  // The axis of the values has no direction, or one of time.
  if (values.axis == 0 && text.starts_with("none")) text.remove_prefix(4);
  if (values.axis == 3 && values.is_there() && text.ends_with("none")) text.remove_suffix(4);
  const std::size_t count = space_dimension(header) == 4 && values.axis == 3 ? 4 : 3;
  const Vec3 mm = units_in_mm(scan, header, "space units", {});
  if (!header.has("space units") && header.has("units")) {
    const Vec3 other = units_in_mm(scan, header, "units", values);
    if (other != Vec3{1, 1, 1}) {
      scan.warnings.push_back(
          "units of axes do not count where the header has space directions: mm assumed");
    }
  }
  const auto scaled = [&mm](const Vec3& v) { return Vec3{mm.x * v.x, mm.y * v.y, mm.z * v.z}; };
  const auto v = stated_or(
      scan, [&] { return vectors_of(header, "space directions", text, count); },
      std::vector<Vec3>(3));
  Placement placed{StatedAxes::of_steps({scaled(v[0]), scaled(v[1]), scaled(v[2])}), {}};
  if (header.has("space origin")) {
    placed.origin = scaled(vectors_of(header, "space origin", header.need("space origin"), 1)[0]);
  }
  return placed;
}

/// mm per unit of spacings and ends: the units of the axes, else those of the space they lie along.
Vec3 axis_units_in_mm(ScanFile& scan, const NrrdHeader& header, const ValueAxis& values) {
  return header.has("units") ? units_in_mm(scan, header, "units", values)
                             : units_in_mm(scan, header, "space units", {});
}

/// The first voxel where axes have no directions; the space may have units other than the axes'.
Vec3 stated_origin(ScanFile& scan, const NrrdHeader& header, const Vec3& axis_mm) {
  const bool apart = header.has("units") && header.has("space units");
  const Vec3 mm = apart ? units_in_mm(scan, header, "space units", {}) : axis_mm;
  const Vec3 v = vectors_of(header, "space origin", header.need("space origin"), 1)[0];
  return {mm.x * v.x, mm.y * v.y, mm.z * v.z};
}

/// Whether the ends of an axis are the outer sides of its voxels: unless it says otherwise.
bool is_cell_centred(const NrrdHeader& header, const ValueAxis& values, std::size_t axis) {
  auto words = words_of(header.or_else("centerings", header.or_else("centers", "")));
  if (words.size() == 4 && values.is_there()) {
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(values.axis));
  }
  return axis >= words.size() || lower(words[axis]) != "node";
}

/// Axes that have spacings and ends alone: along those of the frame.
Placement place_along_axes(ScanFile& scan, const NrrdHeader& header, const ValueAxis& values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto stated = [&](const char* field) {
    return stated_or(
        scan, [&] { return axis_numbers(header, field, values); }, Vec3{kNone, kNone, kNone});
  };
  const Vec3 mm = axis_units_in_mm(scan, header, values);
  Vec3 spacing = stated("spacings");
  const Vec3 least = stated("axis mins"), most = stated("axis maxs");
  Placement placed{{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {}}, {}};
  bool any = header.has("spacings");
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    const bool cells = is_cell_centred(header, values, axis);
    if (!header.has("spacings") && std::isfinite(most[a] - least[a])) {
      spacing[a] = (most[a] - least[a]) / std::max(scan.grid.size[axis] - (cells ? 0 : 1), 1);
      any = true;
    }
    if (std::isfinite(least[a]) && std::isfinite(spacing[a])) {
      placed.origin[a] = mm[a] * (least[a] + (cells ? spacing[a] / 2 : 0));
    }
    if (spacing[a] < 0) placed.axes.direction[axis] = -1 * placed.axes.direction[axis];
    placed.axes.spacing[a] = mm[a] * std::abs(spacing[a]);
  }
  if (header.has("space origin")) placed.origin = stated_origin(scan, header, mm);
  if (any) return placed;
  scan.warnings.push_back("the header gives no spacing: 1 mm assumed");
  placed.axes.spacing = {1, 1, 1};
  return placed;
}

void place(ScanFile& scan, const NrrdHeader& header, const ValueAxis& values) {
  const Vec3 sign = signs_to_lps(header, scan.warnings);
  const auto to_lps = [&sign](const Vec3& v) {
    return Vec3{sign.x * v.x, sign.y * v.y, sign.z * v.z};
  };
  Placement placed = header.has("space directions") ? place_in_space(scan, header, values)
                                                    : place_along_axes(scan, header, values);
  for (Vec3& direction : placed.axes.direction) direction = to_lps(direction);
  set_stated_axes(scan, placed.axes);
  set_origin(scan, to_lps(placed.origin));
}

/// What was done to the values before they were stored is told: it cannot be undone exactly.
void warn_of_values(ScanFile& scan, const NrrdHeader& header) {
  const std::string low = header.or_else("old min", header.or_else("oldmin", ""));
  const std::string high = header.or_else("old max", header.or_else("oldmax", ""));
  if (low.empty() || high.empty() || lower(low) == "nan") return;
  scan.warnings.push_back(message("the values were quantised from a range of ", in_quotes(low),
                                  " to ", in_quotes(high), ": they are kept as stored"));
}

void set_encoding(SampleSource& source, const NrrdHeader& header) {
  const std::string encoding = lower(header.need("encoding"));
  source.text = encoding == "ascii" || encoding == "text" || encoding == "txt";
  const bool gzip = encoding == "gzip" || encoding == "gz";
  if (!source.text && !gzip && encoding != "raw") {
    refuse(header.file,
           message("expected the encoding raw, gzip or ascii, found ", in_quotes(encoding)));
  }
  source.packing = gzip ? Packing::kDeflated : Packing::kPlain;
  if (source.text || byte_size(source.type) == 1) return;
  const std::string endian = lower(header.need("endian"));
  if (endian != "little" && endian != "big") {
    refuse(header.file, message("expected the endian little or big, found ", in_quotes(endian)));
  }
  source.big_endian = endian == "big";
}

/// Where the lines that "line skip" counts end.
std::uint64_t offset_behind_lines(const std::filesystem::path& file, std::uint64_t offset,
                                  std::int64_t lines) {
  ByteSource bytes(file, Packing::kPlain, offset);
  char c = 0;
  for (; lines > 0 && bytes.read(&c, 1) == 1; ++offset) lines -= c == '\n' ? 1 : 0;
  if (lines > 0) refuse(file, message("the header skips ", lines, " lines more than there are"));
  return offset;
}

void find_data(ScanFile& scan, const NrrdHeader& header, bool allow_outside) {
  SampleSource& source = scan.source;
  const std::string name = header.or_else("data file", "");
  if (name == "LIST" || name.starts_with("LIST ") || name.find('%') != std::string::npos) {
    scan.parts = listed_paths(header.file, name, header.listed, allow_outside);
  }
  source.file = name.empty()          ? header.file
                : !scan.parts.empty() ? scan.parts.front()
                                      : data_path(header.file, name, allow_outside);
  source.offset = name.empty() ? header.size : 0;
  source.exact = !name.empty();
  const auto skip = [&header](const std::string& field) {
    return whole_numbers_of(header.file, field, header.or_else(field, "0"), 1)[0];
  };
  const auto lines = skip("line skip"), bytes = skip("byte skip");
  if (lines < 0 || bytes < -1) {
    refuse(header.file, message("expected a skip of 0 or more (bytes: or -1), found ",
                                lines < 0 ? lines : bytes));
  }
  source.offset = offset_behind_lines(source.file, source.offset, lines);
  source.at_end = bytes == -1;
  source.skip = bytes > 0 ? static_cast<std::uint64_t>(bytes) : 0;
}

}  // namespace

ScanFile open_nrrd(const std::filesystem::path& file, const Opening& opening) {
  NrrdHeader header = read_header(file);
  ScanFile scan = begin_scan(file, "NRRD", opening);
  const ValueAxis axis = require_axes(header);
  set_sizes(scan, header, axis, opening);
  place(scan, header, axis);
  warn_of_values(scan, header);
  scan.source.type = sample_type(header);
  set_encoding(scan.source, header);
  find_data(scan, header, opening.allow_outside);
  warn_of_bytes_behind(scan);
  scan.keys = std::move(header.keys);
  return scan;
}

}  // namespace mesamis::detail::volume_files
