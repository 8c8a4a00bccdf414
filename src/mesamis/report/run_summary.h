// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/method/expected_error.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::report {

/// The figures of a run that reports and tables give, without its meshes and fields.
struct RunSummary {
  Parameters parameters;  ///< what the run used
  MeasuredImage image;
  std::vector<Iteration> iterations;    ///< one at least; the last is the final minimisation
  std::int64_t tets = 0, nodes = 0;     ///< of the adapted mesh
  MeshFit fit;                          ///< of that mesh to its metric
  std::int64_t triangles = 0;           ///< of the surface delivered
  std::int64_t vertices = 0;            ///< of the surface delivered
  SurfaceCheck check;                   ///< of the surface delivered
  std::int64_t self_intersections = 0;  ///< pairs of triangles of the surface delivered
  ErrorSummary expected_error;          ///< of the surface delivered; zeros for a band
  PrintableReport printable;
  bool converged = false;
  Result::Seconds seconds;
  bool stopped = false;  ///< see Result::stopped

  /// The functional's value after the last minimisation, grey value^2 mm^3.
  double energy_mm3() const;
  /// How often the mesh was adapted.
  std::int64_t adaptations() const { return static_cast<std::int64_t>(iterations.size()) - 1; }
};

/// Takes the figures of a run.
/// @param result  of mes_amis().
/// @param check   of the result's surface.
/// @throws InputError  if the surface names a missing point or a coordinate is not finite.
///
/// O(n log n) for n triangles: the function searches for self-intersections.
RunSummary summarize(const Result& result, const SurfaceCheck& check);

}  // namespace mesamis::detail::report
