// SPDX-License-Identifier: Apache-2.0
#include <vtkCellArray.h>
#include <vtkImageActor.h>
#include <vtkImageData.h>
#include <vtkImageMapper3D.h>
#include <vtkImageProperty.h>
#include <vtkPoints.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>

#include "mesamis/base/error.h"
#include "mesamis/picture/annotation.h"
#include "mesamis/picture/color_scale.h"
#include "mesamis/picture/picture.h"
#include "mesamis/picture/scene.h"
#include "mesamis/picture/slice.h"

namespace mesamis {

using namespace detail;

namespace {

constexpr Paint kOutline{1.0, 0.42, 0.05};

vtkSmartPointer<vtkImageData> slice_image(const Volume& volume, const SlicePlane& plane,
                                          const ValueRange& window) {
  const auto [right, up, deep] = plane.axis;
  const std::array<Index, 2> size{volume.size[static_cast<std::size_t>(right)],
                                  volume.size[static_cast<std::size_t>(up)]};
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size[0], size[1], 1);
  image->SetSpacing(volume.spacing[right], volume.spacing[up], 1);
  image->SetOrigin(plane.sign[0] < 0 ? -(size[0] - 1) * volume.spacing[right] : 0,
                   plane.sign[1] < 0 ? -(size[1] - 1) * volume.spacing[up] : 0, 0);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::array<Index, 3> voxel{};
  voxel[static_cast<std::size_t>(deep)] = plane.index;
  for (Index y = 0; y < size[1]; ++y) {
    voxel[static_cast<std::size_t>(up)] = plane.sign[1] < 0 ? size[1] - 1 - y : y;
    for (Index x = 0; x < size[0]; ++x) {
      voxel[static_cast<std::size_t>(right)] = plane.sign[0] < 0 ? size[0] - 1 - x : x;
      const double value = volume.at(voxel[0], voxel[1], voxel[2]);
      const Rgb rgb =
          grey(std::isfinite(value) ? (value - window.lo) / (window.hi - window.lo) : 0);
      std::copy(rgb.begin(), rgb.end(),
                static_cast<std::uint8_t*>(image->GetScalarPointer(x, y, 0)));
    }
  }
  return image;
}

void add_image(Scene& scene, vtkImageData* image) {
  const auto actor = vtkSmartPointer<vtkImageActor>::New();
  actor->GetMapper()->SetInputData(image);
  actor->GetProperty()->SetInterpolationTypeToLinear();
  scene.renderer().AddActor(actor);
}

void add_outline(Scene& scene, const std::vector<std::array<Vec3, 2>>& segments) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  const auto lines = vtkSmartPointer<vtkCellArray>::New();
  const double lift = scene.mm_per_pixel();  // in front of the image
  for (const auto& [a, b] : segments) {
    const vtkIdType ends[2] = {points->InsertNextPoint(a.x, a.y, lift),
                               points->InsertNextPoint(b.x, b.y, lift)};
    lines->InsertNextCell(2, ends);
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  const auto actor = add_actor(scene, data, kOutline);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(static_cast<float>(1.6 * scene.unit()));
}

void add_side_ticks(Scene& scene, const std::array<std::vector<SideTick>, 2>& ticks,
                    const Vec3& corner) {
  for (const SideTick& tick : ticks[0]) {
    add_tick(scene, scene.to_pixel({tick.at, corner.y, 0}), true, tick.text);
  }
  for (const SideTick& tick : ticks[1]) {
    add_tick(scene, scene.to_pixel({corner.x, tick.at, 0}), false, tick.text);
  }
}

ValueRange window_of(const Volume& volume, const PictureOptions& options) {
  if (!options.window) return slice_window(volume);
  const auto [low, high] = *options.window;
  if (low < high && std::isfinite(low) && std::isfinite(high)) return {low, high};
  throw InputError("picture: expected a window from low to high, found " + short_number(low) +
                   " to " + short_number(high));
}

/// Adds the letters of the body's sides around the slice, beyond its ticks.
void add_side_letters(Scene& scene, const SlicePlane& plane, const std::array<Vec3, 2>& corners) {
  const auto lo = scene.to_pixel(corners[0]), hi = scene.to_pixel(corners[1]);
  const double gap = 18 * scene.unit(), left = 62 * scene.unit(), below = 36 * scene.unit();
  const double x = (lo[0] + hi[0]) / 2, y = (lo[1] + hi[1]) / 2;
  const std::array<std::array<double, 2>, 4> places{
      {{lo[0] - left, y}, {hi[0] + gap, y}, {x, lo[1] - below}, {x, hi[1] + gap}}};
  for (std::size_t i = 0; i < 4; ++i) {
    add_label(scene, {std::string(1, plane.letters[i]), places[i], Align::kCenter, 20, true});
  }
}

std::string slice_label(const Volume& volume, const SlicePlane& plane, int axis) {
  constexpr std::array<const char*, 3> kNames{"sagittal  x = ", "coronal  y = ", "axial  z = "};
  return kNames[static_cast<std::size_t>(axis)] + short_number(plane.position) + " mm   slice " +
         std::to_string(plane.index + 1) + " of " +
         std::to_string(volume.size[static_cast<std::size_t>(plane.axis[2])]);
}

}  // namespace

void draw_slice(const std::filesystem::path& png, const Volume& volume, const TriMesh* surface,
                const PictureOptions& options) {
  require_usable(volume);
  const int axis = options.clip ? options.clip->axis : 2;
  const SlicePlane plane =
      slice_plane(volume, axis, options.clip ? &options.clip->position : nullptr);
  const ColorBar bar{volume.modality == "CT" ? "HU" : "value", window_of(volume, options), grey};
  Scene scene(options.pixels, options.display);
  const auto image = slice_image(volume, plane, bar.range);
  double bounds[6];
  image->GetBounds(bounds);
  const std::array<Vec3, 2> corners{Vec3{bounds[0], bounds[2], 0}, Vec3{bounds[1], bounds[3], 0}};
  scene.fit({{0, 0, -1}, {0, 1, 0}}, corners, {0.09, kColorBarMargin, 0.14, 0.06});
  add_image(scene, image);
  if (surface != nullptr) add_outline(scene, outline(volume, plane, *surface));
  add_side_ticks(scene, side_ticks(volume, plane), corners[0]);
  add_side_letters(scene, plane, corners);
  add_color_bar(scene, bar);
  add_scale_bar(scene);
  add_corner_label(scene, slice_label(volume, plane, axis));
  scene.save(png);
}

}  // namespace mesamis
