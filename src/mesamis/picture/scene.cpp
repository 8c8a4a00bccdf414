// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/scene.h"

#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkPNGWriter.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <limits>
#include <map>

#include "mesamis/base/error.h"
#include "mesamis/files/atomic_file.h"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)

namespace mesamis::detail {
namespace {

constexpr int kMinPixels = 64, kMaxPixels = 8192;
constexpr int kMaxRenderedPixels = 8192;  // the largest texture any renderer has

Vec3 unit_vector(const Vec3& v) { return (1 / norm(v)) * v; }

vtkSmartPointer<vtkLight> camera_light(const Vec3& from, double intensity) {
  auto light = vtkSmartPointer<vtkLight>::New();
  light->SetLightTypeToCameraLight();
  light->SetPosition(from.x, from.y, from.z);
  light->SetFocalPoint(0, 0, 0);
  light->SetIntensity(intensity);
  return light;
}

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

/// Averages blocks of samples x samples pixels.
vtkSmartPointer<vtkImageData> average_down(vtkImageData& large, int samples) {
  const int* size = large.GetDimensions();
  auto small = vtkSmartPointer<vtkImageData>::New();
  small->SetDimensions(size[0] / samples, size[1] / samples, 1);
  small->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const int count = samples * samples;
  for (int y = 0; y < size[1] / samples; ++y) {
    for (int x = 0; x < size[0] / samples; ++x) {
      auto* to = static_cast<std::uint8_t*>(small->GetScalarPointer(x, y, 0));
      for (int c = 0; c < 3; ++c) {
        int sum = count / 2;
        for (int s = 0; s < count; ++s) {
          sum += static_cast<const std::uint8_t*>(
              large.GetScalarPointer(samples * x + s % samples, samples * y + s / samples, 0))[c];
        }
        to[c] = static_cast<std::uint8_t>(sum / count);
      }
    }
  }
  return small;
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

Scene::Scene(const std::array<int, 2>& pixels, const std::string& display)
    : renderer_(vtkSmartPointer<vtkRenderer>::New()), pixels_(pixels) {
  const auto [least, most] = std::minmax(pixels[0], pixels[1]);
  if (least < kMinPixels || most > kMaxPixels) {
    throw InputError("picture: size " + std::to_string(pixels[0]) + " x " +
                     std::to_string(pixels[1]) + ", expected " + std::to_string(kMinPixels) +
                     " to " + std::to_string(kMaxPixels) + " pixels each way");
  }
  samples_ = std::clamp(kMaxRenderedPixels / most, 1, 2);
  display_.emplace(display);
  window_ = vtkSmartPointer<vtkRenderWindow>::New();
  window_->SetDisplayId(display_->connection());
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(0);
  window_->SetSize(rendered_size()[0], rendered_size()[1]);
  renderer_->SetBackground(1, 1, 1);
  renderer_->AutomaticLightCreationOff();
  window_->AddRenderer(renderer_);
}

std::array<int, 2> Scene::rendered_size() const {
  return {samples_ * pixels_[0], samples_ * pixels_[1]};
}

double Scene::unit() const { return samples_ * std::min(pixels_[0] / 1000.0, pixels_[1] / 800.0); }

std::array<double, 2> Scene::to_pixel(const Vec3& p) const {
  const Vec3 offset = p - center_;
  return {rendered_size()[0] / 2.0 + dot(offset, axes_.right()) / mm_per_pixel_,
          rendered_size()[1] / 2.0 + dot(offset, axes_.up) / mm_per_pixel_};
}

void Scene::add_lights() {
  renderer_->AddLight(camera_light({-0.7, 0.9, 1.0}, 0.72));
  renderer_->AddLight(camera_light({0.9, -0.5, 0.6}, 0.22));
  renderer_->AddLight(camera_light({0, 0, 1}, 0.32));
}

void Scene::fit(const CameraAxes& axes, std::span<const Vec3> points, const Margins& margins) {
  const auto across = extent_along(axes.right(), points);
  const auto upward = extent_along(axes.up, points);
  const auto deep = extent_along(axes.forward, points);
  const auto [width, height] = rendered_size();
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
  depth_ = deep[1] - deep[0] + mm_per_pixel_ * height;
  axes_ = axes;
  center_ = x * axes.right() + y * axes.up + ((deep[0] + deep[1]) / 2) * axes.forward;
  place_camera();
}

void Scene::zoom_in(double zoom, const std::optional<Vec3>& focus) {
  if (!(zoom > 0)) throw InputError("picture: expected a zoom above 0");
  mm_per_pixel_ /= zoom;
  // As deep as before, so that nothing is cut.
  if (focus) center_ = *focus + dot(center_ - *focus, axes_.forward) * axes_.forward;
  place_camera();
}

void Scene::place_camera() {
  vtkCamera& camera = *renderer_->GetActiveCamera();
  const Vec3 eye = center_ - depth_ * axes_.forward;
  camera.ParallelProjectionOn();
  camera.SetFocalPoint(center_.x, center_.y, center_.z);
  camera.SetPosition(eye.x, eye.y, eye.z);
  camera.SetViewUp(axes_.up.x, axes_.up.y, axes_.up.z);
  camera.SetParallelScale(mm_per_pixel_ * rendered_size()[1] / 2);
  camera.SetClippingRange(depth_ / 4, 2 * depth_);
}

void Scene::save(const std::filesystem::path& png) {
  AtomicFile file(png);
  window_->Render();
  const auto grab = vtkSmartPointer<vtkWindowToImageFilter>::New();
  grab->SetInput(window_);
  grab->SetInputBufferTypeToRGB();
  grab->ReadFrontBufferOff();
  grab->ShouldRerenderOff();
  grab->Update();
  const auto writer = vtkSmartPointer<vtkPNGWriter>::New();
  writer->SetFileName(file.temporary_path().c_str());
  writer->SetInputData(average_down(*grab->GetOutput(), samples_));
  writer->Write();
  if (writer->GetErrorCode() != 0 || !messages_.first_error().empty()) {
    throw InputError(png.string() + ": cannot be drawn: " + messages_.first_error());
  }
  file.commit();
}

vtkSmartPointer<vtkActor> add_actor(Scene& scene, vtkPolyData* data, const Paint& paint) {
  const auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty& property = *actor->GetProperty();
  property.SetAmbient(0.14);
  property.SetDiffuse(0.88);
  property.SetColor(paint.r, paint.g, paint.b);
  scene.renderer().AddActor(actor);
  return actor;
}

}  // namespace mesamis::detail
