// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/amis.h"

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fem/alternation.h"

namespace mesamis::detail::fem {
namespace {

/// The two linear steps, each from and into the current fields.
class Alternation {
 public:
  Alternation(const P1Space& space, std::span<const double> f, const AmisOptions& options,
              AmisResult& result)
      : space_(space), f_(f), options_(options), result_(result) {}

  void step_u() {
    const auto& [epsilon, eta, beta, gamma] = options_.parameters;
    const std::vector<double>& mass = space_.lumped_mass();
    std::vector<double> work(result_.v.size());
    parallel_for(work.size(), [&](std::size_t n) { work[n] = result_.v[n] * result_.v[n]; });
    const auto system = space_.diffusion(work, beta, beta * eta, mass);
    parallel_for(work.size(), [&](std::size_t n) { work[n] = mass[n] * f_[n]; });
    record(solve(*system, work, result_.u, options_.solver), result_.report);
    finish_half_step();
  }

  void step_v() {
    const auto& [epsilon, eta, beta, gamma] = options_.parameters;
    const double well = gamma / (4 * epsilon);
    const std::vector<double>& mass = space_.lumped_mass();
    std::vector<double> diagonal = space_.gradient_squares(result_.u);
    parallel_for(diagonal.size(), [&, weight = beta](std::size_t n) {
      diagonal[n] = weight * diagonal[n] + well * mass[n];
    });
    const auto system = space_.diffusion({}, 0, gamma * epsilon, std::move(diagonal));
    std::vector<double> right(mass);
    parallel_for(right.size(), [&](std::size_t n) { right[n] *= well; });
    record(solve(*system, right, result_.v, options_.solver), result_.report);
    result_.report.clamped += clamp_v(result_.v, options_.solver.tolerance);
    finish_half_step();
  }

 private:
  void finish_half_step() {
    if (options_.after_half_step) options_.after_half_step(result_.u, result_.v);
  }

  const P1Space& space_;
  std::span<const double> f_;
  const AmisOptions& options_;
  AmisResult& result_;
};

}  // namespace

AmisResult run_amis(const P1Space& space, std::span<const double> f, AmisStart start,
                    const AmisOptions& options) {
  const std::size_t nodes = space.node_count();
  require_valid(options.parameters);
  require_size("f", f.size(), nodes);
  if (start.v.empty()) start.v.assign(nodes, 1);
  require_size("v0", start.v.size(), nodes);
  if (start.u.empty()) start.u = f;
  require_size("u0", start.u.size(), nodes);
  if (options.max_iterations < 1) throw InputError("amis iterations: expected 1 or more");

  AmisResult result{{start.u.begin(), start.u.end()}, std::move(start.v), {}};
  AmisReport& report = result.report;
  report.solver_tolerance = options.solver.tolerance;
  Alternation alternation(space, f, options, result);
  while (report.iterations < options.max_iterations && !report.converged) {
    alternation.step_u();
    const std::vector<double> v_before = result.v;
    alternation.step_v();
    report.v_change = largest_change(result.v, v_before);
    report.converged = report.v_change <= options.v_tolerance;
    ++report.iterations;
  }
  return result;
}

}  // namespace mesamis::detail::fem
