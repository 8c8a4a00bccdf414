// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "mesamis/files/length_unit.h"
#include "mesamis/files/refuse.h"
#include "mesamis/image/orientation.h"
#include "mesamis/volume_files/formats.h"
#include "mesamis/volume_files/text_header.h"

namespace mesamis::detail::volume_files {
namespace {

struct MetaHeader {
  std::filesystem::path file;
  HeaderFields fields;
  std::vector<std::string> listed{};  // data files, behind "ElementDataFile = LIST"
  std::uint64_t size = 0;             // bytes up to the local data

  /// The value of the first of these names that is there, else the fallback.
  std::string get(std::initializer_list<const char*> names, const std::string& fallback) const {
    for (const char* name : names) {
      const auto field = fields.find(name);
      if (field != fields.end()) return field->second;
    }
    return fallback;
  }
  std::string need(const char* name) const {
    const auto field = fields.find(name);
    if (field == fields.end()) {
      refuse(file, message("expected the field ", in_quotes(name),
                           " in the MetaImage header, found none"));
    }
    return field->second;
  }
  bool is_true(std::initializer_list<const char*> names) const {
    const std::string value = lower(get(names, "false"));
    return value.starts_with('t') || value.starts_with('y') || value.starts_with('1');
  }
};

/// ElementDataFile ends the header; local data follow it.
MetaHeader read_header(const std::filesystem::path& file) {
  MetaHeader header{file, {}, {}, 0};
  HeaderLines lines(file);
  for (std::string line; lines.next(line);) {
    if (header.fields.count("elementdatafile")) {
      if (!trimmed(line).empty()) header.listed.emplace_back(trimmed(line));
      continue;
    }
    const auto equals = line.find('=');
    if (trimmed(line).empty()) continue;
    if (equals == std::string::npos) {
      refuse(file, message("expected \"Field = value\" in the MetaImage header, found ",
                           in_quotes(line)));
    }
    const std::string name = lower(trimmed(std::string_view(line).substr(0, equals)));
    header.fields.emplace(name, std::string(trimmed(std::string_view(line).substr(equals + 1))));
    if (name == "elementdatafile" && !header.fields.at(name).starts_with("LIST")) break;
  }
  header.size = lines.position();
  return header;
}

NumberType sample_type(const MetaHeader& header) {
  // MET_LONG has 4 bytes in every file: MetaIO's own rule.
  static const std::map<std::string, NumberType> kTypes{
      {"met_char", NumberType::kInt8},       {"met_uchar", NumberType::kUint8},
      {"met_short", NumberType::kInt16},     {"met_ushort", NumberType::kUint16},
      {"met_int", NumberType::kInt32},       {"met_uint", NumberType::kUint32},
      {"met_long", NumberType::kInt32},      {"met_ulong", NumberType::kUint32},
      {"met_long_long", NumberType::kInt64}, {"met_ulong_long", NumberType::kUint64},
      {"met_float", NumberType::kFloat32},   {"met_double", NumberType::kFloat64}};
  const std::string name = header.need("elementtype");
  const auto type = kTypes.find(lower(name));
  if (type == kTypes.end()) {
    refuse(header.file, message("expected an ElementType of one number, found ", in_quotes(name)));
  }
  return type->second;
}

std::int64_t whole_number(const MetaHeader& header, const char* field, const std::string& text) {
  return whole_numbers_of(header.file, field, text, 1)[0];
}

/// Space has three axes; a fourth one holds volumes.
std::size_t axis_count(const MetaHeader& header) {
  const auto axes = whole_number(header, "NDims", header.need("ndims"));
  if (axes == 3 || axes == 4) return static_cast<std::size_t>(axes);
  refuse(header.file, message("expected a 3-D image, found ", axes, " dimensions"));
}

void set_sizes(ScanFile& scan, const MetaHeader& header, std::size_t axes, const Opening& opening) {
  const auto size = whole_numbers_of(scan.file, "DimSize", header.need("dimsize"), axes);
  set_size(scan, {size[0], size[1], size[2]});
  const auto channels =
      whole_number(header, "ElementNumberOfChannels", header.get({"elementnumberofchannels"}, "1"));
  set_values(scan, {axes > 3 ? size[3] : 1, channels}, ValueOrder::kChannelsFirst, opening);
}

/// The direction of each axis; the file lists them one after another, by default x y z.
std::array<Vec3, 3> axis_directions(const MetaHeader& header, std::size_t count) {
  const std::string text = header.get({"transformmatrix", "orientation", "rotation"}, "");
  if (text.empty()) return {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  const auto m = numbers_of(header.file, "TransformMatrix", text, count * count);
  std::array<Vec3, 3> axes;
  for (std::size_t a = 0; a < 3; ++a) {
    axes[a] = {m[count * a], m[count * a + 1], m[count * a + 2]};
    if (!(std::abs(norm(axes[a]) - 1) <= kSkewTolerance)) {
      refuse(header.file, message("expected a TransformMatrix of unit vectors, found length ",
                                  norm(axes[a]), " for axis ", a));
    }
    axes[a] = (1 / norm(axes[a])) * axes[a];
  }
  return axes;
}

/// mm per unit of the header's lengths.
double unit_in_mm(ScanFile& scan, const MetaHeader& header) {
  const std::string name = header.get({"distanceunits"}, "");
  if (name.empty() || name == "?") return 1;
  const auto mm = mm_per_unit(name);
  if (!mm) {
    scan.warnings.push_back(
        message("the DistanceUnits ", in_quotes(name), " are no unit of length: mm assumed"));
  }
  return mm.value_or(1);
}

Vec3 stated_spacing(ScanFile& scan, const MetaHeader& header, std::size_t axes) {
  const std::string text = header.get({"elementspacing", "elementsize"}, "");
  if (text.empty()) {
    scan.warnings.push_back("the header gives no ElementSpacing: 1 mm assumed");
    return {1, 1, 1};
  }
  return stated_or(
      scan,
      [&] {
        const auto s = numbers_of(header.file, "ElementSpacing", text, axes);
        return Vec3{s[0], s[1], s[2]};
      },
      Vec3{});
}

/// Letters for the sides of the body that the axes come from, as the format has them, do not place
/// the voxels: other readers ignore them too.
void warn_of_orientation(ScanFile& scan, const MetaHeader& header) {
  const std::string stated = header.get({"anatomicalorientation"}, "");
  const auto is_letter = [](char c) {
    return std::string_view("RLAPIS").find(c) != std::string::npos;
  };
  if (stated.size() != 3 || !std::all_of(stated.begin(), stated.end(), is_letter)) return;
  const auto to = orientation_of(scan.grid.direction).letters;
  const std::string towards(to.begin(), to.end());
  std::string from;
  for (const char letter : towards) {
    constexpr std::string_view kSides = "RLAPIS";
    from += kSides[kSides.find(letter) ^ 1u];
  }
  if (stated == from || stated == towards) return;
  scan.warnings.push_back(message("AnatomicalOrientation states ", stated, ", TransformMatrix ",
                                  from, ": TransformMatrix is used"));
}

void place(ScanFile& scan, const MetaHeader& header, std::size_t count) {
  const double mm = unit_in_mm(scan, header);
  const Vec3 spacing = stated_spacing(scan, header, count);
  for (int a = 0; a < 3; ++a) {
    if (spacing[a] > 0 || scan.given_spacing) continue;
    refuse(header.file, message("expected a positive ElementSpacing, found ", spacing[a],
                                " (--spacing X,Y,Z replaces it)"));
  }
  set_stated_axes(scan, {axis_directions(header, count), mm * spacing});
  const std::string text = header.get({"offset", "position", "origin"}, "");
  if (text.empty()) return;
  const auto origin = numbers_of(header.file, "Offset", text, count);
  set_origin(scan, mm * Vec3{origin[0], origin[1], origin[2]});
}

/// Native value = slope * stored + offset.
void set_scale(ScanFile& scan, const MetaHeader& header) {
  const auto number = [&header](const char* name, const char* field, const char* otherwise) {
    return numbers_of(header.file, name, header.get({field}, otherwise), 1)[0];
  };
  const double slope =
      number("ElementToIntensityFunctionSlope", "elementtointensityfunctionslope", "1");
  const double offset =
      number("ElementToIntensityFunctionOffset", "elementtointensityfunctionoffset", "0");
  if (slope == 0 || !std::isfinite(slope) || !std::isfinite(offset)) {
    scan.warnings.push_back(message("the scale of the values cannot be used (slope ", slope,
                                    ", offset ", offset, "): they are kept as stored"));
    return;
  }
  scan.source.slope = slope;
  scan.source.intercept = offset;
}

void find_data(ScanFile& scan, const MetaHeader& header, bool allow_outside) {
  SampleSource& source = scan.source;
  const std::string name = header.need("elementdatafile");
  if (name == "LIST" || name.starts_with("LIST ") || name.find('%') != std::string::npos) {
    scan.parts = listed_paths(header.file, name, header.listed, allow_outside);
  }
  const bool local = lower(name) == "local";
  source.file = local                 ? header.file
                : !scan.parts.empty() ? scan.parts.front()
                                      : data_path(header.file, name, allow_outside);
  source.offset = local ? header.size : 0;
  source.text = header.fields.count("binarydata") && !header.is_true({"binarydata"});
  source.big_endian = header.is_true({"binarydatabyteordermsb", "elementbyteordermsb"});
  source.packing = header.is_true({"compresseddata"}) ? Packing::kDeflated : Packing::kPlain;
  const auto skip =
      whole_numbers_of(header.file, "HeaderSize", header.get({"headersize"}, "0"), 1)[0];
  if (skip < -1) {
    refuse(header.file, message("expected a HeaderSize of 0 or more, or -1, found ", skip));
  }
  source.at_end = skip == -1;
  if (!local && skip > 0) source.offset = static_cast<std::uint64_t>(skip);
  source.exact = !local;
}

std::string modality(const MetaHeader& header) {
  const std::string name = header.get({"modality"}, "");
  const std::string prefix = "MET_MOD_";
  if (!name.starts_with(prefix) || name == "MET_MOD_UNKNOWN") return "";
  return shown(std::string_view(name).substr(prefix.size()));
}

}  // namespace

ScanFile open_meta(const std::filesystem::path& file, const Opening& opening) {
  const MetaHeader header = read_header(file);
  ScanFile scan = begin_scan(file, "MetaImage", opening);
  const std::size_t axes = axis_count(header);
  set_sizes(scan, header, axes, opening);
  place(scan, header, axes);
  warn_of_orientation(scan, header);
  scan.source.type = sample_type(header);
  set_scale(scan, header);
  find_data(scan, header, opening.allow_outside);
  warn_of_bytes_behind(scan);
  scan.grid.modality = modality(header);
  return scan;
}

}  // namespace mesamis::detail::volume_files
