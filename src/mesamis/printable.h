// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "mesamis/base/progress.h"
#include "mesamis/settings.h"
#include "mesamis/surface/select_parts.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// From the surface as extracted to the one delivered.
struct PrintableReport {
  /// What the solid consisted of, and what went; none for a band or a flawed surface.
  std::optional<SelectionReport> parts;
  std::int64_t triangles_extracted = 0;  ///< of the parts that stay
  /// The greatest distance of any point of one surface to the other, mm: upper bounds, see
  /// max_distance(). 0 for a surface that is delivered as extracted.
  double extracted_to_result = 0, result_to_extracted = 0;

  /// False where single precision is coarser than the tolerance, mm.
  bool within(double tolerance) const {
    return extracted_to_result <= tolerance && result_to_extracted <= tolerance;
  }
};

/// Makes the solid surface ready to be written in any format: the parts asked for; coordinates
/// that single precision holds; and no more triangles than settings.tolerance and
/// settings.triangles ask for. With neither (tolerance 0) the parts that stay are as extracted.
/// @param extracted  world frame, mm. What is not closed or not a 2-manifold is returned as it is.
/// @param settings   defaults filled in, see prepare_image(); what is still missing counts as 0.
/// @param report     what was done, distances measured against the parts that stay.
/// @throws Cancelled   if progress says stop.
TriMesh make_printable(const TriMesh& extracted, const Settings& settings, const Progress& progress,
                       PrintableReport& report);

}  // namespace mesamis
