// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/functional.h"

#include <cmath>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::fem {
namespace {

/// sum of weight(n) over the nodes
template <class Weight>
double node_sum(const P1Space& space, Weight&& weight) {
  return parallel_sum(space.node_count(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t n = begin; n < end; ++n) sum += weight(n);
    return sum;
  });
}

void require_positive(const char* name, double value) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw InputError(std::string(name) + ": expected a finite number above 0, found " +
                     std::to_string(value));
  }
}

}  // namespace

void require_valid(const AtParameters& parameters) {
  require_positive("epsilon", parameters.epsilon);
  require_positive("eta", parameters.eta);
  require_positive("beta", parameters.beta);
  require_positive("gamma", parameters.gamma);
}

Energy energy(const P1Space& space, const AtParameters& parameters, const AtFields& fields) {
  const auto& [epsilon, eta, beta, gamma] = parameters;
  const auto [u, v, f] = fields;
  const std::vector<double>& mass = space.lumped_mass();
  // Summed by node: int P_h(w) |grad z|^2 = sum_n w_n s_n with s = gradient_squares(z).
  const std::vector<double> u_squares = space.gradient_squares(u);
  const std::vector<double> v_squares = space.gradient_squares(v);
  Energy e;
  e.fidelity = node_sum(space, [&, u = u, f = f](std::size_t n) {
    const double d = u[n] - f[n];
    return mass[n] * d * d;
  });
  e.smoothing = beta * node_sum(space, [&, v = v, h = eta](std::size_t n) {
                  return (v[n] * v[n] + h) * u_squares[n];
                });
  e.edge = gamma * node_sum(space, [&, v = v, eps = epsilon](std::size_t n) {
             const double d = v[n] - 1;
             return eps * v_squares[n] + mass[n] * d * d / (4 * eps);
           });
  return e;
}

}  // namespace mesamis::detail::fem
