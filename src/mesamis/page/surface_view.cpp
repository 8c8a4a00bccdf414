// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/surface_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/normals.h"

namespace mesamis::detail::page {
namespace {

/// What runs to the right and upwards on the page, and towards the viewer; LPS.
struct Camera {
  Vec3 right, up, near;
};

Camera camera_of(const std::string& view) {
  if (view == "front") return {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
  if (view == "left") return {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  if (view == "top") return {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  const Vec3 near = unit_or_zero({0.55, -0.8, 0.4});
  const Vec3 right = unit_or_zero(cross({0, 0, 1}, near));
  return {right, cross(near, right), near};
}

/// A point on the page, pixels and mm towards the viewer, and how bright it is.
struct Vertex {
  double x = 0, y = 0, near = 0, light = 0;
};

class DepthBuffer {
 public:
  DepthBuffer(int width, int height)
      : picture_(blank(width, height, {255, 255, 255})),
        near_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
              -std::numeric_limits<float>::infinity()) {}

  void draw(const std::array<Vertex, 3>& corners, const Colour& colour) {
    const Vertex &a = corners[0], &b = corners[1], &c = corners[2];
    visit_pixels({{{a.x, a.y}, {b.x, b.y}, {c.x, c.y}}}, {picture_.width, picture_.height},
                 [&](int x, int y, double in_b, double in_c) {
                   const auto mixed = [&](double Vertex::*m) {
                     return a.*m + in_b * (b.*m - a.*m) + in_c * (c.*m - a.*m);
                   };
                   set(x, y, mixed(&Vertex::near), shaded(colour, mixed(&Vertex::light)));
                 });
  }

  const Raster& picture() const { return picture_; }

 private:
  static Colour shaded(const Colour& colour, double light) {
    Colour result{};
    for (std::size_t c = 0; c < 3; ++c) {
      result[c] = static_cast<std::uint8_t>(std::lround(std::clamp(colour[c] * light, 0.0, 255.0)));
    }
    return result;
  }
  void set(int x, int y, double near, const Colour& colour) {
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                           static_cast<std::size_t>(x);
    if (static_cast<float>(near) <= near_[at]) return;
    near_[at] = static_cast<float>(near);
    std::copy(colour.begin(), colour.end(), picture_.bytes.data() + picture_.offset(x, y));
  }

  Raster picture_;
  std::vector<float> near_;
};

std::vector<Vec3> seen_from(const Camera& camera, const TriMesh& surface) {
  std::vector<Vec3> page;
  page.reserve(surface.points.size());
  for (const Vec3& p : surface.points) {
    page.push_back({dot(p, camera.right), dot(p, camera.up), dot(p, camera.near)});
  }
  return page;
}

/// Light from the upper left, behind the viewer.
double light_on(const Vec3& normal, const Camera& camera) {
  const Vec3 light = unit_or_zero(camera.near + 0.5 * camera.up - 0.35 * camera.right);
  return 0.3 + 0.75 * std::abs(dot(normal, light));
}

}  // namespace

std::vector<std::string> surface_views() { return {"front", "left", "top", "oblique"}; }

Raster surface_view(std::span<const ShownSurface> surfaces, const std::string& view, int pixels) {
  constexpr double kMargin = 0.03;
  const Camera camera = camera_of(view);
  std::vector<std::vector<Vec3>> pages;
  std::vector<Vec3> all;
  for (const ShownSurface& s : surfaces) {
    pages.push_back(seen_from(camera, *s.surface));
    all.insert(all.end(), pages.back().begin(), pages.back().end());
  }
  const Box box = bounding_box(all);
  const Vec3 size = box.extent();
  const double margin = kMargin * std::max({size.x, size.y, 1e-9});
  const double scale = 2 * pixels / (std::max({size.x, size.y, 1e-9}) + 2 * margin);
  const auto even = [&](double mm) {
    return 2 * std::max(1, static_cast<int>(scale * (mm + 2 * margin) / 2));
  };
  DepthBuffer buffer(even(size.x), even(size.y));
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const std::vector<Vec3> normals = vertex_normals(*surfaces[s].surface);
    for (const Triangle& t : surfaces[s].surface->triangles) {
      std::array<Vertex, 3> corners;
      for (std::size_t n = 0; n < 3; ++n) {
        const auto at = static_cast<std::size_t>(t[n]);
        const Vec3& p = pages[s][at];
        corners[n] = {scale * (p.x - box.lo.x + margin), scale * (box.hi.y - p.y + margin), p.z,
                      light_on(normals[at], camera)};
      }
      buffer.draw(corners, surfaces[s].colour);
    }
  }
  return halved(buffer.picture());
}

}  // namespace mesamis::detail::page
