// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/base/sym3.h"
#include "mesamis/fem/grid_space.h"

namespace mesamis::detail::adapt {

/// Bounds of the sizes and of their complexity.
struct SizeControl {
  double h_min = 0.5;     ///< smallest edge length, mesh unit, > 0
  double h_max = 1e300;   ///< largest edge length, mesh unit, >= h_min; default: no bound
  double complexity = 0;  ///< largest integral of sqrt(det M) over the domain; 0: no bound
};

/// Scales nodal metrics (12) until, after clamping their sizes to [h_min, h_max], the integral
/// of sqrt(det M) is within the bound, and clamps them. The scale acts on all nodes alike and
/// never refines; it is searched for, for clamping makes the complexity a nonlinear
/// function of it.
///
/// @param metrics  in: n symmetric positive semidefinite matrices, may be zero, in 1 / u^2 for the
///                 unit of length u of the mesh; out: positive definite.
/// @param weights  n, each node's share of the domain's volume (lumped mass), u^3.
/// @return the factor all sizes were multiplied with before clamping, >= 1; no unit.
/// @throws InputError  if the numbers of metrics and weights differ.
///
/// O(n) per step of the search, about ten; three single precision numbers per node.
double control_sizes(std::span<Sym3> metrics, std::span<const double> weights,
                     const SizeControl& control);

/// The complexity (see SizeControl) that metrics have after all sizes are multiplied by a factor
/// and clamped: what control_sizes() searches in, for metrics of which no single memory holds all.
/// The complexities of parts add up.
/// @param metrics  n symmetric positive semidefinite matrices, in 1 / u^2.
/// @param weights  n, each node's share of the volume, u^3.
/// @param control  bounds of the sizes; its complexity does not count.
/// @param factors  >= 1.
/// @return one per factor, no unit.
/// @throws InputError  if the numbers of metrics and weights differ.
///
/// O(n) per factor. The same bits for any number of threads.
std::vector<double> clamped_complexities(std::span<const Sym3> metrics,
                                         std::span<const double> weights,
                                         const SizeControl& control,
                                         std::span<const double> factors);

/// Scales and clamps packed metrics of a grid's nodes as control_sizes() does, and replaces them by
/// the logarithms of the result, as GridMetricField expects them.
/// @param grid     n nodes, whose lumped masses are the weights.
/// @param metrics  as for control_sizes().
/// @return the factor of control_sizes(), >= 1; no unit.
/// @throws InputError  if the numbers of metrics and nodes differ.
///
/// O(n) as control_sizes().
double control_sizes_to_log(const KuhnGrid& grid, std::span<PackedSym3> metrics,
                            const SizeControl& control);

/// Multiplies all sizes of a grid's logarithmic metrics by one factor, so that their complexity
/// (see SizeControl) becomes the given one. Averaging logarithms lowers it.
/// @param grid         n nodes.
/// @param log_metrics  logarithms of n metrics in 1 / u^2 for the unit of length u of the grid;
///                     changed in place.
/// @param complexity   > 0, no unit.
///
/// The same bits for any number of threads.
void set_complexity(const KuhnGrid& grid, std::span<PackedSym3> log_metrics, double complexity);

/// Multiplies all sizes of logarithmic metrics by a factor, and clamps them. Those that are at
/// h_max stay: nothing finer was asked for there.
/// @param log_metrics  logarithms of n metrics in 1 / u^2; changed in place.
/// @param factor       > 0, no unit.
/// @param size_control  bounds of the sizes, u; its complexity does not count.
///
/// The same bits for any number of threads.
void scale_log_sizes(std::span<PackedSym3> log_metrics, double factor,
                     const SizeControl& size_control);

}  // namespace mesamis::detail::adapt
