// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>

#include "mesamis/files/refuse.h"
#include "mesamis/scan_files/formats.h"
#include "mesamis/scan_files/text_header.h"

namespace mesamis::detail {
namespace {

struct MetaHeader {
  std::filesystem::path file;
  HeaderFields fields;
  std::uint64_t size = 0;  // bytes up to the local data

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
      refuse(file,
             say("expected the field ", in_quotes(name), " in the MetaImage header, found none"));
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
  MetaHeader header{file, {}, 0};
  HeaderLines lines(file);
  for (std::string line; lines.next(line);) {
    const auto equals = line.find('=');
    if (trimmed(line).empty()) continue;
    if (equals == std::string::npos) {
      refuse(file,
             say("expected \"Field = value\" in the MetaImage header, found ", in_quotes(line)));
    }
    const std::string name = lower(trimmed(std::string_view(line).substr(0, equals)));
    header.fields.emplace(name, std::string(trimmed(std::string_view(line).substr(equals + 1))));
    if (name == "elementdatafile") break;
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
    refuse(header.file, say("expected an ElementType of one number, found ", in_quotes(name)));
  }
  return type->second;
}

void require_three_axes(const MetaHeader& header) {
  const auto whole = [&header](const char* field, const std::string& text) {
    return whole_numbers_of(header.file, field, text, 1)[0];
  };
  const auto axes = whole("NDims", header.need("ndims"));
  if (axes != 3) refuse(header.file, say("expected a 3-D image, found ", axes, " dimensions"));
  const auto channels =
      whole("ElementNumberOfChannels", header.get({"elementnumberofchannels"}, "1"));
  if (channels != 1) {
    refuse(header.file, say("expected one number per voxel, found ", channels, " channels"));
  }
}

/// The direction of each axis; the file lists them one after another, by default x y z.
std::array<Vec3, 3> axis_directions(const MetaHeader& header) {
  const auto m = numbers_of(
      header.file, "TransformMatrix",
      header.get({"transformmatrix", "orientation", "rotation"}, "1 0 0 0 1 0 0 0 1"), 9);
  std::array<Vec3, 3> axes;
  for (std::size_t a = 0; a < 3; ++a) {
    axes[a] = {m[3 * a], m[3 * a + 1], m[3 * a + 2]};
    if (!(std::abs(norm(axes[a]) - 1) <= kSkewTolerance)) {
      refuse(header.file, say("expected a TransformMatrix of unit vectors, found length ",
                              norm(axes[a]), " for axis ", a));
    }
    axes[a] = (1 / norm(axes[a])) * axes[a];
  }
  return axes;
}

void place(ScanFile& scan, const MetaHeader& header) {
  const std::string spacing = header.get({"elementspacing", "elementsize"}, "");
  if (spacing.empty()) scan.warnings.push_back("the header gives no ElementSpacing: 1 mm taken");
  const auto s = numbers_of(header.file, "ElementSpacing", spacing.empty() ? "1 1 1" : spacing, 3);
  auto steps = axis_directions(header);
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(s[a] > 0)) {
      refuse(header.file, say("expected a positive ElementSpacing, found ", s[a]));
    }
    steps[a] = s[a] * steps[a];
  }
  set_axes(scan, steps);
  const auto origin =
      numbers_of(header.file, "Offset", header.get({"offset", "position", "origin"}, "0 0 0"), 3);
  set_origin(scan, {origin[0], origin[1], origin[2]});
}

void find_data(SampleSource& source, const MetaHeader& header, bool allow_outside) {
  const std::string name = header.need("elementdatafile");
  if (name == "LIST" || name.starts_with("LIST ") || name.find('%') != std::string::npos) {
    refuse(header.file, say("expected one ElementDataFile, found ", in_quotes(name)));
  }
  const bool local = lower(name) == "local";
  source.file = local ? header.file : data_path(header.file, name, allow_outside);
  source.offset = local ? header.size : 0;
  source.text = header.fields.count("binarydata") && !header.is_true({"binarydata"});
  source.big_endian = header.is_true({"binarydatabyteordermsb", "elementbyteordermsb"});
  source.packing = header.is_true({"compresseddata"}) ? Packing::kDeflated : Packing::kPlain;
  const auto skip =
      whole_numbers_of(header.file, "HeaderSize", header.get({"headersize"}, "0"), 1)[0];
  if (skip < -1) {
    refuse(header.file, say("expected a HeaderSize of 0 or more, or -1, found ", skip));
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
  ScanFile scan{file, "MetaImage", {}, {}, {}};
  require_three_axes(header);
  const auto size = whole_numbers_of(file, "DimSize", header.need("dimsize"), 3);
  set_size(scan, {size[0], size[1], size[2]});
  place(scan, header);
  scan.source.type = sample_type(header);
  find_data(scan.source, header, opening.allow_outside);
  scan.grid.modality = modality(header);
  return scan;
}

}  // namespace mesamis::detail
