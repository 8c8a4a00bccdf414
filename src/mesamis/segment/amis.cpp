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

void require_positive(const char* name, double value) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw InputError(std::string(name) + ": expected a finite number above 0, found " +
                     std::to_string(value));
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
  Alternation(const P1Space& space, std::span<const double> f, AmisFields& fields,
              const AmisOptions& options, AmisReport& report)
      : space_(space), f_(f), fields_(fields), options_(options), report_(report) {}

  void step_u() {
    const auto& [epsilon, eta, beta, gamma] = options_.parameters;
    const std::vector<double>& mass = space_.lumped_mass();
    std::vector<double> work(fields_.v.size());
    parallel_for(work.size(), [&](std::size_t n) { work[n] = fields_.v[n] * fields_.v[n]; });
    const auto system = space_.diffusion(work, beta, beta * eta, mass);
    parallel_for(work.size(), [&](std::size_t n) { work[n] = mass[n] * f_[n]; });
    solve_into(*system, work, fields_.u);
    finish_half_step();
  }

  void step_v() {
    const auto& [epsilon, eta, beta, gamma] = options_.parameters;
    const double well = gamma / (4 * epsilon);
    const std::vector<double>& mass = space_.lumped_mass();
    std::vector<double> diagonal = space_.gradient_squares(fields_.u);
    parallel_for(diagonal.size(), [&, weight = beta](std::size_t n) {
      diagonal[n] = weight * diagonal[n] + well * mass[n];
    });
    const auto system = space_.diffusion({}, 0, gamma * epsilon, std::move(diagonal));
    std::vector<double> right(mass);
    parallel_for(right.size(), [&](std::size_t n) { right[n] *= well; });
    solve_into(*system, right, fields_.v);
    clamp_v();
    finish_half_step();
  }

 private:
  void solve_into(const SpdOperator& system, std::span<const double> right,
                  std::span<double> solution) {
    const SolveReport solved = solve(system, right, solution, options_.solver);
    report_.solver_iterations += solved.iterations;
    report_.solver_residual = std::max(report_.solver_residual, solved.residual);
    report_.solver_converged &= solved.converged;
  }

  /// Prop. 2.1 holds on Kuhn grids; obtuse cells can break it by a little. What is within the
  /// solver's accuracy of the interval is not counted.
  void clamp_v() {
    const double slack = 10 * options_.solver.tolerance;
    for (double& value : fields_.v) {
      report_.clamped += value < -slack || value > 1 + slack;
      value = std::clamp(value, 0.0, 1.0);
    }
  }

  void finish_half_step() {
    if (options_.after_half_step) options_.after_half_step(fields_.u, fields_.v);
  }

  const P1Space& space_;
  std::span<const double> f_;
  AmisFields& fields_;
  const AmisOptions& options_;
  AmisReport& report_;
};

}  // namespace

void require_valid(const AtParameters& parameters) {
  require_positive("epsilon", parameters.epsilon);
  require_positive("eta", parameters.eta);
  require_positive("beta", parameters.beta);
  require_positive("gamma", parameters.gamma);
}

AmisFields run_amis(const P1Space& space, std::span<const double> f, std::vector<double> v0,
                    std::span<const double> u0, const AmisOptions& options, AmisReport* report) {
  require_valid(options.parameters);
  require_size("f", f.size(), space.node_count());
  require_size("v0", v0.size(), space.node_count());
  if (!u0.empty()) require_size("u0", u0.size(), space.node_count());
  if (options.max_iterations < 1) throw InputError("amis iterations: expected 1 or more");

  const std::span<const double> first = u0.empty() ? f : u0;
  AmisFields fields{{first.begin(), first.end()}, std::move(v0)};
  AmisReport own;
  AmisReport& r = report ? *report : own;
  r = {};
  r.solver_tolerance = options.solver.tolerance;
  Alternation alternation(space, f, fields, options, r);
  while (r.iterations < options.max_iterations && !r.converged) {
    alternation.step_u();
    const std::vector<double> v_before = fields.v;
    alternation.step_v();
    r.v_change = largest_change(fields.v, v_before);
    r.converged = r.v_change <= options.v_tolerance;
    ++r.iterations;
  }
  return fields;
}

}  // namespace mesamis
