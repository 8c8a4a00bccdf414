// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "mesamis/base/types.h"
#include "mesamis/picture/raster.h"
#include "mesamis/picture/triangles.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::picture {

/// The orientation of the camera: orthogonal unit vectors, forward pointing away from the viewer.
struct CameraAxes {
  Vec3 forward, up;
  Vec3 right() const { return cross(forward, up); }
};

/// The camera of an anatomical view in LPS.
/// @param view  front, back, left, right, top, bottom or oblique.
/// @throws InputError  if the view is unknown; the message names the known ones.
CameraAxes camera_axes(const std::string& view);

/// Margins around the object, as shares of the picture's width and height.
struct Margins {
  double left = 0.05, right = 0.05, bottom = 0.09, top = 0.05;
};

/// A picture in parallel projection, so that one scale bar holds for all of it. What is drawn later
/// lies over what was drawn before.
class Scene {
 public:
  /// A white picture.
  /// @param pixels  width and height of the picture, 64 to 8192 each.
  /// @throws InputError  if the size is out of range.
  explicit Scene(const std::array<int, 2>& pixels);

  Raster& canvas() { return canvas_; }
  const CameraAxes& axes() const { return axes_; }
  /// Width and height, pixels.
  std::array<int, 2> size() const { return {canvas_.width, canvas_.height}; }
  /// Pixels per pixel of a picture of 1000 x 800; line widths and font sizes are multiples of it.
  double unit() const;
  double mm_per_pixel() const { return mm_per_pixel_; }
  /// Projects a point to pixels from the lower left corner.
  std::array<double, 2> to_pixel(const Vec3& p) const;
  /// The place in the canvas, whose rows run downwards, of pixels from the lower left corner.
  Place on_canvas(const std::array<double, 2>& pixel) const;
  /// A direction as seen: to the right, upwards, towards the viewer.
  Vec3 as_seen(const Vec3& direction) const;

  /// Places the camera so that the points fill the picture inside the margins.
  void fit(const CameraAxes& axes, std::span<const Vec3> points, const Margins& margins);
  /// Magnifies the view of fit().
  /// @param zoom   > 0.
  /// @param focus  centre of the picture, mm; default: as before.
  /// @throws InputError  if the zoom is not positive.
  void zoom_in(double zoom, const std::optional<Vec3>& focus);
  /// Writes a PNG, which appears whole or not at all.
  /// @throws InputError  if it cannot be written.
  void save(const std::filesystem::path& png) const;

 private:
  Raster canvas_;
  double mm_per_pixel_ = 1;
  Vec3 center_;
  CameraAxes axes_{{0, 1, 0}, {0, 0, 1}};
};

}  // namespace mesamis::detail::picture
