// SPDX-License-Identifier: Apache-2.0
#include "mesamis/segment/amis.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis {
namespace {

void require_size(const char* name, std::size_t found, std::size_t expected) {
  if (found != expected) {
    throw InputError(std::string("amis: ") + name + " has " + std::to_string(found) +
                     " values for " + std::to_string(expected) + " nodes");
  }
}

double largest_change(std::span<const double> a, std::span<const double> b) {
  return parallel_max(a.size(), 0, [&](std::size_t begin, std::size_t end) {
    double largest = 0;
    for (std::size_t n = begin; n < end; ++n) largest = std::max(largest, std::abs(a[n] - b[n]));
    return largest;
  });
}

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
    solve_into(*system, work, result_.u);
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
    solve_into(*system, right, result_.v);
    clamp_v();
    finish_half_step();
  }

 private:
  void solve_into(const SpdOperator& system, std::span<const double> right,
                  std::span<double> solution) {
    const SolveReport solved = solve(system, right, solution, options_.solver);
    result_.report.solver_iterations += solved.iterations;
    result_.report.solver_residual = std::max(result_.report.solver_residual, solved.residual);
    result_.report.solver_converged &= solved.converged;
  }

  /// Prop. 2.1 holds on Kuhn grids; obtuse cells can break it by a little. What is within the
  /// solver's accuracy of the interval is not counted.
  void clamp_v() {
    const double slack = 10 * options_.solver.tolerance;
    for (double& value : result_.v) {
      result_.report.clamped += value < -slack || value > 1 + slack;
      value = std::clamp(value, 0.0, 1.0);
    }
  }

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

}  // namespace mesamis
