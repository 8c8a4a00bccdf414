// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/memory.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "mesamis/base/available_memory.h"
#include "mesamis/base/error.h"
#include "mesamis/fem/grid_amis.h"
#include "mesamis/method/parameters.h"
#include "mesamis/method/prepare.h"

namespace mesamis::detail::method {
namespace {

constexpr double kBytesPerVoxel = 8;    // of the image in grey values, always, and its spline
constexpr double kBytesPerLevel = 4;    // per voxel: where each has a level of its own, always
constexpr double kBytesToPrepare = 10;  // per voxel: a smoothed image and the steps of a filter
constexpr double kBytesToLevel = 14;    // per voxel: edges, means around them, thinned walls
constexpr double kBytesPerNode = 54;    // of the first grid: fields, metrics, their eigenvalues
constexpr double kBytesPerDoubleNode = 112;  // where the fields are solved in double precision
constexpr double kBytesPerCell = 450;        // of the adapted meshes
constexpr double kBytesPerTriangle = 450;    // of a preview's surface, while it follows the image
constexpr double kTriangles = 50;  // of it, times n^(2/3) of n nodes: of spongy bone nearly as many
constexpr double kBytesOfProgram = 5e7;

/// See run_amis_on_grid(). Above this beta its conjugate gradients may need too many iterations.
double bytes_per_node(const Settings& settings) {
  constexpr double kMostBeta = 10;
  const bool is_rough = settings.drafts || settings.solver_tolerance >= kLeastSingleTolerance;
  return is_rough && settings.beta <= kMostBeta ? kBytesPerNode : kBytesPerDoubleNode;
}

double product(const std::array<Index, 3>& n) {
  return static_cast<double>(n[0]) * static_cast<double>(n[1]) * static_cast<double>(n[2]);
}

}  // namespace

double memory_needed(const VoxelGrid& volume, const Settings& settings) {
  const std::array<Index, 3> size = cropped_size(volume, settings.crop);
  const double voxels = product(size),
               nodes = product(first_grid_size(size, stride_of(settings, size, volume.spacing)));
  const double cells = settings.preview    ? 0
                       : settings.max_tets ? static_cast<double>(*settings.max_tets)
                                           : std::min<double>(kMostTets, 12 * voxels);
  const double triangles = settings.preview ? kTriangles * std::pow(nodes, 2.0 / 3) : 0;
  const bool local = settings.has_local_level();
  const double per_voxel = kBytesPerVoxel + (local ? kBytesPerLevel : 0);
  return kBytesOfProgram + per_voxel * voxels +
         std::max({(local ? kBytesToLevel : kBytesToPrepare) * voxels,
                   bytes_per_node(settings) * nodes, kBytesPerCell * cells,
                   kBytesPerTriangle * triangles});
}

std::optional<std::array<Index, 3>> stride_that_fits(const VoxelGrid& volume, Settings settings,
                                                     double bytes) {
  constexpr Index kMostStride = 8;
  const std::array<Index, 3> size = cropped_size(volume, settings.crop);
  auto& stride = settings.stride.emplace(stride_of(settings, size, volume.spacing));
  while (memory_needed(volume, settings) > bytes) {
    std::size_t shortest = 3;
    for (std::size_t a = 0; a < 3; ++a) {
      if (stride[a] >= kMostStride) continue;
      const auto length = [&](std::size_t n) {
        return stride[n] * volume.spacing[static_cast<int>(n)];
      };
      if (shortest == 3 || length(a) < length(shortest)) shortest = a;
    }
    if (shortest == 3) return std::nullopt;
    ++stride[shortest];
  }
  return stride;
}

void require_memory(const VoxelGrid& volume, const Settings& settings, double limit_gb,
                    double still_taken) {
  constexpr double kGigabyte = 1e9;
  const auto limit = memory_limit(limit_gb);
  const double needed = memory_needed(volume, settings) + still_taken;
  if (!limit || needed <= *limit) return;
  std::ostringstream message;
  message << std::fixed << std::setprecision(1) << "memory: expected about " << needed / kGigabyte
          << " GB for this run, found " << *limit / kGigabyte << " GB; ";
  if (const auto stride = stride_that_fits(volume, settings, *limit - still_taken)) {
    const auto& [x, y, z] = *stride;
    message << "--stride " << x << "," << y << "," << z << " fits";
  } else {
    message << "no stride fits: --crop the scan, or fewer cells (--max-tets)";
  }
  throw InputError(message.str());
}

}  // namespace mesamis::detail::method
