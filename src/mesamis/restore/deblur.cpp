// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/deblur.h"

#include <numbers>
#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::restore {
namespace {

/// Of the symbol of the fourth-order second difference, k^2 + O(k^6).
constexpr double kLargestSymbol = 16.0 / 3;
/// What the polynomial may leave out, against a contrast of 1.
constexpr double kPrecision = 1e-4;

double filter_at(double lambda, double regularization) {
  const double g = std::exp(-lambda / 2);
  return g / (g * g + regularization * lambda * lambda);
}

/// Coefficients of W in Chebyshev polynomials on [0, end], as many as the precision asks for.
std::vector<double> chebyshev_coefficients(double end, double regularization) {
  constexpr std::size_t kNodes = 256;
  std::vector<double> values(kNodes), coefficients(kNodes);
  const auto angle = [](std::size_t n) {
    return std::numbers::pi * (static_cast<double>(n) + 0.5) / static_cast<double>(kNodes);
  };
  for (std::size_t n = 0; n < kNodes; ++n) {
    values[n] = filter_at(end / 2 * (1 + std::cos(angle(n))), regularization);
  }
  for (std::size_t m = 0; m < kNodes; ++m) {
    for (std::size_t n = 0; n < kNodes; ++n) {
      coefficients[m] += 2.0 / static_cast<double>(kNodes) * values[n] *
                         std::cos(static_cast<double>(m) * angle(n));
    }
  }
  coefficients[0] /= 2;
  double left_out = 0;
  while (coefficients.size() > 2) {
    left_out += std::abs(coefficients.back());
    if (left_out > kPrecision) break;
    coefficients.pop_back();
  }
  return coefficients;
}

/// Five rows across a direction, the middle one at [2]; beyond the border its mirror image.
using Rows = std::array<const float*, 5>;

std::size_t mirrored(std::ptrdiff_t n, std::size_t count) {
  const auto last = static_cast<std::ptrdiff_t>(count) - 1;
  if (n < 0) n = -1 - n;
  if (n > last) n = 2 * last + 1 - n;
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(n, 0, last));
}

/// The factors of a step of the recurrence, and of its result in the sum.
struct Factors {
  float a, b, c, in_sum;
};

/// next = a x + b Lambda x + c next, where Lambda is the weighted sum of (negative) fourth-order
/// second differences; sum += in_sum next.
class Recurrence {
 public:
  Recurrence(const VoxelGrid& shape, const std::array<double, 3>& weights)
      : nx_(static_cast<std::size_t>(shape.size[0])),
        ny_(static_cast<std::size_t>(shape.size[1])),
        nz_(static_cast<std::size_t>(shape.size[2])) {
    for (std::size_t a = 0; a < 3; ++a) weight_[a] = static_cast<float>(weights[a] / 12);
  }

  void step(const std::vector<float>& x, const Factors& factors, std::vector<float>& next,
            std::vector<float>& sum) const {
    parallel_for_each(nz_, [&](std::size_t k) {
      std::vector<float> line(nx_ + 4);
      for (std::size_t j = 0; j < ny_; ++j) {
        Rows across_y{}, across_z{};
        for (std::ptrdiff_t d = -2; d <= 2; ++d) {
          const auto at = static_cast<std::size_t>(d + 2);
          across_y[at] = row(x, mirrored(static_cast<std::ptrdiff_t>(j) + d, ny_), k);
          across_z[at] = row(x, j, mirrored(static_cast<std::ptrdiff_t>(k) + d, nz_));
        }
        fill_line(across_y[2], line);
        const std::size_t place = (k * ny_ + j) * nx_;
        combine({line.data() + 2, across_y, across_z}, factors, next.data() + place,
                sum.data() + place);
      }
    });
  }

 private:
  /// A line along x with two more samples at each end, and the rows beside it.
  struct Lines {
    const float* x;
    const Rows &y, &z;
  };

  const float* row(const std::vector<float>& x, std::size_t j, std::size_t k) const {
    return x.data() + (k * ny_ + j) * nx_;
  }

  void fill_line(const float* x, std::vector<float>& line) const {
    std::copy(x, x + nx_, line.begin() + 2);
    for (std::ptrdiff_t d = 1; d <= 2; ++d) {
      line[static_cast<std::size_t>(2 - d)] = x[mirrored(-d, nx_)];
      const auto beyond = static_cast<std::ptrdiff_t>(nx_) - 1 + d;
      line[static_cast<std::size_t>(beyond + 2)] = x[mirrored(beyond, nx_)];
    }
  }

