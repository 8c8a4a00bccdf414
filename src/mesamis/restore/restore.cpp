// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/restore.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "mesamis/image/grey_values.h"
#include "mesamis/restore/deblur.h"
#include "mesamis/restore/impulses.h"
#include "mesamis/restore/scan_quality.h"
#include "mesamis/restore/thick_places.h"
#include "mesamis/restore/thin_sheets.h"

namespace mesamis {
namespace {

constexpr std::size_t kMostPoints = 100'000;
/// Regularization per noise against contrast: found on phantoms, where half and twice as much
/// increase the distance to the truth by a tenth. It is divided by the blur's mean square, because
/// the filter measures frequencies in units of the blur, and the noise does not depend on the blur.
constexpr double kRegularization = 0.2, kLeastRegularization = 0.004, kMostRegularization = 1;
/// An impulse exceeds both the noise and a share of the contrast.
constexpr double kImpulseOfNoise = 5, kImpulseOfContrast = 0.25;
/// Fewer impulses than this are taken for small structures of the object.
constexpr double kFewImpulses = 1e-3;
/// Voxels: a smaller blur is the voxels' own extent.
constexpr double kSharp = 0.3;

double mean_square(const std::array<double, 3>& x) {
  return (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / 3;
}

/// The difference to its neighbours that makes a voxel an impulse, native units.
double impulse_height(double noise, double contrast) {
  return std::max(kImpulseOfNoise * noise, kImpulseOfContrast * contrast);
}

/// See deblurred().
double choose_regularization(double noise, double contrast, const std::array<double, 3>& blur) {
  return std::clamp(kRegularization * noise / contrast, kLeastRegularization, kMostRegularization) /
         mean_square(blur);
}

/// The smoothed image and the points of its surface: what measurements are guided by.
struct Guide {
  Volume image;
  std::vector<SurfacePoint> points;
};

Guide make_guide(const VolumeView& volume, double level) {
  Guide guide{smoothed(volume), {}};
  guide.points = crossing_points(guide.image, level, kMostPoints);
  return guide;
}

/// Undoes the blur that was found, also in thin sheets.
/// @param guide  the scan, smoothed.
void undo_blur(Restored& restored, const Volume& guide, const ObjectContrast& contrast) {
  const double largest = *std::max_element(restored.blur.begin(), restored.blur.end());
  if (!(largest > 0)) return;
  SheetOptions sheets{contrast, restored.blur, std::nullopt, restored.noise};
  if (largest > kSharp) {
    sheets.regularization =
        choose_regularization(restored.noise, contrast.difference(), restored.blur);
    restored.volume = deblurred(restored.volume, restored.blur, *sheets.regularization);
    restored.noise_left *= noise_gain(restored.blur, *sheets.regularization);
  }
  lift_thin_sheets(restored.volume, guide, sheets);
}

}  // namespace

Restored restore(Volume volume, const HalfMaximumLevel& object, const RestoreOptions& options) {
  Restored restored{std::move(volume), options.noise.value_or(0), 0,
                    options.blur.value_or(std::array<double, 3>{})};
  const double contrast = object.contrast.difference();
  if (!(contrast > 0)) return restored;
  Guide guide = make_guide(restored.volume, object.level);
  const auto noise_now = [&] {
    return measure_noise(restored.volume, guide.image, guide.points, object.level);
  };
  if (!options.noise) restored.noise = noise_now();
  WithoutImpulses clean = remove_impulses(std::move(restored.volume),
                                          impulse_height(restored.noise, contrast), kFewImpulses);
  restored.volume = std::move(clean.volume);
  if (clean.replaced > 0) {
    restored.impulses =
        static_cast<double>(clean.replaced) / static_cast<double>(restored.volume.voxel_count());
    guide = make_guide(restored.volume, object.level);
    if (!options.noise) restored.noise = noise_now();
  }
  if (!options.blur) {
    restored.blur =
        measure_blur(restored.volume, thick_places(guide.image, guide.points, object.level));
  }
  restored.noise_left = restored.noise;
  undo_blur(restored, guide.image, object.contrast);
  return restored;
}

}  // namespace mesamis
