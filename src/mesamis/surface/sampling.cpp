// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/sampling.h"

#include <array>
#include <cmath>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/surface/measure.h"

namespace mesamis::detail::surface {
namespace {

/// Point i of the two-dimensional Weyl sequence with the plastic number, in the unit square.
/// Source: M. Roberts, The unreasonable effectiveness of quasirandom sequences, 2018.
std::array<double, 2> low_discrepancy(std::size_t i) {
  constexpr double kPlastic = 1.32471795724474602596;
  const double n = static_cast<double>(i) + 1;
  const double s = n / kPlastic, t = n / (kPlastic * kPlastic);
  return {s - std::floor(s), t - std::floor(t)};
}

/// The unit square folded onto the triangle.
Vec3 place_in(const TriMesh& surface, std::size_t triangle, std::array<double, 2> st) {
  if (st[0] + st[1] > 1) st = {1 - st[0], 1 - st[1]};
  const Triangle& k = surface.triangles[triangle];
  const Vec3& a = surface.points[k[0]];
  return a + st[0] * (surface.points[k[1]] - a) + st[1] * (surface.points[k[2]] - a);
}

/// Summed in the order of the triangles.
double total_area(const TriMesh& surface) {
  double total = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) total += triangle_area(surface, t);
  if (total > 0 && std::isfinite(total)) return total;
  throw InputError("sampling: expected a surface with a finite area, found " +
                   std::to_string(total));
}

}  // namespace

std::vector<Vec3> sample_by_area(const TriMesh& surface, std::size_t count) {
  require_sound(surface);
  std::vector<Vec3> samples;
  if (count == 0) return samples;
  const double total = total_area(surface);
  samples.reserve(count);
  double passed = 0;  // area of the triangles before and including t
  for (std::size_t t = 0; t < surface.triangles.size() && samples.size() < count; ++t) {
    passed += triangle_area(surface, t);
    // Summed in the same order, `passed` ends at exactly `total`: no sample is left over.
    while (samples.size() < count &&
           (static_cast<double>(samples.size()) + 0.5) * (total / static_cast<double>(count)) <
               passed) {
      samples.push_back(place_in(surface, t, low_discrepancy(samples.size())));
    }
  }
  return samples;
}

std::vector<TriangleSample> sample_triangles_by_area(const TriMesh& surface, double scale) {
  require_sound(surface);
  const std::size_t count = surface.triangles.size();
  const double share = total_area(surface) / static_cast<double>(count);
  std::vector<TriangleSample> samples;
  double unsampled = 0;  // area since the last sample
  for (std::size_t t = 0; t < count; ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    for (unsampled += triangle_area(surface, t); unsampled >= share; unsampled -= share) {
      const Vec3 normal = area_vector(surface, t);
      samples.push_back({(scale / 3) * (surface.points[a] + surface.points[b] + surface.points[c]),
                         (1 / norm(normal)) * normal});
    }
  }
  return samples;
}

}  // namespace mesamis::detail::surface
