// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "mesamis/base/progress.h"
#include "mesamis/surface/select_parts.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::method {

/// From the surface as extracted to the one delivered.
struct PrintableReport {
  /// What the solid consisted of, and what went; none for a band or a flawed surface.
  std::optional<SelectionReport> parts;
  std::int64_t triangles_extracted = 0;  ///< of the parts that stay
  /// The greatest distance of any point of one surface to the other, mm: upper bounds, see
  /// max_distance(), or, without PrintableOptions::refit, those that decimation proved. 0 for a
  /// surface that is delivered as extracted; for one that is only rounded, how far that moved it.
  double extracted_to_result = 0, result_to_extracted = 0;

  /// Whether both distances are within the tolerance, mm; with 0 none is asked for. False where
  /// single precision is coarser.
  bool within(double tolerance) const noexcept {
    return tolerance == 0 || (extracted_to_result <= tolerance && result_to_extracted <= tolerance);
  }
};

/// What a printable surface must be.
struct PrintableOptions {
  double min_volume = 0;          ///< mm^3; smaller islands go, smaller cavities are filled
  std::int64_t keep_largest = 0;  ///< islands to keep; 0: all
  bool fill_cavities = false;     ///< every cavity
  double tolerance = 0;        ///< of decimation, mm, both ways; 0: none done; infinite: no bound
  std::int64_t triangles = 0;  ///< where decimation stops; 0: nowhere
  Progress progress = {};      ///< optional; may stop the work
  bool refit = true;           ///< whether points move at the end, see simplify()
  bool round = false;          ///< to single precision also where nothing is decimated
};

/// Makes the solid surface ready to be written in any format: the parts asked for; coordinates
/// that single precision holds; and no more triangles than the tolerance needs. With a tolerance of
/// 0 the parts that stay are as extracted, or rounded, see round_to_single().
/// @param extracted  world frame, mm. A surface that is not closed or not a 2-manifold is returned
///                   as it is.
/// @param report     optional: what was done, distances measured against the parts that stay.
/// @return world frame, mm.
/// @throws Cancelled   if progress says stop.
///
/// O(n log n) for n triangles.
TriMesh make_printable(const TriMesh& extracted, const PrintableOptions& options,
                       PrintableReport* report = nullptr);

}  // namespace mesamis::detail::method
