// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/surface_files.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/files/atomic_file.h"
#include "mesamis/files/byte_source.h"
#include "mesamis/files/refuse.h"
#include "mesamis/shape_files/surface_formats.h"

namespace mesamis {

namespace fs = std::filesystem;

namespace detail::shape_files {
namespace {

constexpr auto kMostPoints = static_cast<std::size_t>(std::numeric_limits<Index>::max());

}  // namespace

void refuse_extension(const fs::path& path, const std::string& known) {
  const std::string found = path.extension().string();
  refuse(path, "expected a surface file (" + known + "), found " +
                   (found.empty() ? "no extension" : "the extension " + in_quotes(found)));
}

std::string format_extension(const fs::path& path) {
  const std::string last = path.extension().string(), inner = path.stem().extension().string();
  return lower(last) == ".dcm" && lower(inner) == ".obj" ? inner + last : last;
}

std::string extension_of(const fs::path& path) {
  const bool packed = lower_extension(path) == ".gz";
  return lower(format_extension(packed ? path.stem() : path));
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 32; }, ' ');
  return text;
}

SurfaceWriteOptions as_written(const SurfaceWriteOptions& options) {
  SurfaceWriteOptions clean = options;
  clean.name = one_line(options.name);
  bool produced = false;
  for (auto& [type, text] : clean.metadata) {
    type = one_line(type);
    text = one_line(text);
    produced |= type == kProducer;
  }
  if (!produced) clean.metadata.insert(clean.metadata.begin(), {kProducer, "mesamis"});
  return clean;
}

void require_surface(const fs::path& path, const TriMesh& surface) {
  if (surface.triangles.empty()) refuse(path, "holds no triangle");
  if (surface.points.size() > kMostPoints) refuse(path, "its points exceed 32-bit indices");
  try {
    require_sound(surface);
  } catch (const InputError& error) {
    refuse(path, error.what());
  }
}

}  // namespace detail::shape_files

