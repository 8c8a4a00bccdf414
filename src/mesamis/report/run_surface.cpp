// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/run_surface.h"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "mesamis/base/error.h"
#include "mesamis/report/report.h"
#include "mesamis/report/settings_json.h"

namespace mesamis::detail::report {

namespace {

/// A number as the user would write it: the shortest that reads back, without an exponent.
std::string shortest(double value) {
  std::array<char, 400> text;  // the largest numbers have 309 digits
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  return end.ec == std::errc() ? std::string(text.data(), end.ptr) : std::to_string(value);
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

void require_surface(const Result& result) {
  if (!result.surface.triangles.empty()) return;
  const Parameters& p = result.parameters;
  if (p.surface == SurfaceKind::kBand) {
    throw InputError("surface: expected cells with v below --band-threshold " +
                     shortest(p.band_threshold) + ", found none");
  }
  const auto& parts = result.printable.parts;
  if (parts && parts->islands_dropped > 0) {
    throw InputError("surface: expected a part of at least --min-volume " + shortest(p.min_volume) +
                     " mm^3, found none");
  }
  throw InputError("surface: expected values above --level " + shortest(p.level) + ", found none");
}

}  // namespace mesamis::detail::report
