// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "mesamis/fem/amis.h"

namespace mesamis::detail::method {

/// One pass of Algorithm 2: minimise on a mesh, estimate, adapt.
struct Iteration {
  std::int64_t tets = 0, nodes = 0;  ///< of the mesh minimised on
  Energy energy;                     ///< after the minimisation
  double energy_change = 0;          ///< Ei: relative, against the pass before; 0 in the first
  double mesh_change = 0;            ///< Em: relative change of the cell count by adapting
  bool bounded = false;              ///< max_tets acted on the metric of this pass
  /// By how much the minimisation moved the solid's level set from where the mesh before had it,
  /// in the mean, and by how much it may when the loop ends (Settings::until), mm; 0 in the first
  /// and for a band.
  double surface_change = 0, surface_tolerance = 0;
  /// Whether the movement of the level set was measured.
  bool has_surface() const noexcept { return surface_tolerance > 0; }
  AmisReport amis;
  double estimator = 0;                               ///< zeta, the sum over the cells
  double predicted_tets = 0;                          ///< (11) for tau, before max_tets acts
  std::array<double, 3> aspect_max{}, aspect_mean{};  ///< s1, s2, s3 of (6)
  struct Seconds {
    double project = 0, amis = 0, estimate = 0, remesh = 0, transfer = 0;
  } seconds;
};

}  // namespace mesamis::detail::method
