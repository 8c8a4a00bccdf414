// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/expected_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/measure.h"

namespace mesamis::detail::method {
namespace {

constexpr double kOfNoise = 0.8, kOfBends = 0.12, kOfContrastAndBlur = 0.02;
constexpr double kOfDecimation = 0.25;
constexpr double kMost = 2;           // voxels
constexpr double kSlopeOfNoEdge = 1;  // grey values per voxel: less tells of no edge
constexpr double kMostCurvature = 2;  // per voxel

/// How fast the direction of the image's gradient turns around a point, per voxel.
double curvature_at(const SplineImage& image, const Vec3& p) {
  const double voxel = image.grid.voxel_size();
  double squares = 0;
  for (const Vec3& step : {Vec3{voxel, 0, 0}, Vec3{0, voxel, 0}, Vec3{0, 0, voxel}}) {
    const Vec3 turn = unit_or_zero(spline_at(image, p + step).gradient) -
                      unit_or_zero(spline_at(image, p - step).gradient);
    squares += dot(turn, turn) / 4;
  }
  return std::min(std::sqrt(squares), kMostCurvature);
}

/// The distance within which a share of the area is expected to lie.
/// @param parts  mean sizes of normal variables, > 0, increasing, and the area of each.
double distance_of_share(double share, const std::vector<std::pair<double, double>>& parts,
                         double area) {
  constexpr int kClasses = 512, kHalvings = 40;
  const double root_of_pi = std::sqrt(std::numbers::pi);
  std::vector<double> sizes;  // of classes of equal area
  double below = 0;
  for (const auto& [size, own] : parts) {
    below += own;
    while (static_cast<double>(sizes.size()) + 0.5 < kClasses * below / area) sizes.push_back(size);
  }
  double near = 0, far = 4 * sizes.back();
  for (int step = 0; step < kHalvings; ++step) {
    const double x = (near + far) / 2;
    double inside = 0;
    for (const double size : sizes) inside += std::erf(x / (size * root_of_pi));
    (inside < share * static_cast<double>(sizes.size()) ? near : far) = x;
  }
  return (near + far) / 2;
}

}  // namespace

std::vector<double> expected_error(const TriMesh& surface, const SplineImage& image,
                                   const ErrorOptions& options) {
  require_sound(surface);
  const double voxel = image.grid.voxel_size();
  const auto [x, y, z] = options.blur;
  const Vec3 along{options.noise[0], options.noise[1], options.noise[2]};
  const double blur = (x * x + y * y + z * z) / 3;
  const double at_box = 1e-3 * voxel;  // single precision does not hit it
  const Vec3 margin{at_box, at_box, at_box};
  const Box inner{margin, image.grid.box().extent() - margin};
  std::vector<double> errors(surface.points.size());
  parallel_for(errors.size(), [&](std::size_t n) {
    const Vec3 p = image.grid.to_grid(surface.points[n]);
    if (!inner.contains(p)) return;
    const Vec3 gradient = spline_at(image, p).gradient, normal = unit_or_zero(gradient);
    const double slope = std::max(norm(gradient) * voxel, kSlopeOfNoEdge);
    const double noise = std::hypot(normal.x * along.x, normal.y * along.y, normal.z * along.z);
    const double error = std::hypot(std::hypot(kOfNoise * noise, options.level) / slope,
                                    kOfBends * blur * curvature_at(image, p),
                                    kOfContrastAndBlur * blur * options.contrast / slope);
    errors[n] = std::hypot(std::min(error, kMost) * voxel, kOfDecimation * options.decimated);
  });
  return errors;
}

ErrorSummary summarize_error(const TriMesh& surface, const std::vector<double>& values) {
  require_sound(surface);
  std::vector<std::pair<double, double>> parts;  // value and area of each triangle
  double area = 0, sum = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& k = surface.triangles[t];
    const double value = (values[k[0]] + values[k[1]] + values[k[2]]) / 3;
    if (value == 0) continue;
    parts.emplace_back(value, triangle_area(surface, t));
    area += parts.back().second;
    sum += value * parts.back().second;
  }
  if (!(area > 0)) return {};
  std::sort(parts.begin(), parts.end());
  return {sum / area, distance_of_share(0.95, parts, area), parts.back().first, area};
}

}  // namespace mesamis::detail::method
