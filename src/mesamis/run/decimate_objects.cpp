// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/decimate_objects.h"

#include <algorithm>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/decimate/simplify_objects.h"
#include "mesamis/report/label_output.h"
#include "mesamis/report/verdict.h"
#include "mesamis/run/outcome_details.h"
#include "mesamis/surface/select_parts.h"

namespace mesamis::detail::run {
namespace {

bool is_closed(const NamedSurface& object) {
  return flaws_of(check_surface(object.surface)).empty();
}

/// The parts that the options leave. An object of which nothing is left goes.
DecimatedObjects with_chosen_parts(std::vector<NamedSurface> objects,
                                   const PrintableOptions& options) {
  const PartSelection wanted{options.min_volume, options.keep_largest, options.fill_cavities};
  DecimatedObjects left;
  for (NamedSurface& object : objects) {
    PrintableReport report;
    object.surface = select_parts(object.surface, wanted, &report.parts.emplace());
    if (object.surface.triangles.empty()) {
      left.dropped.push_back(std::move(object.name));
      continue;
    }
    left.objects.push_back(std::move(object));
    left.reports.push_back(report);
  }
  return left;
}

/// The parts stay as they are: they were chosen before.
void reduce_one(DecimatedObjects& one, PrintableOptions options) {
  options.min_volume = 0;
  options.keep_largest = 0;
  options.fill_cavities = false;
  PrintableReport report;
  TriMesh& surface = one.objects.front().surface;
  surface = make_printable(surface, options, &report);
  report.parts = one.reports.front().parts;
  one.reports.front() = report;
}

void reduce_several(DecimatedObjects& several, const PrintableOptions& options) {
  std::vector<TriMesh> surfaces;
  surfaces.reserve(several.objects.size());
  for (NamedSurface& object : several.objects) surfaces.push_back(std::move(object.surface));
  std::vector<DecimateReport> done;
  surfaces =
      simplify_objects(surfaces, {options.tolerance, options.triangles, options.progress}, &done);
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    several.objects[n].surface = std::move(surfaces[n]);
    PrintableReport& report = several.reports[n];
    report.triangles_extracted = done[n].triangles_before;
    report.extracted_to_result = done[n].original_to_result;
    report.result_to_extracted = done[n].result_to_original;
  }
}

std::string unmet_triangles(const std::vector<NamedSurface>& objects,
                            const PrintableOptions& options) {
  if (options.triangles == 0) return "";
  std::vector<FoundObject> found;
  found.reserve(objects.size());
  std::int64_t triangles = 0;
  for (const NamedSurface& object : objects) {
    found.push_back({object.surface, {}});
    triangles += std::ssize(object.surface.triangles);
  }
  return triangles_unmet(options.triangles, triangles - shared_triangles(found), options.tolerance);
}

}  // namespace

ObjectFile read_closed_objects(const std::filesystem::path& path, const ReadLimits& limits,
                               std::vector<std::string>& warnings) {
  ObjectFile file = read_object_file(path, limits);
  if (!std::all_of(file.objects.begin(), file.objects.end(), is_closed)) {
    SurfaceFile whole = read_surface_file(path, limits);
    const std::string flaws = flaws_of(check_surface(whole.surface));
    if (!flaws.empty()) {
      throw InputError(path.string() + ": expected a closed 2-manifold surface, found " + flaws);
    }
    warnings.push_back(path.string() +
                       ": parts that are not closed, taken as one surface without names");
    file = {{NamedSurface{}}, whole.frame};
    file.objects[0].surface = std::move(whole.surface);
  }
  const auto frame = file.frame;
  const bool coloured = file.coloured;
  return {in_lps(std::move(file)), frame, coloured};
}

DecimatedObjects decimate_objects(std::vector<NamedSurface> objects,
                                  const PrintableOptions& options) {
  DecimatedObjects done = with_chosen_parts(std::move(objects), options);
  if (done.objects.empty()) return done;
  if (done.objects.size() == 1) {
    reduce_one(done, options);
  } else {
    reduce_several(done, options);
  }
  done.unmet = unmet_triangles(done.objects, options);
  return done;
}

}  // namespace mesamis::detail::run
