// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/scene.h"

#include <algorithm>
#include <limits>
#include <map>

#include "mesamis/base/error.h"
#include "mesamis/files/atomic_file.h"

namespace mesamis::detail::picture {
namespace {

constexpr int kMinPixels = 64, kMaxPixels = 8192;

Vec3 unit_vector(const Vec3& v) { return (1 / norm(v)) * v; }

/// The smallest and largest of the points' coordinates along a direction.
std::array<double, 2> extent_along(const Vec3& direction, std::span<const Vec3> points) {
  std::array<double, 2> extent{std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()};
  for (const Vec3& p : points) {
    extent[0] = std::min(extent[0], dot(direction, p));
    extent[1] = std::max(extent[1], dot(direction, p));
  }
  return extent;
}

}  // namespace

CameraAxes camera_axes(const std::string& view) {
  static const std::map<std::string, CameraAxes> views{
      {"front", {{0, 1, 0}, {0, 0, 1}}},
      {"back", {{0, -1, 0}, {0, 0, 1}}},
      {"left", {{-1, 0, 0}, {0, 0, 1}}},
      {"right", {{1, 0, 0}, {0, 0, 1}}},
      {"top", {{0, 0, -1}, {0, -1, 0}}},
      {"bottom", {{0, 0, 1}, {0, -1, 0}}},
      {"oblique", {{-0.5, 0.75, -0.45}, {0, 0, 1}}},
  };
  const auto found = views.find(view);
  if (found == views.end()) {
    throw InputError("picture: no view '" + view +
                     "', expected front, back, left, right, top, bottom or oblique");
  }
  CameraAxes axes{unit_vector(found->second.forward), found->second.up};
  axes.up = unit_vector(axes.up - dot(axes.up, axes.forward) * axes.forward);
  return axes;
}

Scene::Scene(const std::array<int, 2>& pixels) {
  const auto [least, most] = std::minmax(pixels[0], pixels[1]);
  if (least < kMinPixels || most > kMaxPixels) {
    throw InputError("picture: size " + std::to_string(pixels[0]) + " x " +
                     std::to_string(pixels[1]) + ", expected " + std::to_string(kMinPixels) +
                     " to " + std::to_string(kMaxPixels) + " pixels each way");
  }
  canvas_ = blank(pixels[0], pixels[1], {255, 255, 255});
}

double Scene::unit() const { return std::min(canvas_.width / 1000.0, canvas_.height / 800.0); }

std::array<double, 2> Scene::to_pixel(const Vec3& p) const {
  const Vec3 offset = p - center_;
  return {canvas_.width / 2.0 + dot(offset, axes_.right()) / mm_per_pixel_,
          canvas_.height / 2.0 + dot(offset, axes_.up) / mm_per_pixel_};
}

Place Scene::on_canvas(const std::array<double, 2>& pixel) const {
  return {pixel[0], canvas_.height - pixel[1]};
}

Vec3 Scene::as_seen(const Vec3& direction) const {
  return {dot(direction, axes_.right()), dot(direction, axes_.up), -dot(direction, axes_.forward)};
}

void Scene::fit(const CameraAxes& axes, std::span<const Vec3> points, const Margins& margins) {
  const auto across = extent_along(axes.right(), points);
  const auto upward = extent_along(axes.up, points);
  const auto deep = extent_along(axes.forward, points);
  const auto [width, height] = size();
  const double free_width = (1 - margins.left - margins.right) * width;
  const double free_height = (1 - margins.bottom - margins.top) * height;
  mm_per_pixel_ =
      std::max((across[1] - across[0]) / free_width, (upward[1] - upward[0]) / free_height);
  if (!(mm_per_pixel_ > 0)) mm_per_pixel_ = 1e-3;

  // The picture's centre, so that the object's centre is the free room's.
  const double x =
      (across[0] + across[1] - mm_per_pixel_ * (margins.left - margins.right) * width) / 2;
  const double y =
      (upward[0] + upward[1] - mm_per_pixel_ * (margins.bottom - margins.top) * height) / 2;
  axes_ = axes;
  center_ = x * axes.right() + y * axes.up + ((deep[0] + deep[1]) / 2) * axes.forward;
}

void Scene::zoom_in(double zoom, const std::optional<Vec3>& focus) {
  if (!(zoom > 0)) throw InputError("picture: expected a zoom above 0");
  mm_per_pixel_ /= zoom;
  // As deep as before, so that nothing is cut.
  if (focus) center_ = *focus + dot(center_ - *focus, axes_.forward) * axes_.forward;
}

void Scene::save(const std::filesystem::path& png) const { write_file(png, png_bytes(canvas_)); }

}  // namespace mesamis::detail::picture
