// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/surface/grid_partition.h"
#include "mesamis/surface/smooth_memberships.h"

namespace mesamis::detail::labels {

/// How labels flow to the edges of an image.
struct FlowOptions {
  double beta = 2;          ///< weight of smoothness, as in the functional (2), units squared, > 0
  double eta = 1e-6;        ///< conductance that an edge leaves, as there, >= 0
  double unit_mm = 1;       ///< the length unit of beta, mm, > 0
  double reach = 5;         ///< mm, > 0: a label goes no further than this over the shortest
                            ///< spacing, in steps along the axes, from its own voxels; twice the
                            ///< margin of label_confidence() is enough
  double tolerance = 1e-3;  ///< relative residual of each solve, 0 to 1
};

/// How the systems of the flow were solved.
struct FlowReport {
  int solver_iterations = 0;     ///< conjugate gradient steps, in all
  double solver_residual = 0;    ///< largest relative residual of any solve
  bool solver_converged = true;  ///< every solve reached the tolerance
};

/// What labels flow on: one value per node each.
struct FlowFields {
  const GridMemberships& smooth;  ///< l: smooth_memberships() of the labels. Where they are certain
                                  ///< it places the boundary, without staircases
  std::span<const float> weight;  ///< c of label_confidence(), > 0
  std::span<const float> edges;   ///< v, 0 to 1
};

/// Lets labels flow to the nearest edges of an image, and stop there.
///
/// For each label k the membership p is the least of
///   sum over the nodes of c (p - l)^2  +  integral of beta (v^2 + eta) |grad p|^2,
/// with the membership l of smooth_memberships() and the weights c of label_confidence():
/// the functional (2) for u with labels instead of grey values. Its matrix is the same for all
/// labels, an M-matrix (see GridSpace), so that memberships are between 0 and 1. Where an edge lies
/// within the margin, v is small and the membership jumps there; where none does, it falls to one
/// half at the labels' border.
///
/// The label 0 is what the others leave. Memberships are looked for where c is less than certain
/// and the label is within reach: connected through such nodes, no more than so many steps away.
/// @param grid    labels at the nodes, mm.
/// @param fields  see there.
/// @param report  optional; overwritten. Reaching an iteration limit is no error: it says so.
/// @return a material per label that occurs, in increasing order, 0 among them even where it does
///         not occur.
/// @throws InputError  if the sizes do not fit or an option is out of range.
///
/// O(nodes * iterations) over the nodes near the labels' borders. The same bits for any number of
/// threads.
GridMemberships flow_memberships(const LabelGrid& grid, const FlowFields& fields,
                                 const FlowOptions& options, FlowReport* report = nullptr);

}  // namespace mesamis::detail::labels
