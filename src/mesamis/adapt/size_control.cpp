// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/size_control.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis {
namespace {

const Sym3& unpacked(const Sym3& m) { return m; }
Sym3 unpacked(const PackedSym3& m) { return unpack(m); }

/// Are all eigenvalues surely below this? None is negative, so that none exceeds their sum. Where
/// the image is flat, often nearly everywhere, they need not be worked out.
bool asks_for_less_than(double value, const Sym3& metric) { return trace(metric) < value; }

/// Eigenvalues of all metrics, so that each trial scale costs only clamping and a product.
using Eigenvalues = std::array<float, 3>;

class ClampedComplexity {
 public:
  template <class Metric>
  ClampedComplexity(std::span<const Metric> metrics, std::span<const double> weights,
                    const SizeControl& control)
      : weights_(weights),
        lowest_(1 / control.h_max),
        highest_(1 / control.h_min),
        roots_(metrics.size()) {
    parallel_for(metrics.size(), [&](std::size_t n) {
      const Sym3 m = unpacked(metrics[n]);
      roots_[n] = {};
      if (asks_for_less_than(lowest_ * lowest_, m)) return;
      const SymEigen e = eigen_decompose(m);
      for (std::size_t i = 0; i < 3; ++i) {
        roots_[n][i] = static_cast<float>(std::sqrt(std::max(e.values[i], 0.0)));
      }
    });
  }

  double at(double size_factor) const {
    return parallel_sum(roots_.size(), [&](std::size_t begin, std::size_t end) {
      double sum = 0;
      for (std::size_t n = begin; n < end; ++n) {
        double density = weights_[n];
        for (const float root : roots_[n]) {
          density *= std::clamp(static_cast<double>(root) / size_factor, lowest_, highest_);
        }
        sum += density;
      }
      return sum;
    });
  }

 private:
  std::span<const double> weights_;
  double lowest_, highest_;  // of 1/h
  std::vector<Eigenvalues> roots_;
};

double find_size_factor(const ClampedComplexity& complexity, double bound) {
  if (complexity.at(1) <= bound) return 1;
  double low = 0, high = 1;  // logarithms of the factor
  while (complexity.at(std::exp(high)) > bound && high < 60) {
    low = high;
    high *= 2;
  }
  for (int i = 0; i < 50 && high - low > 1e-10; ++i) {
    const double middle = (low + high) / 2;
    (complexity.at(std::exp(middle)) > bound ? low : high) = middle;
  }
  return std::exp(high);
}

/// The clamped eigenpairs of every scaled metric, handed to store(n, eigen).
template <class Metric, class Store>
double control(std::span<const Metric> metrics, std::span<const double> weights,
               const SizeControl& control, Store&& store) {
  if (weights.size() != metrics.size()) {
    throw InputError("size control: " + std::to_string(weights.size()) + " weights for " +
                     std::to_string(metrics.size()) + " metrics");
  }
  double factor = 1;
  if (control.complexity > 0) {
    factor = find_size_factor(ClampedComplexity(metrics, weights, control), control.complexity);
  }
  const double lowest = 1 / (control.h_max * control.h_max);
  const double highest = 1 / (control.h_min * control.h_min);
  parallel_for(metrics.size(), [&](std::size_t n) {
    const Sym3 m = unpacked(metrics[n]);
    if (asks_for_less_than(lowest * factor * factor, m)) {
      store(n, SymEigen{{lowest, lowest, lowest}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}});
      return;
    }
    SymEigen e = eigen_decompose(m);
    for (double& value : e.values) {
      value = std::clamp(value / (factor * factor), lowest, highest);
    }
    store(n, e);
  });
  return factor;
}

}  // namespace

double control_sizes(std::span<Sym3> metrics, std::span<const double> weights,
                     const SizeControl& size_control) {
  return control(
      std::span<const Sym3>(metrics), weights, size_control,
      [&](std::size_t n, const SymEigen& e) { metrics[n] = compose(e.values, e.vectors); });
}

double control_sizes_to_log(std::span<PackedSym3> metrics, std::span<const double> weights,
                            const SizeControl& size_control) {
  return control(std::span<const PackedSym3>(metrics), weights, size_control,
                 [&](std::size_t n, SymEigen e) {
                   for (double& value : e.values) value = std::log(value);
                   metrics[n] = pack(compose(e.values, e.vectors));
                 });
}

void set_complexity(std::span<PackedSym3> log_metrics, std::span<const double> weights,
                    double complexity) {
  const double present = parallel_sum(log_metrics.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t n = begin; n < end; ++n) {
      sum += weights[n] * std::exp(trace(unpack(log_metrics[n])) / 2);
    }
    return sum;
  });
  const auto shift = static_cast<float>(2.0 / 3 * std::log(complexity / present));
  parallel_for(log_metrics.size(), [&](std::size_t n) {
    for (const std::size_t diagonal : {0u, 3u, 5u}) log_metrics[n][diagonal] += shift;
  });
}

}  // namespace mesamis
