// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/run_surface.h"

#include <nlohmann/json.hpp>

#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"
#include "mesamis/report/report.h"
#include "mesamis/report/settings_json.h"

namespace mesamis::detail::report {

namespace {

[[noreturn]] void refuse_volume(const SelectionReport& parts, double least, bool is_given) {
  const std::string found = ", found " + std::to_string(parts.islands_dropped) + " of " +
                            rounded_text(parts.volume_dropped) + " mm^3 in all";
  const std::string bound = (is_given ? number_text(least) : rounded_text(least, 4)) + " mm^3";
  throw InputError(
      "surface: expected a part of at least " +
      (is_given ? "--min-volume " + bound + found : bound + found + "; --min-volume 0 keeps them"));
}

}  // namespace

SurfaceWriteOptions surface_options(const Result& result, double voxel,
                                    const RunSurfaceOptions& options) {
  const bool grey = options.grey && !result.mesh.cells.empty();
  SurfaceWriteOptions as{
      options.frame,
      options.name + (result.parameters.preview ? " (preview)" : ""),
      grey ? surface_grey(result, voxel) : std::vector<double>{},
      {{"producer", producer()}, {"settings", to_json(settings_of(result.parameters)).dump()}}};
  as.subject = options.subject;
  if (options.error && !result.expected_error.empty()) {
    as.point_arrays.push_back({"expected_error", result.expected_error});
  }
  return as;
}

void require_surface(const Result& result, const Settings& asked) {
  if (!result.surface.triangles.empty()) return;
  const Parameters& p = result.parameters;
  if (p.surface == SurfaceKind::kBand) {
    throw InputError("surface: expected cells with v below --band-threshold " +
                     number_text(p.band_threshold) + ", found none");
  }
  const auto& parts = result.printable.parts;
  if (parts && parts->islands_dropped > 0) {
    refuse_volume(*parts, p.min_volume, asked.min_volume.has_value());
  }
  throw InputError("surface: expected values above " +
                   (asked.level
                        ? "--level " + number_text(*asked.level)
                        : "the level of " + rounded_text(p.level, 4) + " that the scan suggests") +
                   ", found none");
}

}  // namespace mesamis::detail::report
