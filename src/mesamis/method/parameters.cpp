// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/parameters.h"

#include <algorithm>
#include <cmath>

#include "mesamis/method/setting_table.h"

namespace mesamis::detail::method {

Parameters parameters_asked(const Settings& settings) {
  Parameters p;
  for (const Setting& setting : setting_table()) setting.use(settings, p);
  return p;
}

Settings settings_of(const Parameters& parameters) {
  Settings settings;
  for (const Setting& setting : setting_table()) setting.repeat(parameters, settings);
  return settings;
}

double cells_for_surface(double area, double thin_share, const Vec3& spacing, double accuracy) {
  constexpr double kCells = 4.5, kCellsWhereThin = 18, kThickest = 8;
  constexpr double kUsual = 0.1, kMostFiner = 4;  // voxels; times the usual number
  const auto [shortest, longest] = std::minmax({spacing.x, spacing.y, spacing.z});
  const double side = std::max(shortest, longest / kThickest);
  const double per_square = kCells + thin_share * (kCellsWhereThin - kCells);
  const double voxel = std::cbrt(spacing.x * spacing.y * spacing.z);
  const double finer =
      accuracy > 0 ? std::clamp(kUsual * voxel / accuracy, 1 / kMostFiner, kMostFiner) : 1;
  return finer * per_square * area / (side * side);
}

std::array<Index, 3> default_stride(const std::array<Index, 3>& voxels, const Vec3& spacing) {
  constexpr double kMostFine = 1e6, kSlack = 1.01;  // the latter for spacings that are rounded
  const double count = static_cast<double>(voxels[0]) * voxels[1] * voxels[2];
  if (count <= kMostFine) return {1, 1, 1};
  const double mean = std::cbrt(spacing.x * spacing.y * spacing.z);
  const auto along = [mean](double side) { return side <= kSlack * mean ? 2 : 1; };
  return {along(spacing.x), along(spacing.y), along(spacing.z)};
}

std::array<Index, 3> preview_stride(const std::array<Index, 3>& voxels, const Vec3& spacing) {
  constexpr double kMostNodes = 3e6;
  std::array<Index, 3> stride{1, 1, 1};
  const auto nodes = [&] {
    double product = 1;
    for (std::size_t a = 0; a < 3; ++a) product *= static_cast<double>(voxels[a]) / stride[a];
    return product;
  };
  while (nodes() > kMostNodes) {
    int shortest = 0;
    for (int a = 1; a < 3; ++a) {
      const auto step = [&](int b) { return stride[static_cast<std::size_t>(b)] * spacing[b]; };
      if (step(a) < step(shortest)) shortest = a;
    }
    ++stride[static_cast<std::size_t>(shortest)];
  }
  return stride;
}

std::array<Index, 3> stride_of(const Settings& settings, const std::array<Index, 3>& voxels,
                               const Vec3& spacing) {
  return settings.stride.value_or(settings.preview ? preview_stride(voxels, spacing)
                                                   : default_stride(voxels, spacing));
}

double default_gamma(double epsilon, double beta, double contrast, double noise) {
  constexpr double kOfContrast = 0.07, kOfNoise = 0.25;
  const double gradient = kOfContrast * contrast + kOfNoise * noise;
  return 4 * epsilon * beta * gradient * gradient;
}

}  // namespace mesamis::detail::method
