// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/size_control.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fem/grid_mass.h"

namespace mesamis::detail::adapt {
namespace {

const Sym3& unpacked(const Sym3& m) { return m; }
Sym3 unpacked(const PackedSym3& m) { return unpack(m); }

/// Eigenpairs of packed metrics, a closed form: its error of about 1e-7 of the largest is that of
/// single precision, and a grid has many.
SymEigen eigen_of(const PackedSym3& m) {
  Eigen::Matrix3d matrix;
  matrix << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(matrix);
  SymEigen e;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto column = 2 - static_cast<Eigen::Index>(i);
    const auto v = solver.eigenvectors().col(column);
    e.values[i] = solver.eigenvalues()[column];
    e.vectors[i] = {v[0], v[1], v[2]};
  }
  return e;
}
SymEigen eigen_of(const Sym3& m) { return eigen_decompose(m); }

std::array<double, 3> eigenvalues_of(const PackedSym3& m) {
  Eigen::Matrix3d matrix;
  matrix << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(matrix, Eigen::EigenvaluesOnly);
  const auto& values = solver.eigenvalues();
  return {values[2], values[1], values[0]};
}
std::array<double, 3> eigenvalues_of(const Sym3& m) { return eigen_decompose(m).values; }

/// Are all eigenvalues surely below this? None is negative, so that none exceeds their sum. Where
/// the image is flat, often nearly everywhere, they need not be worked out.
bool asks_for_less_than(double value, const Sym3& metric) { return trace(metric) < value; }

/// Eigenvalues of all metrics, so that each trial scale costs only clamping and a product.
using Eigenvalues = std::array<float, 3>;

template <class Weight>
class ClampedComplexity {
 public:
  template <class Metric>
  ClampedComplexity(std::span<const Metric> metrics, const Weight& weights,
                    const SizeControl& control)
      : weights_(weights),
        lowest_(1 / control.h_max),
        highest_(1 / control.h_min),
        roots_(metrics.size()) {
    parallel_for(metrics.size(), [&](std::size_t n) {
      const Sym3 m = unpacked(metrics[n]);
      roots_[n] = {};
      if (asks_for_less_than(lowest_ * lowest_, m)) return;
      const std::array<double, 3> values = eigenvalues_of(metrics[n]);
      for (std::size_t i = 0; i < 3; ++i) {
        roots_[n][i] = static_cast<float>(std::sqrt(std::max(values[i], 0.0)));
      }
    });
  }

  double at(double size_factor) const {
    return parallel_sum(roots_.size(), [&](std::size_t begin, std::size_t end) {
      double sum = 0;
      for (std::size_t n = begin; n < end; ++n) {
        double density = weights_(n);
        for (const float root : roots_[n]) {
          density *= std::clamp(static_cast<double>(root) / size_factor, lowest_, highest_);
        }
        sum += density;
      }
      return sum;
    });
  }

