// SPDX-License-Identifier: Apache-2.0
#include "mesamis/baseline/geodesic_contour.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/baseline/itk_level_set.h"
#include "mesamis/image/gaussian.h"
#include "mesamis/restore/level_crossings.h"

namespace mesamis {
namespace {

constexpr double kBand = 6;      // voxels on each side in which distances are known
constexpr double kFlatFrom = 3;  // voxels from the edge, beyond its slope
constexpr std::size_t kMaxPoints = 200'000;

void require(bool holds, const char* option, const char* expected, double found) {
  if (holds) return;
  throw InputError(std::string(option) + ": expected " + expected + ", found " +
                   std::to_string(found));
}

void require_scan(const Volume& volume) {
  constexpr Index kLeast = 4;  // for ITK's recursive filters
  require_usable(volume);
  const Index shortest = *std::min_element(volume.size.begin(), volume.size.end());
  require(shortest >= kLeast, "geodesic contour", "4 voxels or more per direction", shortest);
}

/// The value below which a share of the values lies.
double quantile(std::vector<double>& values, double share) {
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * last);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Volume denoised(const Volume& volume, const GeodesicOptions& options, const Progress& progress) {
  Volume smooth = gaussian_smoothed(volume, options.smooth_voxels);
  if (options.diffusions == 0) return smooth;
  return diffused(smooth, options.diffusions, options.conductance, progress);
}

void require_crossing(const Volume& volume, double level, const char* what) {
  const auto [low, high] = std::minmax_element(volume.samples.begin(), volume.samples.end());
  if (*low < level && level < *high) return;
  throw InputError(std::string("geodesic contour: expected voxels on both sides of ") + what + " " +
                   std::to_string(level) + ", found values from " + std::to_string(*low) + " to " +
                   std::to_string(*high));
}

double edge_gradient(const Volume& image, double level, const Volume& gradient) {
  constexpr double kShare = 0.1;  // so that weak edges stop the contour, too
  std::vector<double> values;
  for (const SurfacePoint& point : crossing_points(image, level, kMaxPoints)) {
    values.push_back(interpolate(gradient, point.position));
  }
  return quantile(values, kShare);
}

/// The median gradient away from edges; 0 where there is no such place.
double flat_gradient(const Volume& distance, const Volume& gradient) {
  std::vector<double> values;
  for (std::size_t n = 0; n < distance.samples.size(); ++n) {
    const double d = std::abs(distance.samples[n]);
    if (kFlatFrom < d && d < kBand) values.push_back(gradient.samples[n]);
  }
  return values.empty() ? 0 : quantile(values, 0.5);
}

/// Chooses the sigmoid as ITK's guide has it: it falls between the two gradients.
void choose_sigmoid(const GeodesicOptions& options, GeodesicReport& report) {
  const double step = report.edge_gradient - report.flat_gradient;
  if ((!options.alpha || !options.beta) && !(step > 0)) {
    throw InputError(
        "geodesic contour: expected steeper edges at the level than away from it, found " +
        std::to_string(report.edge_gradient) + " and " + std::to_string(report.flat_gradient) +
        " per mm; alpha and beta must be given");
  }
  report.alpha = options.alpha.value_or(-step / 6);
  report.beta = options.beta.value_or(report.flat_gradient + step / 2);
}

/// The speed: 0 at edges, 1 elsewhere.
Volume speed_of(Volume gradient, double alpha, double beta) {
  parallel_for(gradient.samples.size(), [&](std::size_t n) {
    float& m = gradient.samples[n];
    m = static_cast<float>(1 / (1 + std::exp(-(m - beta) / alpha)));
  });
  return gradient;
}

Volume shrunk(Volume distance, double by) {
  for (float& d : distance.samples) d -= static_cast<float>(by);
  return distance;
}

/// Where the contour starts and the speed it moves at.
struct Start {
  Volume level_set, speed;
  GeodesicReport report;
};

Start prepare(const Volume& volume, double level, const GeodesicOptions& options,
              const Progress& progress) {
  const Volume image = denoised(volume, options, progress);
  require_crossing(image, level, "the level");
  Volume gradient = gradient_magnitude(image, options.sigma * volume.shortest_side());
  Volume distance = signed_distance(image, level, kBand);
  Start start;
  start.report.edge_gradient = edge_gradient(image, level, gradient);
  start.report.flat_gradient = flat_gradient(distance, gradient);
  choose_sigmoid(options, start.report);
  start.speed = speed_of(std::move(gradient), start.report.alpha, start.report.beta);
  start.level_set = shrunk(std::move(distance), options.shrink);
  require_crossing(start.level_set, 0, "the contour's start");
  return start;
}

}  // namespace

bool has_geodesic_contour() { return have_itk(); }

void require_valid(const GeodesicOptions& o) {
  const auto within = [](double x, double low, double high) { return low <= x && x <= high; };
  const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
  const auto require_weight = [&within](const char* name, double x) {
    require(within(x, 0, 1e6), name, "0 to 1e6", x);
  };
  require(within(o.smooth_voxels, 0, 100), "smooth", "0 to 100 voxels", o.smooth_voxels);
  require(o.diffusions >= 0, "diffusions", "0 or more", o.diffusions);
  require(positive(o.conductance), "conductance", "more than 0", o.conductance);
  require(within(o.sigma, 0.1, 100), "sigma", "0.1 to 100 voxels", o.sigma);
  require(positive(-o.alpha.value_or(-1)), "alpha", "less than 0", o.alpha.value_or(-1));
  require(positive(o.beta.value_or(1)), "beta", "more than 0", o.beta.value_or(1));
  require(within(o.shrink, -4, 4), "shrink", "-4 to 4 voxels", o.shrink);
  require_weight("propagation", o.propagation);
  require_weight("curvature", o.curvature);
  require_weight("advection", o.advection);
  require(o.iterations >= 1, "iterations", "1 or more", o.iterations);
  require(positive(o.rms_change), "rms change", "more than 0 voxels", o.rms_change);
}

GeodesicContour geodesic_contour(const Volume& volume, double level, const GeodesicOptions& options,
                                 const Progress& progress) {
  require_valid(options);
  require_scan(volume);
  const Start start = prepare(volume, level, options, progress);
  EvolutionResult result = evolved(start.level_set, start.speed,
                                   {options.propagation, options.curvature, options.advection,
                                    options.iterations, options.rms_change},
                                   progress);
  require_crossing(result.level_set, 0, "the contour's end");
  GeodesicContour contour{std::move(result.level_set), start.report};
  contour.report.iterations = result.iterations;
  contour.report.rms_change = result.rms_change;
  contour.report.converged = result.converged;
  return contour;
}

}  // namespace mesamis
