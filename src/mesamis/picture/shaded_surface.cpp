// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/shaded_surface.h"

#include <algorithm>
#include <cmath>

#include "mesamis/picture/triangles.h"

namespace mesamis::detail::picture {
namespace {

constexpr Colour kEdge{31, 33, 46};

PageTriangles on_page(const Scene& scene, const TriMesh& surface) {
  PageTriangles page;
  page.points.reserve(surface.points.size());
  for (const Vec3& p : surface.points) {
    const Place at = scene.on_canvas(scene.to_pixel(p));
    page.points.push_back({at[0], at[1], -dot(p, scene.axes().forward)});
  }
  page.triangles = surface.triangles;
  return page;
}

/// The colour of each fragment of a surface.
class SurfaceShader {
 public:
  SurfaceShader(const Scene& scene, const ShadedSurface& shown)
      : scene_(scene), shown_(shown), half_line_(std::max(0.5, 0.75 * scene.unit()) / 2) {}

  Colour operator()(const Fragment& fragment) const {
    const Vec3 flat = scene_.as_seen(flat_normal(fragment.triangle));
    const bool is_back = flat.z < 0;
    Vec3 normal = shown_.normals.empty() ? flat : scene_.as_seen(smooth_normal(fragment));
    if (is_back) normal = -normal;
    // A smooth normal may look away where its triangle does not.
    normal.z = std::max(normal.z, 0.0);
    Reflectance reflectance = shown_.reflectance;
    if (is_back) reflectance.specular = 0;
    const Colour colour = is_back && shown_.inside ? *shown_.inside : shown_.paint(fragment);
    return with_edge(lit(colour, unit_or_zero(normal), reflectance), fragment);
  }

 private:
  /// The edge of a triangle is as wide in each of its two; it fades over a third of a pixel.
  Colour with_edge(const Colour& colour, const Fragment& fragment) const {
    if (!shown_.edges) return colour;
    const double share = std::clamp(3 * (half_line_ - fragment.side_distance) + 0.5, 0.0, 1.0);
    Colour mixed{};
    for (std::size_t c = 0; c < 3; ++c) {
      mixed[c] = static_cast<std::uint8_t>(std::lround((1 - share) * colour[c] + share * kEdge[c]));
    }
    return mixed;
  }
  Vec3 flat_normal(std::size_t triangle) const {
    const Triangle& t = shown_.surface.triangles[triangle];
    const auto at = [&](std::size_t n) {
      return shown_.surface.points[static_cast<std::size_t>(t[n])];
    };
    return unit_or_zero(cross(at(1) - at(0), at(2) - at(0)));
  }
  Vec3 smooth_normal(const Fragment& fragment) const {
    const auto& normals = shown_.normals[fragment.triangle];
    Vec3 sum;
    for (std::size_t n = 0; n < 3; ++n) sum += fragment.weights[n] * normals[n];
    return unit_or_zero(sum);
  }

  const Scene& scene_;
  const ShadedSurface& shown_;
  double half_line_;
};

}  // namespace

void draw_shaded(Scene& scene, const ShadedSurface& shown) {
  const SurfaceShader shader(scene, shown);
  draw_triangles(scene.canvas(), on_page(scene, shown.surface),
                 [&shader](const Fragment& fragment) { return shader(fragment); });
}

}  // namespace mesamis::detail::picture