namespace {

using Parser = SurfaceFile (*)(const fs::path&, std::string_view, MemoryBudget&);
using ArrayParser = std::vector<double> (*)(const fs::path&, std::string_view, const std::string&,
                                            MemoryBudget&);
using Formatter = std::string (*)(const TriMesh&, const SurfaceWriteOptions&);

struct Format {
  const char* extension;
  Parser parse;     // null: not read
  Formatter bytes;  // null: not written
  bool grey = false;
  ArrayParser parse_array = nullptr;  // null: no arrays
  MostBytes most_bytes = nullptr;     // null: the first bytes do not tell
};

constexpr Format kFormats[] = {{".stl", parse_stl, stl_bytes, false, nullptr, most_stl_bytes},
                               {".ply", parse_ply, ply_bytes, false, parse_ply_array},
                               {".obj", parse_obj, obj_bytes},
                               {".vtp", parse_vtp, vtp_bytes, true, parse_vtp_array},
                               {".3mf", parse_threemf, threemf_bytes, true},
                               {".amf", parse_amf, amf_bytes, true},
                               {".glb", nullptr, glb_bytes, true},
                               {".dcm", parse_encapsulated, encapsulated_stl_bytes},
                               {".obj.dcm", parse_encapsulated, encapsulated_obj_bytes},
                               {".vtk", parse_vtk, nullptr}};

/// Null if there is none; all formats are read.
const Format* format_named(const std::string& extension) {
  const auto* format = std::find_if(std::begin(kFormats), std::end(kFormats),
                                    [&](const Format& f) { return extension == f.extension; });
  return format == std::end(kFormats) ? nullptr : format;
}

/// Null if no format of this extension is written; .gz is none.
const Format* written_format(const fs::path& path) {
  const Format* format = format_named(lower(format_extension(path)));
  return format != nullptr && format->bytes != nullptr ? format : nullptr;
}

/// Files of DICOM often have no extension.
const Format& format_of(const fs::path& path) {
  const Format* format = format_named(extension_of(path));
  if (format == nullptr && is_encapsulated(path)) format = format_named(".dcm");
  if (format != nullptr && format->parse != nullptr) return *format;
  refuse_extension(path, ".stl .ply .obj .vtp .3mf .amf .vtk, each also with .gz, or DICOM");
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

/// As many values as points, all of them finite.
void require_values(const fs::path& path, const char* what, const std::vector<double>& values,
                    const TriMesh& surface) {
  if (values.size() != surface.points.size()) {
    refuse(path, message("expected ", what, " per point (", surface.points.size(), "), found ",
                         values.size()));
  }
  if (std::any_of(values.begin(), values.end(), [](double x) { return !std::isfinite(x); })) {
    refuse(path, message(what, " is not finite"));
  }
}

/// As headers of .ply have it.
void require_one_word(const fs::path& path, const std::string& name) {
  const auto is_blank = [](char c) { return static_cast<unsigned char>(c) <= 32; };
  if (name.empty() || std::any_of(name.begin(), name.end(), is_blank)) {
    refuse(path, "expected one word as the name of an array, found " + in_quotes(name));
  }
}

}  // namespace

std::vector<std::string> written_surface_formats() {
  std::vector<std::string> extensions;
  for (const Format& format : kFormats) {
    if (format.bytes != nullptr) extensions.emplace_back(format.extension);
  }
  return extensions;
}

std::vector<std::string> read_surface_formats() {
  std::vector<std::string> extensions;
  for (const Format& format : kFormats) {
    if (format.parse != nullptr) extensions.emplace_back(format.extension);
  }
  return extensions;
}

bool carries_grey(const fs::path& path) {
  const Format* format = written_format(path);
  return format != nullptr && format->grey;
}

bool carries_arrays(const fs::path& path) {
  const Format* format = written_format(path);
  return format != nullptr && format->parse_array != nullptr;
}

void write_surface(const OutputPath& path, const TriMesh& surface,
                   const SurfaceWriteOptions& options) {
  if (surface.triangles.empty()) refuse(path, "an empty surface is not written");
  require_sound(surface);
  const Format* format = written_format(path);
  if (format == nullptr) refuse_extension(path, joined(written_surface_formats()));
  if (!options.grey.empty()) require_values(path, "a grey value", options.grey, surface);
  for (const PointArray& array : options.point_arrays) {
    require_values(path, "an array's value", array.values, surface);
    require_one_word(path, array.name);
  }
  SurfaceWriteOptions as = as_written(options);
  if (format->parse == parse_encapsulated) as.frame = Frame::kLps;  // that of DICOM
  write_file(path, format->bytes(as.frame != Frame::kRas ? surface : turned(surface), as));
}

SurfaceFile read_surface_file(const fs::path& path, const ReadLimits& limits) {
  const Format& format = format_of(path);
  MemoryBudget budget(path, limits);
  SurfaceFile file = format.parse(path, read_all(path, budget, format.most_bytes), budget);
  require_surface(path, file.surface);
  return file;
}

TriMesh read_surface(const fs::path& path, const ReadLimits& limits) {
  return read_surface_file(path, limits).surface;
}

TriMesh turned(TriMesh surface) {
  for (Vec3& p : surface.points) p = in_frame(p, Frame::kRas);
  return surface;
}

TriMesh in_lps(const SurfaceFile& file) {
  return file.frame == Frame::kRas ? turned(file.surface) : file.surface;
}

std::vector<double> read_point_array(const fs::path& path, const std::string& name,
                                     const ReadLimits& limits) {
  const Format* format = format_named(extension_of(path));
  if (format != nullptr && format->parse_array != nullptr) {
    MemoryBudget budget(path, limits);
    return format->parse_array(path, read_all(path, budget), name, budget);
  }
  refuse(path,
         "has no array " + in_quotes(name) + " to colour by, only .vtp and .ply files have arrays");
}

}  // namespace mesamis
