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
#include "mesamis/io/detail/display.h"
#include "mesamis/io/detail/vtk_messages.h"

namespace mesamis::detail {

/// Where a picture is seen from: unit vectors, forward pointing away from the viewer.
struct Sight {
  Vec3 forward, up;
  Vec3 right() const { return cross(forward, up); }
};

/// A named anatomical view in LPS: front back left right top bottom oblique.
/// @throws InputError  naming the views there are.
Sight sight_of(const std::string& view);

/// Room kept free around the object, as shares of the picture's width and height.
struct Margins {
  double left = 0.05, right = 0.05, bottom = 0.09, top = 0.05;
};

/// An off-screen picture in parallel projection, so that one scale bar holds for all of it.
/// Everything is drawn larger than asked for and averaged down: smooth edges on any renderer.
class Scene {
 public:
  /// @throws InputError  without a display, or for a picture of absurd size.
  explicit Scene(const std::array<int, 2>& pixels);

  vtkRenderer& renderer() { return *renderer_; }
  /// Size of what is rendered, and how many of its pixels stand for one of a 1000 x 800 picture:
  /// line widths and letters are multiples of it.
  std::array<int, 2> rendered_size() const;
  double unit() const;
  double mm_per_pixel() const { return mm_per_pixel_; }
  /// Where a point of space lands, in rendered pixels from the lower left corner.
  std::array<double, 2> to_pixel(const Vec3& p) const;

  /// A key light from the upper left, a weaker one from below right, one from the viewer.
  void add_lights();
  /// Points the camera so that all points fill the picture inside the margins.
  void fit(const Sight& sight, std::span<const Vec3> points, const Margins& margins);
  /// After fit(): closer, `zoom` times as large, around a point if one is given.
  void approach(double zoom, const std::optional<Vec3>& focus);
  /// Renders and writes a PNG; the file appears whole or not at all.
  void save(const std::filesystem::path& png);

 private:
  void place_camera();

  // In this order: the window must be gone before its display is closed.
  SilentStderr silent_;
  VtkMessages messages_;
  XDisplay display_;
  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkRenderWindow> window_;
  std::array<int, 2> pixels_;
  int samples_;  // rendered pixels per pixel of the file, per direction
  double mm_per_pixel_ = 1, depth_ = 1;
  Vec3 center_;
  Sight sight_;
};

}  // namespace mesamis::detail