 private:
  const Weight& weights_;
  double lowest_, highest_;  // of 1/h
  std::vector<Eigenvalues> roots_;
};

/// The factor, found by the secant method (Illinois) in the logarithms.
template <class Complexity>
double find_size_factor(const Complexity& complexity, double bound) {
  constexpr double kPrecision = 1e-10;
  const auto excess = [&](double logarithm) {
    return std::log(complexity.at(std::exp(logarithm)) / bound);
  };
  double low = 0, high = 1, at_low = excess(low);
  if (at_low <= 0) return 1;
  double at_high = excess(high);
  while (at_high > 0 && high < 60) {
    low = high, at_low = at_high;
    high *= 2;
    at_high = excess(high);
  }
  if (at_high > 0) return std::exp(high);
  bool was_low = false, was_high = false;
  for (int i = 0; i < 100 && high - low > kPrecision; ++i) {
    const double secant = (low * at_high - high * at_low) / (at_high - at_low);
    const double x = std::clamp(secant, low + kPrecision / 4, high - kPrecision / 4);
    const double at_x = excess(x);
    if (at_x > 0) {
      low = x, at_low = at_x;
      if (was_low) at_high /= 2;
    } else {
      high = x, at_high = at_x;
      if (was_high) at_low /= 2;
    }
    was_low = at_x > 0, was_high = !was_low;
  }
  return std::exp(high);
}

void require_as_many(std::size_t weights, std::size_t metrics) {
  if (weights == metrics) return;
  throw InputError("size control: " + std::to_string(weights) + " weights for " +
                   std::to_string(metrics) + " metrics");
}

/// The clamped eigenpairs of every scaled metric, handed to store(n, eigen).
/// @param weight  weight(n) of node n.
template <class Metric, class Weight, class Store>
double control(std::span<const Metric> metrics, const Weight& weight, const SizeControl& control,
               Store&& store) {
  double factor = 1;
  if (control.complexity > 0) {
    factor =
        find_size_factor(ClampedComplexity<Weight>(metrics, weight, control), control.complexity);
  }
  const double lowest = 1 / (control.h_max * control.h_max);
  const double highest = 1 / (control.h_min * control.h_min);
  parallel_for(metrics.size(), [&](std::size_t n) {
    const Sym3 m = unpacked(metrics[n]);
    if (asks_for_less_than(lowest * factor * factor, m)) {
      store(n, SymEigen{{lowest, lowest, lowest}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}});
      return;
    }
    SymEigen e = eigen_of(metrics[n]);
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
  require_as_many(weights.size(), metrics.size());
  return control(
      std::span<const Sym3>(metrics), [&](std::size_t n) { return weights[n]; }, size_control,
      [&](std::size_t n, const SymEigen& e) { metrics[n] = compose(e.values, e.vectors); });
}

std::vector<double> clamped_complexities(std::span<const Sym3> metrics,
                                         std::span<const double> weights,
                                         const SizeControl& size_control,
                                         std::span<const double> factors) {
  require_as_many(weights.size(), metrics.size());
  const auto weight = [&](std::size_t n) { return weights[n]; };
  const ClampedComplexity<decltype(weight)> complexity(metrics, weight, size_control);
  std::vector<double> found;
  for (const double factor : factors) found.push_back(complexity.at(factor));
  return found;
}

double control_sizes_to_log(const KuhnGrid& grid, std::span<PackedSym3> metrics,
                            const SizeControl& size_control) {
  require_as_many(grid.node_count(), metrics.size());
  const GridMass mass(grid);
  return control(
      std::span<const PackedSym3>(metrics), [&](std::size_t n) { return mass.at(n); }, size_control,
      [&](std::size_t n, SymEigen e) {
        for (double& value : e.values) value = std::log(value);
        metrics[n] = pack(compose(e.values, e.vectors));
      });
}

void set_complexity(const KuhnGrid& grid, std::span<PackedSym3> log_metrics, double complexity) {
  const GridMass mass(grid);
  const double present = parallel_sum(log_metrics.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t n = begin; n < end; ++n) {
      sum += mass.at(n) * std::exp(trace(unpack(log_metrics[n])) / 2);
    }
    return sum;
  });
  const auto shift = static_cast<float>(2.0 / 3 * std::log(complexity / present));
  parallel_for(log_metrics.size(), [&](std::size_t n) {
    for (const std::size_t diagonal : {0u, 3u, 5u}) log_metrics[n][diagonal] += shift;
  });
}

void scale_log_sizes(std::span<PackedSym3> log_metrics, double factor,
                     const SizeControl& size_control) {
  const double shift = -2 * std::log(factor);
  const double lowest = -2 * std::log(size_control.h_max);
  const double highest = -2 * std::log(size_control.h_min);
  constexpr double kRounding = 1e-3;
  parallel_for(log_metrics.size(), [&](std::size_t n) {
    SymEigen e = eigen_of(log_metrics[n]);
    for (double& value : e.values) {
      value = value <= lowest + kRounding ? lowest : std::clamp(value + shift, lowest, highest);
    }
    log_metrics[n] = pack(compose(e.values, e.vectors));
  });
}

}  // namespace mesamis::detail::adapt
