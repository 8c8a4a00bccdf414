// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/verdict.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mesamis/method/expected_error.h"

namespace mesamis::detail::report {
namespace {

std::string why_stopped(const Result& result) {
  const std::string when = "not converged: stopped by the time limit ";
  if (result.parameters.preview) return when + "before the first mesh; the surface is a preview";
  return when + "after " + std::to_string(result.iterations.size() - 1) + " of at most " +
         std::to_string(result.parameters.adaptations) + " adaptations";
}

std::string why_not_converged(const Result& result) {
  const auto& passes = result.iterations;
  for (const Iteration& pass : passes) {
    if (!pass.amis.solver_converged) {
      return "not converged: a linear solve ended with a relative residual of " +
             std::to_string(pass.amis.solver_residual) + ", expected " +
             std::to_string(pass.amis.solver_tolerance);
    }
  }
  if (result.stopped) return why_stopped(result);
  if (result.parameters.adaptations == 1) {
    return "not converged: one adaptation cannot show that anything has settled, expected 2 or "
           "more";
  }
  const Parameters& p = result.parameters;
  const Iteration& last = passes[passes.size() - 2];
  const std::string when =
      "not converged: after " + std::to_string(p.adaptations) + " adaptations ";
  if (p.until == StopRule::kSurface && p.surface == SurfaceKind::kSolid) {
    return when + "a mesh still moved the surface by " + std::to_string(last.surface_change) +
           " mm, expected at most " + std::to_string(last.surface_tolerance) + " mm";
  }
  return when + "the cell count changed by " + std::to_string(last.mesh_change) +
         " and the energy by " + std::to_string(last.energy_change) + ", expected at most " +
         std::to_string(p.tol_mesh) + " and " + std::to_string(p.tol_energy);
}

}  // namespace

Verdict judge(const Result& result, const SurfaceCheck& check) {
  const Parameters& p = result.parameters;
  const bool solid = p.surface == SurfaceKind::kSolid;
  const bool encloses = solid && !result.surface.triangles.empty();
  const std::string flaws = encloses ? solid_flaws_of(check) : flaws_of(check);
  if (!flaws.empty()) {
    return {VerdictKind::kNotClosed,
            "expected a closed 2-manifold surface that faces outward, found " + flaws};
  }
  if (solid && !result.printable.within(p.tolerance.value())) {
    return {VerdictKind::kNotConverged, tolerance_unmet(*p.tolerance, result.printable)};
  }
  if (!result.converged) return {VerdictKind::kNotConverged, why_not_converged(result)};
  if (!solid) return {};
  const std::string inaccurate = accuracy_unmet(p.accuracy, result.surface, result.expected_error);
  if (!inaccurate.empty()) return {VerdictKind::kNotConverged, inaccurate};
  return {};
}

void add_unmet(Verdict& verdict, const std::string& missed) {
  if (missed.empty()) return;
  verdict.kind = std::max(verdict.kind, VerdictKind::kNotConverged);
  verdict.message += (verdict.message.empty() ? "" : "; ") + missed;
}

std::string accuracy_unmet(double accuracy, const TriMesh& surface,
                           const std::vector<double>& expected_error) {
  if (accuracy == 0 || surface.triangles.empty()) return {};
  std::ostringstream line;
  line << "accuracy: expected " << accuracy << " mm in the mean at most, found ";
  const ErrorSummary expected =
      expected_error.empty() ? ErrorSummary{} : summarize_error(surface, expected_error);
  if (!expected.is_known()) return line.str() + "an error that is not known";
  if (expected.mean <= accuracy) return {};
  line << expected.mean << " mm to expect";
  return line.str();
}

std::string tolerance_unmet(double tolerance, const PrintableReport& printable) {
  std::ostringstream line;
  line << "tolerance: expected distances of " << tolerance << " mm at most, found "
       << printable.extracted_to_result << " and " << printable.result_to_extracted
       << ": single precision is too coarse so far from the origin";
  return line.str();
}

std::string triangles_unmet(std::int64_t asked, std::int64_t found, double tolerance) {
  if (asked == 0 || found <= asked) return {};
  std::ostringstream line;
  line << "triangles: expected " << asked << " at most, found " << found << ": ";
  if (std::isinf(tolerance)) {
    line << "with fewer, triangles would intersect or parts be lost";
  } else {
    line << "the tolerance of " << tolerance << " mm was reached first";
  }
  return line.str();
}

}  // namespace mesamis::detail::report
