// SPDX-License-Identifier: Apache-2.0
#include "verdict.h"

#include "commands.h"
#include "report.h"

namespace mesamis {
namespace {

std::string why_not_converged(const Result& result) {
  const auto& passes = result.iterations;
  for (const Iteration& pass : passes) {
    if (!pass.amis.solver_converged) {
      return "not converged: a linear solve ended with a relative residual of " +
             std::to_string(pass.amis.solver_residual) + ", expected " +
             std::to_string(pass.amis.solver_tolerance);
    }
  }
  if (result.settings.adaptations == 1) {
    return "not converged: one adaptation cannot show that anything has settled, expected 2 or "
           "more";
  }
  const Iteration& last = passes[passes.size() - 2];
  return "not converged: after " + std::to_string(result.settings.adaptations) +
         " adaptations the cell count changed by " + std::to_string(last.mesh_change) +
         " and the energy by " + std::to_string(last.energy_change) + ", expected at most " +
         std::to_string(result.settings.tol_mesh) + " and " +
         std::to_string(result.settings.tol_energy);
}

}  // namespace

Verdict judge(const Result& result, const SurfaceCheck& check) {
  const bool solid = result.settings.surface == SurfaceKind::kSolid;
  const bool encloses = solid && !result.surface.triangles.empty();
  const std::string flaws = encloses ? solid_flaws_of(check) : flaws_of(check);
  if (!flaws.empty()) {
    return {kExitNotClosed,
            "expected a closed 2-manifold surface that faces outward, found " + flaws};
  }
  const auto& tolerance = result.settings.tolerance;
  if (solid && tolerance && !result.printable.within(*tolerance)) {
    return {kExitNotConverged, tolerance_unmet(*tolerance, result.printable)};
  }
  if (!result.converged) return {kExitNotConverged, why_not_converged(result)};
  return {};
}

}  // namespace mesamis
