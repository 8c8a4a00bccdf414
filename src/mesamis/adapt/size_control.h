// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/base/sym3.h"

namespace mesamis {

/// How sizes are brought within bounds.
struct SizeControl {
  double h_min = 0;       ///< smallest edge length, mesh unit
  double h_max = 1e300;   ///< largest edge length, mesh unit
  double complexity = 0;  ///< largest integral of sqrt(det M) over the domain; 0: no bound
};

/// Scales nodal metrics (12) until, after clamping their sizes to [h_min, h_max], the integral
/// of sqrt(det M) is within the bound, and clamps them. The scale acts on all nodes alike and
/// never refines; it is found by bisection, for clamping makes the complexity a nonlinear
/// function of it.
///
/// @param metrics  in: symmetric positive semidefinite, may be zero; out: positive definite.
/// @param weights  each node's share of the domain's volume (lumped mass).
/// @return the factor all sizes were multiplied with before clamping, >= 1.
double control_sizes(std::span<Sym3> metrics, std::span<const double> weights,
                     const SizeControl& control);

/// The same for packed metrics, which are replaced by the logarithms of the result: what
/// GridMetricField wants.
double control_sizes_to_log(std::span<PackedSym3> metrics, std::span<const double> weights,
                            const SizeControl& control);

/// Multiplies all sizes of logarithmic metrics by one factor, so that their complexity (see
/// SizeControl) becomes the one asked for. Averaging logarithms lowers it.
void set_complexity(std::span<PackedSym3> log_metrics, std::span<const double> weights,
                    double complexity);

}  // namespace mesamis
