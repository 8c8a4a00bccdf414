// SPDX-License-Identifier: Apache-2.0
// VGSTUDIO's volumes: a text of sections (.vgi) that describes a file of bare samples (.vol).
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "mesamis/files/length_unit.h"
#include "mesamis/files/refuse.h"
#include "mesamis/files/text_scan.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/text_header.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

/// "section/key" in lower case to the first value that is stated.
using Fields = std::map<std::string, std::string>;

struct Vgi {
  fs::path file;
  Fields fields;

  /// Of the first of these names that is there; empty if none is.
  std::string get(std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      if (const auto field = fields.find(name); field != fields.end()) return field->second;
    }
    return "";
  }
  std::string need(std::initializer_list<const char*> names) const {
    std::string value = get(names);
    if (value.empty())
      refuse(file, message("expected the field ", in_quotes(*names.begin()), ", found none"));
    return value;
  }
};

Vgi read_sections(const fs::path& file) {
  Vgi vgi{file, {}};
  HeaderLines lines(file);
  std::string section;
  for (std::string line; lines.next(line);) {
    const std::string_view text = trimmed(line);
    if (text.starts_with('[') && text.ends_with(']')) {
      section = lower(trimmed(text.substr(1, text.size() - 2)));
    }
    const auto equals = text.find('=');
    if (equals == std::string_view::npos || section.empty()) continue;
    vgi.fields.emplace(section + "/" + lower(trimmed(text.substr(0, equals))),
                       std::string(trimmed(text.substr(equals + 1))));
  }
  if (vgi.fields.empty()) refuse(file, "expected sections [..] of a .vgi file, found none");
  return vgi;
}

NumberType sample_type(const Vgi& vgi) {
  const std::string name = lower(vgi.need({"file1/datatype", "representation/datatype"}));
  const std::string bits = vgi.need({"file1/bitsperelement", "representation/bitsperelement"});
  const bool is_signed = name == "signed integer" || name == "integer";
  static const std::map<std::string, NumberType> kUnsigned{
      {"8", NumberType::kUint8}, {"16", NumberType::kUint16}, {"32", NumberType::kUint32}};
  static const std::map<std::string, NumberType> kSigned{
      {"8", NumberType::kInt8}, {"16", NumberType::kInt16}, {"32", NumberType::kInt32}};
  static const std::map<std::string, NumberType> kReal{{"32", NumberType::kFloat32},
                                                       {"64", NumberType::kFloat64}};
  const auto& types = name == "float" ? kReal : is_signed ? kSigned : kUnsigned;
  const auto type = types.find(bits);
  const bool known = name == "float" || is_signed || name == "unsigned integer";
  if (!known || type == types.end()) {
    refuse(vgi.file, message("expected integers or floating point of 8 to 64 bits, found ",
                             in_quotes(name), " of ", in_quotes(bits)));
  }
  return type->second;
}

/// What moves the volume in VGSTUDIO's scene.
void warn_of_scene(ScanFile& scan, const Vgi& vgi) {
  struct Field {
    const char *name, *at_rest;
  };
  constexpr std::array kFields{Field{"relativeposition", "0 0 0"}, Field{"position", "0 0 0"},
                               Field{"scale", "1 1 1"}, Field{"rotate", "1 0 0 0 1 0 0 0 1"},
                               Field{"rotation", "1 0 0 0 1 0 0 0 1"}};
  for (const Field& field : kFields) {
    const std::string text = vgi.get({(std::string("geometry/") + field.name).c_str()});
    std::string_view stated = text, rest = field.at_rest;
    bool moved = false;
    while (!trimmed(stated).empty()) {
      double value = 0, still = 0;
      moved = !parse_number(take_word(stated), value) || !parse_number(take_word(rest), still) ||
              value != still || moved;
    }
    if (!moved) continue;
    scan.warnings.push_back(message("the volume has a place in VGSTUDIO's scene (", field.name,
                                    " = ", shown(text), "): it is not applied"));
  }
}

void place(ScanFile& scan, const Vgi& vgi) {
  const std::string text = vgi.get({"geometry/resolution"}), unit = vgi.get({"geometry/unit"});
  const auto mm = mm_per_unit(unit);
  if (!unit.empty() && !mm) {
    scan.warnings.push_back(
        message("the unit ", in_quotes(unit), " is no unit of length: mm assumed"));
  }
  if (text.empty()) scan.warnings.emplace_back("the header gives no resolution: 1 mm assumed");
  const Vec3 spacing = stated_or(
      scan,
      [&] {
        const auto s = numbers_of(vgi.file, "resolution", text.empty() ? "1 1 1" : text, 3);
        return Vec3{s[0], s[1], s[2]};
      },
      Vec3{});
  set_stated_axes(scan, {{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, mm.value_or(1) * spacing});
  const std::string mirror = vgi.get({"representation/mirror"});
  if (mirror.find('1') != std::string::npos) {
    scan.warnings.push_back("the file asks for a mirrored view: the values are kept as stored");
  }
  warn_of_scene(scan, vgi);
}

/// The name without folders, which are those of another machine.
std::string last_part(const std::string& name) { return name.substr(name.find_last_of("/\\") + 1); }

}  // namespace

ScanFile open_vgi(const fs::path& file, const Opening& opening) {
  fs::path header = file;
  if (lower_extension(file) == ".vol") header.replace_extension(".vgi");
  const Vgi vgi = read_sections(header);
  if (!vgi.get({"file2/name"}).empty()) {
    refuse(header, "expected one file of samples, found several");
  }
  const std::string format = lower(vgi.get({"file1/fileformat"}));
  if (!format.empty() && format != "raw") {
    refuse(header, "expected the file format raw, found " + in_quotes(format));
  }
  ScanFile scan = begin_scan(header, "VGI", opening);
  const auto size =
      whole_numbers_of(header, "size", vgi.need({"file1/size", "representation/size"}), 3);
  set_size(scan, {size[0], size[1], size[2]});
  place(scan, vgi);
  scan.source.type = sample_type(vgi);
  scan.source.file = data_path(header, last_part(vgi.need({"file1/name"})), opening.allow_outside);
  const auto skip = whole_numbers_of(
      header, "SkipHeader",
      vgi.get({"file1/skipheader"}).empty() ? "0" : vgi.get({"file1/skipheader"}), 1)[0];
  if (skip < 0) refuse(header, message("expected a SkipHeader of 0 or more, found ", skip));
  scan.source.offset = static_cast<std::uint64_t>(skip);
  scan.source.exact = true;
  return scan;
}

}  // namespace mesamis::detail::volume_files
