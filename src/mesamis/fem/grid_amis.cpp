// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/grid_amis.h"

#include "mesamis/base/parallel.h"
#include "mesamis/fem/alternation.h"
#include "mesamis/fem/single_grid_system.h"

namespace mesamis::detail::fem {
namespace {

/// The two linear steps, each from and into the current fields.
class GridAlternation {
 public:
  GridAlternation(const KuhnGrid& grid, std::span<const float> f, const AmisOptions& options,
                  GridMinimum& minimum)
      : grid_(grid), f_(f), options_(options), minimum_(minimum), masses_(grid), system_(grid) {}

  void step_u() {
    const auto& [epsilon, eta, beta, gamma] = options_.parameters;
    for_each_node([&](std::size_t n, double mass) {
      system_.diagonal()[n] = static_cast<float>(mass);
      system_.right()[n] = static_cast<float>(mass) * f_[n];
    });
    system_.couple(minimum_.v, beta, beta * eta);
    record(system_.solve(minimum_.u, options_.solver), minimum_.report);
  }

  /// @return the largest change of v.
  double step_v() {
    const auto& [epsilon, eta, beta, gamma] = options_.parameters;
    const auto well = static_cast<float>(gamma / (4 * epsilon)), weight = static_cast<float>(beta);
    std::vector<float>& diagonal = system_.diagonal();
    find_gradient_squares(grid_, minimum_.u, diagonal);
    for_each_node([&](std::size_t n, double mass) {
      system_.right()[n] = well * static_cast<float>(mass);
      diagonal[n] = weight * diagonal[n] + system_.right()[n];
    });
    system_.couple({}, 0, gamma * epsilon);
    const std::vector<float> before = minimum_.v;
    record(system_.solve(minimum_.v, options_.solver), minimum_.report);
    minimum_.report.clamped += clamp_v(minimum_.v, options_.solver.tolerance);
    return largest_change(minimum_.v, before);
  }

  /// The functional of the present fields; the system's diagonal is lost.
  Energy energy() {
    const auto& [epsilon, eta, beta, gamma] = options_.parameters;
    const std::vector<float>&u = minimum_.u, &v = minimum_.v;
    std::vector<float>& squares = system_.diagonal();
    Energy e;
    find_gradient_squares(grid_, u, squares);
    e.fidelity = sum_over_nodes(grid_, masses_, [&](std::size_t n, double mass) {
      const double d = double{u[n]} - double{f_[n]};
      return mass * d * d;
    });
    e.smoothing = beta * sum_over_nodes(grid_, masses_, [&, h = eta](std::size_t n, double) {
                    return (double{v[n]} * double{v[n]} + h) * double{squares[n]};
                  });
    find_gradient_squares(grid_, v, squares);
    e.edge = gamma * sum_over_nodes(grid_, masses_, [&, eps = epsilon](std::size_t n, double mass) {
               const double d = double{v[n]} - 1;
               return eps * double{squares[n]} + mass * d * d / (4 * eps);
             });
    return e;
  }

 private:
  template <class Body>
  void for_each_node(Body&& body) const {
    parallel_for_each(static_cast<std::size_t>(grid_.size[2]), [&](std::size_t k) {
      std::size_t n = k * grid_.stride()[2];
      for (Index j = 0; j < grid_.size[1]; ++j) {
        const GridMass::Row row = masses_.row(j, static_cast<Index>(k));
        for (Index i = 0; i < grid_.size[0]; ++i, ++n) body(n, row.at(i));
      }
    });
  }

  const KuhnGrid& grid_;
  std::span<const float> f_;
  const AmisOptions& options_;
  GridMinimum& minimum_;
  GridMass masses_;
  SingleGridSystem system_;
};

GridMinimum run_in_single(const KuhnGrid& grid, std::span<const float> f,
                          const AmisOptions& options) {
  GridMinimum minimum{{f.begin(), f.end()}, std::vector<float>(f.size(), 1), {}, {}};
  AmisReport& report = minimum.report;
  report.solver_tolerance = options.solver.tolerance;
  GridAlternation alternation(grid, f, options, minimum);
  while (report.iterations < options.max_iterations && !report.converged) {
    alternation.step_u();
    if (!report.solver_converged) return minimum;
    report.v_change = alternation.step_v();
    if (!report.solver_converged) return minimum;
    report.converged = report.v_change <= options.v_tolerance;
    ++report.iterations;
  }
  minimum.energy = alternation.energy();
  return minimum;
}

GridMinimum run_in_double(const KuhnGrid& grid, std::span<const float> f,
                          const AmisOptions& options) {
  const GridSpace space(grid);
  const std::vector<double> exact(f.begin(), f.end());
  const AmisResult found = run_amis(space, exact, {}, options);
  return {{found.u.begin(), found.u.end()},
          {found.v.begin(), found.v.end()},
          found.report,
          energy(space, options.parameters, {found.u, found.v, exact})};
}

}  // namespace

GridMinimum run_amis_on_grid(const KuhnGrid& grid, std::span<const float> f,
                             const AmisOptions& options) {
  require_valid(options.parameters);
  require_size("f", f.size(), grid.node_count());
  if (options.solver.tolerance >= kLeastSingleTolerance && !options.after_half_step &&
      options.max_iterations > 0) {
    GridMinimum minimum = run_in_single(grid, f, options);
    if (minimum.report.solver_converged) return minimum;
  }
  return run_in_double(grid, f, options);
}

}  // namespace mesamis::detail::fem
