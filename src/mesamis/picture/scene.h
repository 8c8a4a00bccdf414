// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "mesamis/base/types.h"
#include "mesamis/picture/display.h"
#include "mesamis/picture/vtk_messages.h"

namespace mesamis::detail {

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

/// An off-screen picture in parallel projection, so that one scale bar holds for all of it.
/// It is rendered at up to twice its size and averaged down, for smooth edges on any renderer.
class Scene {
 public:
  /// @param pixels   width and height of the picture, 64 to 8192 each.
  /// @param display  X display to render on, see Display.
  /// @throws InputError    if the size is out of range.
  /// @throws DisplayError  if the display cannot be used.
  Scene(const std::array<int, 2>& pixels, const std::string& display);

  vtkRenderer& renderer() { return *renderer_; }
  /// Width and height of the image that is rendered, pixels.
  std::array<int, 2> rendered_size() const;
  /// Rendered pixels per pixel of a picture of 1000 x 800; line widths and font sizes are multiples
  /// of it.
  double unit() const;
  /// Of the rendered image.
  double mm_per_pixel() const { return mm_per_pixel_; }
  /// Projects a point to rendered pixels from the lower left corner.
  std::array<double, 2> to_pixel(const Vec3& p) const;

  /// Adds a key light from the upper left, a weaker one from below right, and a headlight.
  void add_lights();
  /// Places the camera so that the points fill the picture inside the margins.
  void fit(const CameraAxes& axes, std::span<const Vec3> points, const Margins& margins);
  /// Magnifies the view of fit().
  /// @param zoom   > 0.
  /// @param focus  centre of the picture, mm; default: as before.
  /// @throws InputError  if the zoom is not positive.
  void zoom_in(double zoom, const std::optional<Vec3>& focus);
  /// Renders and writes a PNG, which appears whole or not at all.
  /// @throws InputError  if it cannot be rendered or written.
  void save(const std::filesystem::path& png);

 private:
  void place_camera();

  // The order matters: the window must be destroyed before its display is closed.
  VtkMessages messages_;
  std::optional<Display> display_;
  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkRenderWindow> window_;
  std::array<int, 2> pixels_;
  int samples_;  // rendered pixels per pixel of the file, per direction
  double mm_per_pixel_ = 1, depth_ = 1;
  Vec3 center_;
  CameraAxes axes_;
};

struct Paint {
  double r, g, b;  ///< 0 to 1
};

/// Adds polygons or lines in one colour; scalars that they have are not shown.
vtkSmartPointer<vtkActor> add_actor(Scene& scene, vtkPolyData* data, const Paint& paint);

}  // namespace mesamis::detail
