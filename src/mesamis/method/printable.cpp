// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/printable.h"

#include <algorithm>
#include <iterator>

#include "mesamis/decimate/decimate.h"
#include "mesamis/decimate/round_to_single.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/select_parts.h"

namespace mesamis {
namespace {

/// First rounded, then decimated: what is left is where it was, so that what decimation promises
/// is true of every file.
TriMesh decimated(const TriMesh& surface, const PrintableOptions& printable) {
  RoundReport rounding;
  const TriMesh rounded = round_to_single(surface, &rounding);
  DecimateOptions options;
  options.tolerance = std::max(0.0, printable.tolerance - rounding.shift);
  options.triangles = printable.triangles;
  options.progress = printable.progress;
  return decimate(rounded, options);
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
  if (parts.triangles.empty() || options.tolerance == 0) return parts;
  TriMesh result = decimated(parts, options);
  const double fine = fine_enough(parts, options.tolerance);
  done.extracted_to_result = max_distance(parts, result, fine);
  done.result_to_extracted = max_distance(result, parts, fine);
  return result;
}

}  // namespace mesamis
