// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/printable.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "mesamis/decimate/decimate.h"
#include "mesamis/decimate/round_to_single.h"
#include "mesamis/decimate/simplify.h"
#include "mesamis/surface/select_parts.h"

namespace mesamis::detail::method {
namespace {

/// First rounded, then, if asked for, decimated and refitted, to values of single precision: what
/// these promise is true of every file.
TriMesh decimated(const TriMesh& surface, const PrintableOptions& printable,
                  PrintableReport& report) {
  RoundReport rounding;
  TriMesh rounded = round_to_single(surface, &rounding);
  report.extracted_to_result = report.result_to_extracted = rounding.shift;
  if (printable.tolerance == 0) return rounded;
  DecimateOptions options;
  options.tolerance = std::max(0.0, printable.tolerance - rounding.shift);
  options.triangles = printable.triangles;
  options.progress = printable.progress;
  DecimateReport decimation;
  TriMesh result = printable.refit ? simplify(rounded, options, &decimation)
                                   : decimate::decimate(rounded, options, &decimation);
  report.extracted_to_result += decimation.original_to_result;
  report.result_to_extracted += decimation.result_to_original;
  return result;
}

}  // namespace

TriMesh make_printable(const TriMesh& extracted, const PrintableOptions& options,
                       PrintableReport* report) {
  PrintableReport unasked;
  PrintableReport& done = report != nullptr ? *report : unasked;
  done = {};
  done.triangles_extracted = std::ssize(extracted.triangles);
  if (!flaws_of(check_surface(extracted)).empty()) return extracted;  // for the caller to find
  const PartSelection wanted{options.min_volume, options.keep_largest, options.fill_cavities};
  TriMesh parts = select_parts(extracted, wanted, &done.parts.emplace());
  done.triangles_extracted = std::ssize(parts.triangles);
  const bool stays = options.tolerance == 0 && !options.round;
  if (parts.triangles.empty() || stays) return parts;
  return decimated(parts, options, done);
}

}  // namespace mesamis::detail::method
