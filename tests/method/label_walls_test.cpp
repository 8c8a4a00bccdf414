// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "mesamis/method/label_surfaces.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

/// Round walls of a voxel or two never reach their own value; a ball beside them does.
TEST(LabelWalls, HaveTheirThicknessInAScan) {
  constexpr double kBlur = 0.9, kBall = 11, kRadius = 9, kWithin = 7;
  const Vec3 normal = unit_or_zero({1, 0.3, 0.2}), middle{9, 22, 22}, centre{29, 22, 22};
  const auto step = [](double t) { return 0.5 * std::erfc(-t / (kBlur * std::sqrt(2))); };
  for (const double thickness : {1.3, 1.8, 2.4}) {
    LabelMap map;
    map.size = {44, 44, 44};
    map.segments = {{"wall", 1, 0, {}}, {"ball", 2, 0, {}}};
    map.layers.emplace_back();
    const Volume scan = sampled_volume(map.size, {1, 1, 1}, [&](const Vec3& p) {
      const double across = dot(p - middle, normal), along = norm(p - middle - across * normal),
                   outside = norm(p - centre) - kBall;
      const bool in_wall = std::abs(across) < thickness / 2 && along < kRadius;
      map.layers[0].push_back(outside < 0 ? 2 : in_wall ? 1 : 0);
      const double wall = step(thickness / 2 - across) - step(-thickness / 2 - across);
      return 50 + 190 * (wall * step(kRadius - along) + step(-outside));
    });
    const LabelResult found = find_labelled_objects(scan, {map}, Settings{});
    std::array<double, 2> volumes{}, areas{};  // above and below each face, as columns
    const TriMesh& wall = found.objects.at(0).surface;
    for (const Triangle& t : wall.triangles) {
      const Vec3 &a = wall.points[t[0]], &b = wall.points[t[1]], &c = wall.points[t[2]];
      const Vec3 out = (1.0 / 3) * (a + b + c) - middle;
      const double area = dot(cross(b - a, c - a), normal) / 2, height = dot(out, normal);
      if (norm(out - height * normal) > kWithin) continue;
      const std::size_t face = area > 0 ? 0 : 1;
      volumes[face] += area * height;
      areas[face] += area;
    }
    EXPECT_NEAR(volumes[0] / areas[0] - volumes[1] / areas[1], thickness, 0.15) << thickness;
  }
}

}  // namespace
}  // namespace mesamis
