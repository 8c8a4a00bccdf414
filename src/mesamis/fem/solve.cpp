// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/solve.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/fem/multigrid.h"

namespace mesamis::detail::fem {
namespace {

using Preconditioner = std::function<void(std::span<const double>, std::span<double>)>;

double inner(std::span<const double> a, std::span<const double> b) {
  return parallel_sum(a.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += a[i] * b[i];
    return sum;
  });
}

/// sqrt(sum r_i^2 / d_i). In the plain norm the large cells of an adapted mesh, whose entries carry
/// their volume, would drown the small ones at the edges.
double weighted_norm(std::span<const double> r, std::span<const double> d) {
  return std::sqrt(parallel_sum(r.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += r[i] * r[i] / d[i];
    return sum;
  }));
}

/// Conjugate gradients from the x given; adds to report.iterations and sets the residual.
class ConjugateGradients {
 public:
  ConjugateGradients(const SpdOperator& a, std::span<const double> b, std::span<double> x)
      : a_(a), weights_(a.diagonal()), b_(b), x_(x), r_(b.size()), p_(b.size()), ap_(b.size()) {}

  void run(const Preconditioner& precondition, double goal, int max_iterations,
           SolveReport& report) {
    start(precondition);
    for (int i = 0; i < max_iterations && weighted_norm(r_, weights_) > goal; ++i) {
      if (!step(precondition)) break;
      ++report.iterations;
    }
  }

  double true_residual() {
    find_residual();
    return weighted_norm(r_, weights_);
  }

 private:
  void find_residual() {
    a_.apply(x_, ap_);
    parallel_for(b_.size(), [&](std::size_t i) { r_[i] = b_[i] - ap_[i]; });
  }

  void start(const Preconditioner& precondition) {
    find_residual();
    precondition(r_, p_);
    rz_ = inner(r_, p_);
  }

  bool step(const Preconditioner& precondition) {
    a_.apply(p_, ap_);
    const double curvature = inner(p_, ap_);
    if (!(curvature > 0)) return false;  // the direction is exhausted to round-off
    const double alpha = rz_ / curvature;
    parallel_for(b_.size(), [&](std::size_t i) {
      x_[i] += alpha * p_[i];
      r_[i] -= alpha * ap_[i];
    });
    std::vector<double>& z = ap_;  // no longer needed: on large grids every field counts
    precondition(r_, z);
    const double rz = inner(r_, z);
    const double beta = rz / rz_;
    rz_ = rz;
    parallel_for(b_.size(), [&](std::size_t i) { p_[i] = z[i] + beta * p_[i]; });
    return true;
  }

  const SpdOperator& a_;
  const std::vector<double>& weights_;
  std::span<const double> b_;
  std::span<double> x_;
  std::vector<double> r_, p_, ap_;
  double rz_ = 0;
};

}  // namespace

SolveReport solve(const SpdOperator& a, std::span<const double> b, std::span<double> x,
                  const SolveOptions& options) {
  SolveReport report;
  const double scale = weighted_norm(b, a.diagonal());
  if (scale == 0) {
    std::fill(x.begin(), x.end(), 0.0);
    report.converged = true;
    return report;
  }
  const double goal = options.tolerance * scale;
  ConjugateGradients cg(a, b, x);
  const std::vector<double>& diagonal = a.diagonal();
  auto jacobi = [&diagonal](std::span<const double> r, std::span<double> z) {
    parallel_for(r.size(), [&](std::size_t i) { z[i] = r[i] / diagonal[i]; });
  };
  cg.run(jacobi, goal, std::min(options.jacobi_iterations, options.max_iterations), report);
  if (cg.true_residual() > goal && report.iterations < options.max_iterations) {
    const Multigrid multigrid(a);
    cg.run([&](auto r, auto z) { multigrid.apply(r, z); }, goal,
           options.max_iterations - report.iterations, report);
  }
  report.residual = cg.true_residual() / scale;
  report.converged = report.residual <= 2 * options.tolerance;
  return report;
}

}  // namespace mesamis::detail::fem
