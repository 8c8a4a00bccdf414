// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/distance.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis {
namespace {

/// The smallest value that the share of the values does not exceed; reorders them.
double percentile(std::vector<double>& values, double share) {
  const auto rank =
      static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto place = values.begin() + std::max<std::ptrdiff_t>(rank, 1) - 1;
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

void require_finite(std::span<const Vec3> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    throw InputError("distance: point " + std::to_string(i) + " is not finite");
  }
}

}  // namespace

std::vector<double> distances_to_surface(std::span<const Vec3> points, const TriMesh& surface) {
  require_sound(surface);
  require_finite(points);
  if (surface.triangles.empty()) throw InputError("distance: the surface has no triangle");
  const TriangleTree tree(surface);
  std::vector<double> distances(points.size());
  constexpr std::size_t kPointsPerBlock = 1024;
  parallel_blocks(points.size(), kPointsPerBlock, [&](std::size_t begin, std::size_t end) {
    std::size_t hint = 0;
    for (std::size_t i = begin; i < end; ++i) {
      distances[i] = std::sqrt(tree.squared_distance_to(points[i], hint));
    }
  });
  return distances;
}

double max_distance(const TriMesh& from, const TriMesh& to, double fine) {
  require_sound(from);
  require_sound(to);
  if (from.triangles.empty() || to.triangles.empty()) {
    throw InputError("distance: a surface has no triangle");
  }
  const TriangleTree tree(to);
  return parallel_max(from.triangles.size(), fine, [&](std::size_t begin, std::size_t end) {
    std::size_t hint = 0;
    double farthest = fine;
    for (std::size_t t = begin; t < end; ++t) {
      farthest = std::max(
          farthest, farthest_distance(corners_of(from, from.triangles[t]), tree, {farthest}, hint));
    }
    return farthest;
  });
}

double fine_enough(const TriMesh& surface, double tolerance) {
  if (!std::isinf(tolerance)) return 0.01 * tolerance;
  return 1e-6 * norm(bounding_box(surface.points).extent());
}

DistanceSummary summarize(std::vector<double> distances) {
  DistanceSummary summary;
  summary.count = distances.size();
  if (distances.empty()) return summary;
  double sum = 0, squares = 0;
  for (const double d : distances) {
    sum += d;
    squares += d * d;
  }
  summary.mean = sum / static_cast<double>(distances.size());
  summary.rms = std::sqrt(squares / static_cast<double>(distances.size()));
  summary.p95 = percentile(distances, 0.95);
  summary.p99 = percentile(distances, 0.99);
  summary.max = *std::max_element(distances.begin(), distances.end());
  return summary;
}

}  // namespace mesamis
