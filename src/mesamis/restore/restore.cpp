// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/restore.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mesamis/image/grey_values.h"
#include "mesamis/restore/deblur.h"
#include "mesamis/restore/impulses.h"
#include "mesamis/restore/scan_quality.h"
#include "mesamis/restore/thick_places.h"
#include "mesamis/restore/thin_sheets.h"

namespace mesamis::detail::restore {
namespace {

constexpr std::size_t kMostPoints = 100'000;
/// An impulse exceeds both the noise and a share of the contrast.
constexpr double kImpulseOfNoise = 5, kImpulseOfContrast = 0.25;
/// Fewer impulses than this are taken for small structures of the object.
constexpr double kFewImpulses = 1e-3;
/// Square of the blur that is worth undoing, square voxels.
constexpr double kWorthwhile = 0.01;

double mean_square(const std::array<double, 3>& x) {
  return (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / 3;
}

/// The difference to its neighbours that makes a voxel an impulse, native units.
double impulse_height(double noise, double contrast) {
  return std::max(kImpulseOfNoise * noise, kImpulseOfContrast * contrast);
}

/// The r of deblurred(): the noise's spectrum against that of the object's surfaces, which goes
/// with the square of noise over contrast, as in every Wiener filter. The filter counts frequencies
/// in units of what it undoes; the noise depends neither on that nor on the blur. The factor was
/// found on phantoms and scans thinned from their full resolution.
/// @param blur, undone  mean squares over the axes: of the scan's blur, and of what is undone.
double choose_regularization(double noise, double contrast, double blur, double undone) {
  constexpr double kFactor = 2, kLeast = 0.002, kMost = 2;
  const double power = std::clamp(kFactor * (noise / contrast) * (noise / contrast), kLeast, kMost);
  return power * blur / (undone * undone);
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

/// @return whether there were any; then height and share are set.
bool remove_impulses(Restored& restored, double height, double least_share) {
  if (!(height > 0)) return false;
  WithoutImpulses clean = restore::remove_impulses(std::move(restored.volume), height, least_share);
  restored.volume = std::move(clean.volume);
  if (clean.replaced == 0) return false;
  restored.impulse_height = height;
  restored.impulses =
      static_cast<double>(clean.replaced) / static_cast<double>(restored.volume.voxel_count());
  return true;
}

/// What is undone of the blur, voxels. The rest is about that of a spline through samples that are
/// means over their own extent: an image that is sharper swings between them.
std::array<double, 3> undoable(const std::array<double, 3>& blur) {
  constexpr double kLeft = 0.35;
  std::array<double, 3> undone{};
  for (std::size_t a = 0; a < 3; ++a) {
    undone[a] = std::sqrt(std::max(0.0, blur[a] * blur[a] - kLeft * kLeft));
  }
  return undone;
}

/// What means along the surface have of the noise, after a blur was undone.
void find_surface_noise(Restored& restored, const std::array<double, 3>& undone,
                        double regularization) {
  restored.surface_noise =
      noise_gain_along_surface(undone, regularization, restored.noise_correlation);
  for (double& along : restored.surface_noise) along *= restored.noise;
}

/// Undoes the blur that was found, also in thin sheets.
/// @param guide  the scan, smoothed.
void undo_blur(Restored& restored, const Volume& guide, const ObjectContrast& contrast) {
  const double square = mean_square(restored.blur);
  SheetOptions sheets{.contrast = contrast, .blur = restored.blur, .noise = restored.noise};
  const std::array<double, 3> undone = undoable(restored.blur);
  const double undone_square = mean_square(undone);
  if (undone_square > kWorthwhile) {
    sheets.undone = undone;
    sheets.regularization =
        choose_regularization(restored.noise, contrast.difference(), square, undone_square);
    restored.volume = deblurred(std::move(restored.volume), undone, *sheets.regularization);
    restored.noise_left *= noise_gain(undone, *sheets.regularization);
  }
  find_surface_noise(restored, sheets.undone, sheets.regularization.value_or(1));
  if (square > 0) lift_thin_sheets(restored.volume, guide, sheets);
}

/// Removes the impulses of a volume and measures what the options leave open.
Guide clean(Restored& restored, const HalfMaximumLevel& object, const RestoreOptions& options) {
  Guide guide = make_guide(restored.volume, object.level);
  const auto noise_now = [&] {
    return measure_noise(restored.volume, guide.image, guide.points, object.level);
  };
  if (!options.noise) restored.noise = noise_now();
  const double height =
      options.impulse_height.value_or(impulse_height(restored.noise, object.contrast.difference()));
  if (remove_impulses(restored, height, options.impulse_height ? 0 : kFewImpulses)) {
    guide = make_guide(restored.volume, object.level);
    if (!options.noise) restored.noise = noise_now();
  }
  if (!options.blur) {
    restored.blur =
        measure_blur(restored.volume, thick_places(guide.image, guide.points, object.level).points);
  }
  return guide;
}

}  // namespace

std::optional<ScanMeasure> measure_scan(const VolumeView& scan, const SeenObject& object) {
  const bool stands_out = !object.seen.in_noise && object.object.contrast.difference() > 0;
  if (!stands_out) return std::nullopt;
  Restored restored;
  restored.volume = clamped(scan, object.window);
  clean(restored, object.object, {});
  return ScanMeasure{object, restored.noise, restored.blur, restored.impulse_height};
}

Restored restore(Volume volume, const HalfMaximumLevel& object, const RestoreOptions& options) {
  Restored restored;
  restored.volume = std::move(volume);
  restored.noise = options.noise.value_or(0);
  restored.blur = options.blur.value_or(std::array<double, 3>{});
  require_valid_blur(restored.blur);
  if (!(object.contrast.difference() > 0)) {
    if (!options.noise) restored.noise = measure_noise(restored.volume);
    restored.noise_left = restored.noise;
    find_surface_noise(restored, {}, 1);
    return restored;
  }
  const Guide guide = clean(restored, object, options);
  restored.noise_correlation =
      measure_noise_correlation(restored.volume, guide.image, guide.points, object.level);
  restored.noise_left = restored.noise;
  undo_blur(restored, guide.image, object.contrast);
  return restored;
}

}  // namespace mesamis::detail::restore
