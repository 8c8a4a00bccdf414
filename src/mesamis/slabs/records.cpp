// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/records.h"

#include <algorithm>

namespace mesamis::detail::slabs {
namespace {

void add(AmisReport& sum, const AmisReport& other) {
  sum.iterations = std::max(sum.iterations, other.iterations);
  sum.v_change = std::max(sum.v_change, other.v_change);
  sum.converged &= other.converged;
  sum.clamped += other.clamped;
  sum.solver_iterations = std::max(sum.solver_iterations, other.solver_iterations);
  sum.solver_residual = std::max(sum.solver_residual, other.solver_residual);
  sum.solver_converged &= other.solver_converged;
}

void add(Iteration::Seconds& sum, const Iteration::Seconds& other) {
  sum.project += other.project;
  sum.amis += other.amis;
  sum.estimate += other.estimate;
  sum.remesh += other.remesh;
  sum.transfer += other.transfer;
}

}  // namespace

Iteration sum_of_records(const std::vector<Iteration>& slabs) {
  Iteration sum;
  sum.amis = slabs.front().amis;
  for (std::size_t s = 0; s < slabs.size(); ++s) {
    const Iteration& slab = slabs[s];
    const auto weight = static_cast<double>(slab.tets);
    sum.tets += slab.tets;
    sum.nodes += slab.nodes;
    sum.energy.fidelity += slab.energy.fidelity;
    sum.energy.smoothing += slab.energy.smoothing;
    sum.energy.edge += slab.energy.edge;
    sum.surface_change += weight * slab.surface_change;
    sum.surface_tolerance += weight * slab.surface_tolerance;
    sum.estimator += slab.estimator;
    sum.predicted_tets += slab.predicted_tets;
    if (s > 0) add(sum.amis, slab.amis);
    add(sum.seconds, slab.seconds);
    for (std::size_t a = 0; a < 3; ++a) {
      sum.aspect_max[a] = std::max(sum.aspect_max[a], slab.aspect_max[a]);
      sum.aspect_mean[a] += weight * slab.aspect_mean[a];
    }
  }
  const auto all = static_cast<double>(std::max<std::int64_t>(1, sum.tets));
  for (double& mean : sum.aspect_mean) mean /= all;
  sum.surface_change /= all;
  sum.surface_tolerance /= all;
  return sum;
}

}  // namespace mesamis::detail::slabs
