// SPDX-License-Identifier: Apache-2.0
#include "mesamis/settings.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/image/deblur.h"

namespace mesamis {
namespace {

void require_range(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  std::ostringstream message;
  message << name << ": expected " << low << " to " << high << ", found " << value;
  throw InputError(message.str());
}

/// Smallest and largest positive values that make sense of a weight or a length.
constexpr double kTiny = 1e-12, kHuge = 1e12;
/// Native values are single precision.
constexpr double kLargestValue = 1e38;

}  // namespace

void require_valid(const Settings& s) {
  for (const Index stride : s.stride) require_range("stride", stride, 1, 1000);
  require_range("epsilon", s.epsilon, kTiny, kHuge);
  if (s.eta) require_range("eta", *s.eta, kTiny * kTiny, kHuge);
  require_range("beta", s.beta, kTiny, kHuge);
  if (s.gamma) require_range("gamma", *s.gamma, kTiny, kHuge);
  require_range("amis-iterations", s.amis_iterations, 1, 1000);
  require_range("tol-v", s.tol_v, 0, 1);
  require_range("solver-tolerance", s.solver_tolerance, 1e-14, 1e-2);
  if (s.max_tets) require_range("max-tets", static_cast<double>(*s.max_tets), 100, 2e8);
  require_range("tau", s.tau, kTiny, kHuge);
  require_range("adaptations", s.adaptations, 1, 100);
  require_range("tol-mesh", s.tol_mesh, 0, kHuge);
  require_range("tol-energy", s.tol_energy, 0, kHuge);
  require_range("max-stretch", s.max_stretch, 1.1, 1e6);
  if (s.gradation != 0) require_range("gradation (other than 0)", s.gradation, 1.01, 1000);
  require_range("h-min", s.h_min, kTiny, kHuge);
  if (s.h_max) require_range("h-max", *s.h_max, s.h_min, kHuge);
  require_range("band-threshold", s.band_threshold, 0, 1);
  if (s.min_volume) require_range("min-volume", *s.min_volume, 0, 1e12);
  require_range("keep-largest", static_cast<double>(s.keep_largest), 0, 1e9);
  if (s.tolerance) require_range("tolerance", *s.tolerance, 0, kHuge);
  if (s.triangles) require_range("triangles", static_cast<double>(*s.triangles), 4, 2e9);
  require_range("threshold", s.threshold, -kLargestValue, kLargestValue);
  if (s.noise) require_range("noise", *s.noise, 0, kLargestValue);
  if (s.blur) {
    for (const double blur : *s.blur) require_range("blur", blur, 0, kLargestBlur);
  }
  if (s.level) require_range("level", *s.level, -kLargestValue, kLargestValue);
  if (s.window) {
    require_range("window", s.window->low, -kLargestValue, kLargestValue);
    require_range("window", s.window->high, -kLargestValue, kLargestValue);
  }
  if (s.window && !(s.window->low < s.window->high)) {
    std::ostringstream message;
    message << "window: expected low below high, found " << s.window->low << "," << s.window->high;
    throw InputError(message.str());
  }
}

std::int64_t default_max_tets(double area, const Vec3& spacing) {
  constexpr double kCellsPerSquare = 4.5, kThickest = 8;
  const auto [shortest, longest] = std::minmax({spacing.x, spacing.y, spacing.z});
  const double side = std::max(shortest, longest / kThickest);
  return std::llround(
      std::clamp<double>(kCellsPerSquare * area / (side * side), kFewestTets, kMostTets));
}

double default_gamma(double epsilon, double beta, double contrast, double noise) {
  constexpr double kOfContrast = 0.07, kOfNoise = 0.25;
  const double gradient = kOfContrast * contrast + kOfNoise * noise;
  return 4 * epsilon * beta * gradient * gradient;
}

}  // namespace mesamis
