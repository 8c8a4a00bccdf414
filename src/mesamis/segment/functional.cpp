// SPDX-License-Identifier: Apache-2.0
#include "mesamis/segment/functional.h"

#include "mesamis/base/parallel.h"

namespace mesamis {
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

}  // namespace

Energy energy(const P1Space& space, const AtParameters& parameters, std::span<const double> u,
              std::span<const double> v, std::span<const double> f) {
  const auto& [epsilon, eta, beta, gamma] = parameters;
  const std::vector<double>& mass = space.lumped_mass();
  // Summed by node: int P_h(w) |grad z|^2 = sum_n w_n s_n with s = gradient_squares(z).
  const std::vector<double> u_squares = space.gradient_squares(u);
  const std::vector<double> v_squares = space.gradient_squares(v);
  Energy e;
  e.fidelity = node_sum(space, [&](std::size_t n) {
    const double d = u[n] - f[n];
    return mass[n] * d * d;
  });
  e.smoothing = beta * node_sum(space, [&, h = eta](std::size_t n) {
                  return (v[n] * v[n] + h) * u_squares[n];
                });
  e.edge = gamma * node_sum(space, [&, eps = epsilon](std::size_t n) {
             const double d = v[n] - 1;
             return eps * v_squares[n] + mass[n] * d * d / (4 * eps);
           });
  return e;
}

}  // namespace mesamis
