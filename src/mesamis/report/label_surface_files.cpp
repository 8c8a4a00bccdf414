// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/label_surface_files.h"

#include <algorithm>

#include "mesamis/files/refuse.h"
#include "mesamis/report/report.h"

namespace mesamis::detail::report {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlaceholder = "{label}";

SurfaceWriteOptions write_options(const RunSurfaceOptions& options, const std::string& name) {
  SurfaceWriteOptions as;
  as.frame = options.frame;
  as.name = name;
  as.metadata = {{"producer", producer()}};
  as.subject = options.subject;
  return as;
}

bool is_of_single_precision(const fs::path& path) {
  return lower_extension(path) == ".stl" || lower_extension(path) == ".dcm";
}

}  // namespace

std::vector<NamedSurface> named_segments(std::span<const Segment> segments) {
  std::vector<NamedSurface> named;
  std::vector<Index> labels;
  labels.reserve(segments.size());
  for (const Segment& s : segments) labels.push_back(s.label);
  std::sort(labels.begin(), labels.end());
  const bool unique = std::adjacent_find(labels.begin(), labels.end()) == labels.end();
  for (const Segment& s : segments) {
    const Index label = unique ? s.label : static_cast<Index>(named.size()) + 1;
    named.push_back({s.name, s.colour, label, {}});
  }
  return named;
}

std::vector<NamedSurface> named_surfaces(const LabelResult& result) {
  std::vector<Segment> segments;
  segments.reserve(result.objects.size());
  for (const LabelledObject& object : result.objects) segments.push_back(object.segment);
  std::vector<NamedSurface> named = named_segments(segments);
  for (std::size_t n = 0; n < named.size(); ++n) named[n].surface = result.objects[n].surface;
  return named;
}

bool names_each(const fs::path& path) {
  return path.filename().string().find(kPlaceholder) != std::string::npos;
}

bool holds_all(const fs::path& path) {
  const auto formats = written_object_formats();
  const bool can =
      std::find(formats.begin(), formats.end(), lower_extension(path)) != formats.end();
  return can && !names_each(path);
}

std::vector<fs::path> label_paths(const fs::path& path, std::span<const NamedSurface> objects,
                                  bool several) {
  const std::string text = path.filename().string();
  const auto at = text.find(kPlaceholder);
  if (at == std::string::npos) {
    return several ? object_paths(path, objects) : std::vector<fs::path>{path};
  }
  // object_paths() makes "x-NAME.e" of "x.e": names safe for files, all different.
  const auto numbered = object_paths(fs::path("x" + path.extension().string()), objects);
  std::vector<fs::path> paths;
  for (const fs::path& one : numbered) {
    std::string file = text;
    const std::string name = one.stem().string().substr(2);
    paths.push_back(path.parent_path() / file.replace(at, std::string(kPlaceholder).size(), name));
  }
  return paths;
}

void write_named_surfaces(const OutputPath& path, std::span<const NamedSurface> objects,
                          const SurfaceWriteOptions& options) {
  if (holds_all(path)) return write_objects(path, objects, options);
  std::vector<NamedSurface> ready(objects.begin(), objects.end());
  if (is_of_single_precision(path)) ready = rounded_together(std::move(ready));
  const auto files = label_paths(path, objects, objects.size() > 1);
  SurfaceWriteOptions as = options;
  for (std::size_t n = 0; n < ready.size(); ++n) {
    as.name = ready[n].name;
    write_surface({files[n], path.set}, ready[n].surface, as);
  }
}

void write_label_surfaces(std::span<const OutputPath> paths, const LabelResult& result,
                          const RunSurfaceOptions& options, bool several) {
  const std::vector<NamedSurface> objects = named_surfaces(result);
  std::vector<NamedSurface> rounded;  // for files of one object each in single precision
  for (const OutputPath& path : paths) {
    if (holds_all(path)) {
      write_objects(path, objects, write_options(options, options.name));
      continue;
    }
    const bool single = is_of_single_precision(path);
    if (single && rounded.empty()) rounded = rounded_together(objects);
    const auto files = label_paths(path, objects, several);
    for (std::size_t n = 0; n < objects.size(); ++n) {
      SurfaceWriteOptions as = write_options(options, objects[n].name);
      const auto& expected = result.objects[n].expected_error;
      if (options.error && !expected.empty()) {
        as.point_arrays.push_back({"expected_error", expected});
      }
      write_surface({files[n], path.set}, (single ? rounded : objects)[n].surface, as);
    }
  }
}

}  // namespace mesamis::detail::report