  void combine(const Lines& lines, const Factors& factors, float* next, float* sum) const {
    const auto& [x, y, z] = lines;
    const auto [a, b, c, in_sum] = factors;
    const auto [wx, wy, wz] = weight_;
    for (std::size_t i = 0; i < nx_; ++i) {
      const float middle = 30 * x[i];
      const float dx = middle - 16 * (x[i - 1] + x[i + 1]) + (x[i - 2] + x[i + 2]);
      const float dy = middle - 16 * (y[1][i] + y[3][i]) + (y[0][i] + y[4][i]);
      const float dz = middle - 16 * (z[1][i] + z[3][i]) + (z[0][i] + z[4][i]);
      next[i] = a * x[i] + b * (wx * dx + wy * dy + wz * dz) + c * next[i];
    }
    for (std::size_t i = 0; i < nx_; ++i) sum[i] += in_sum * next[i];
  }

  std::size_t nx_, ny_, nz_;
  std::array<float, 3> weight_;
};

void require_range(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  std::ostringstream message;
  message << "deblurring: expected a " << name << " of " << low << " to " << high << ", found "
          << value;
  throw InputError(message.str());
}

/// The fourth-order second difference of a wave with this angle per voxel, negative.
double symbol_at(double angle) { return (15 - 16 * std::cos(angle) + std::cos(2 * angle)) / 6; }

constexpr std::size_t kAngles = 32;  // along each axis, at the middles of as many parts of [0, pi]
using OverAngles = std::array<double, kAngles>;

/// A function of the angle per voxel, along one axis.
template <class Function>
OverAngles over_angles(const Function& function) {
  OverAngles values;
  for (std::size_t n = 0; n < kAngles; ++n) {
    values[n] = function((static_cast<double>(n) + 0.5) * std::numbers::pi / kAngles);
  }
  return values;
}

/// The mean over all frequencies of the squared filter times a factor of each axis.
double mean_square_gain(const std::array<double, 3>& blur, double regularization,
                        const std::array<OverAngles, 3>& factors) {
  const OverAngles symbols = over_angles(symbol_at);
  const auto [x, y, z] = blur;
  double sum = 0;
  for (std::size_t k = 0; k < kAngles; ++k) {
    for (std::size_t j = 0; j < kAngles; ++j) {
      const double across = z * z * symbols[k] + y * y * symbols[j];
      const double factor = factors[2][k] * factors[1][j];
      for (std::size_t i = 0; i < kAngles; ++i) {
        const double w = filter_at(across + x * x * symbols[i], regularization);
        sum += factor * factors[0][i] * w * w;
      }
    }
  }
  return sum / (kAngles * kAngles * kAngles);
}

}  // namespace

void require_valid_blur(const std::array<double, 3>& blur) {
  for (const double b : blur) require_range("blur in voxels", b, 0, kLargestBlur);
}

Volume deblurred(Volume volume, const std::array<double, 3>& blur, double regularization) {
  require_range("regularization", regularization, 1e-6, 1e6);
  require_valid_blur(blur);
  std::array<double, 3> squares;
  double end = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    squares[a] = blur[a] * blur[a];
    end += kLargestSymbol * squares[a];
  }
  if (end == 0) return volume;
  const std::vector<double> c = chebyshev_coefficients(end, regularization);
  const auto in_sum = [&c](std::size_t n) { return static_cast<float>(c[n]); };
  const Recurrence recurrence(volume, squares);
  // T_0 = x, T_1 = (2 Lambda / end - 1) x, T_n+1 = 2 (2 Lambda / end - 1) T_n - T_n-1.
  std::vector<float> previous = std::move(volume.samples), present(previous.size(), 0);
  std::vector<float> sum(previous.size());
  parallel_for(sum.size(), [&](std::size_t n) { sum[n] = in_sum(0) * previous[n]; });
  recurrence.step(previous, {-1, static_cast<float>(2 / end), 0, in_sum(1)}, present, sum);
  for (std::size_t n = 2; n < c.size(); ++n) {
    recurrence.step(present, {-2, static_cast<float>(4 / end), -1, in_sum(n)}, previous, sum);
    std::swap(previous, present);
  }
  volume.samples = std::move(sum);
  return volume;
}

double noise_gain(const std::array<double, 3>& blur, double regularization) {
  const OverAngles one = over_angles([](double) { return 1.0; });
  return std::sqrt(mean_square_gain(blur, regularization, {one, one, one}));
}

std::array<double, 3> noise_gain_along_surface(const std::array<double, 3>& blur,
                                               double regularization,
                                               const std::array<double, 3>& correlation) {
  constexpr double kWidth = 0.8;  // voxels
  std::array<double, 3> gains;
  for (std::size_t across = 0; across < 3; ++across) {
    std::array<OverAngles, 3> factors;
    for (std::size_t a = 0; a < 3; ++a) {
      const double shared = 2 * correlation[a], width = a == across ? 0 : kWidth;
      factors[a] = over_angles([&](double angle) {
        return std::max(0.0, 1 + shared * std::cos(angle)) *
               std::exp(-width * width * angle * angle);
      });
    }
    gains[across] = std::sqrt(mean_square_gain(blur, regularization, factors));
  }
  return gains;
}

}  // namespace mesamis::detail::restore
