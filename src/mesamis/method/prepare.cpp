// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/prepare.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/restore/half_maximum_level.h"
#include "mesamis/restore/level_crossings.h"
#include "mesamis/restore/local_level.h"
#include "mesamis/restore/object_edge.h"
#include "mesamis/restore/restore.h"
#include "mesamis/restore/surface_extent.h"
#include "mesamis/restore/tissue_threshold.h"

namespace mesamis {
namespace {

/// Voxels: what is smaller cannot be told from noise.
constexpr double kDefaultMinVolume = 4;
/// The paper's T of (13), of 255 grey values.
constexpr double kPaperThreshold = 140;

/// A quarter of the box's longest side, in length units.
double default_h_max(const VoxelGrid& volume, double unit_mm) {
  const Vec3 extent = volume.box().extent();
  return std::max({extent.x, extent.y, extent.z}) / 4 / unit_mm;
}

/// Settings that are taken over, and those that follow from the volume's grid alone.
Parameters parameters_from_grid(const VoxelGrid& volume, const Settings& s) {
  Parameters p;
  p.unit_mm = s.length_unit == LengthUnit::kMm ? 1 : volume.voxel_size();
  p.stride = stride_of(s, volume.size, volume.spacing);
  p.functional.eta = s.epsilon * s.epsilon;
  p.h_max = std::max(s.h_min, default_h_max(volume, p.unit_mm));
  p.min_volume = kDefaultMinVolume * volume.voxel_volume();
  for (const Setting& setting : setting_table()) setting.use(s, p);
  return p;
}

/// How much surface a restored image has. Where its noise would make surface of its own, it is
/// smoothed before, and nothing thin can be told from noise.
SurfaceExtent measured_extent(const VolumeView& restored, double noise, double contrast,
                              double level) {
  constexpr double kQuiet = 0.1;  // of the contrast: noise reaches the level at five deviations
  if (noise < kQuiet * contrast) return measure_extent(restored, level);
  return {level_area(smoothed(restored), level), 0};
}

/// What restore() makes of the image; where restoring is off, the image as it is, with its noise.
Restored restore_if_asked(Volume image, const HalfMaximumLevel& object, const Settings& settings) {
  if (settings.restore) return restore(std::move(image), object, {settings.noise, settings.blur});
  constexpr std::array<double, 3> kNone{};
  Restored as_it_is = restore(image, object, {settings.noise, kNone});
  as_it_is.volume = std::move(image);
  as_it_is.noise_left = as_it_is.noise;
  as_it_is.impulses = 0;
  return as_it_is;
}

/// T of (13), in native units; the window's low end if it does not act.
/// @param measured  see find_tissue_threshold().
double choose_threshold(const Settings& settings, const GreyMap& map,
                        const std::optional<double>& measured, double level) {
  switch (settings.threshold_rule) {
    case ThresholdRule::kNone:
      return map.low;
    case ThresholdRule::kPaper:
      return map.to_native(kPaperThreshold);
    case ThresholdRule::kValue:
      return std::max(map.low, settings.threshold);
    case ThresholdRule::kAuto:
      break;
  }
  // A level below T would be everywhere: what the user asks to see comes first.
  return measured && *measured < level ? std::max(map.low, *measured) : map.low;
}

/// The level of the object's edge. Where T lies above it, T is the background that is left: midway
/// between T and the object.
double level_above(const GreyMap& map, const HalfMaximumLevel& object) {
  if (!map.has_threshold() || object.level > map.threshold) return object.level;
  return (map.threshold + object.contrast.object) / 2;
}

/// See default_gamma(); the paper's value where there is no object to tell the contrast from.
double choose_gamma(const Parameters& p, double native_contrast, double native_noise) {
  constexpr double kPaper = 0.1;
  const double grey_per_native = p.grey.grey_per_native();
  const double contrast = native_contrast * grey_per_native;
  if (!(contrast > 0)) return kPaper;
  return default_gamma(p.functional.epsilon, p.functional.beta, contrast,
                       native_noise * grey_per_native);
}

/// The restored image between its voxels, in grey values. It is bounded after it is interpolated: T
/// and the window's ends cut edges, whose place would move if only the samples were bounded.
SplineImage spline_image(const GreyMap& map, const VolumeView& restored) {
  Volume grey{restored, std::vector<float>(restored.samples.size())};
  parallel_for(grey.samples.size(), [&](std::size_t n) {
    grey.samples[n] = static_cast<float>(map.to_grey(restored.samples[n]));
  });
  SplineImage image = interpolating_spline(std::move(grey));
  image.low = static_cast<float>(std::max(0.0, map.to_grey(map.threshold)));
  image.high = 255;
  return image;
}

/// A level that no voxel, or every voxel, lies above has no surface, whatever the window is: it is
/// refused before any work.
void require_level_in_data(const VolumeView& volume, const Settings& settings) {
  if (!settings.level || settings.surface != SurfaceKind::kSolid) return;
  const auto [least, most] = sample_range(volume.samples);
  const double level = *settings.level;
  if (least < level && level < most) return;
  std::ostringstream message;
  message << "level: expected a value between the least and the greatest of the data, " << least
          << " to " << most << ", found " << level;
  throw InputError(message.str());
}

/// Settings that leave nothing to see, or nothing at the level, are refused.
void require_contrast(const VolumeView& volume, const Parameters& p) {
  const double level = p.level;
  const double low = p.grey.threshold, high = p.grey.high;
  const auto [least, most] = sample_range(volume.samples);
  const bool sees_samples = least < high && most > low;
  const bool sees_level = low < level && level < high;
  std::ostringstream message;
  if (!sees_samples) {
    message << "window: expected one that holds some of the samples, which go from " << least
            << " to " << most << ", found " << low << "," << high;
  } else if (p.surface == SurfaceKind::kSolid && !sees_level) {
    message << "level: expected a value between the window's ends and above the threshold, " << low
            << " to " << high << ", found " << level;
  }
  if (!message.str().empty()) throw InputError(message.str());
}

/// A choice, and the image that it was made from.
struct Chosen {
  ChosenParameters choice;
  Restored restored;
  LocalLevel local{};  ///< no samples: there is one level

  /// Takes what the level of each place exceeds the object's off the image.
  void level_out(double level) {
    const ObjectContrast& contrast = choice.object.contrast;
    if (!(contrast.difference() > 0)) return;
    local = find_local_level(restored.volume, contrast, level, restored.noise);
    take_off(local, restored.volume);
  }
};

Chosen choose(const VolumeView& volume, const VoxelGrid& whole, const Settings& settings) {
  require_level_in_data(volume, settings);
  Chosen chosen;
  Parameters& p = chosen.choice.parameters = parameters_from_grid(whole, settings);

  const HalfMaximumLevel seen = find_half_maximum_level(volume);
  if (seen.in_noise && !settings.level && settings.surface == SurfaceKind::kSolid) {
    throw InputError("level: found no object that stands out of the noise; expected --level");
  }
  const Window window = settings.window.value_or(
      window_with_room(volume, seen.contrast, settings.level.value_or(seen.level)));
  p.grey = {window.low, window.high, window.low};
  Volume scan = clamped(volume, window);
  const HalfMaximumLevel object = chosen.choice.object = find_object_edge(scan, seen);

  const Restored& restored = chosen.restored = restore_if_asked(std::move(scan), object, settings);
  p.noise = restored.noise;
  p.blur = restored.blur;
  chosen.choice.impulse_height = restored.impulse_height;

  if (p.local_level) chosen.level_out(settings.level.value_or(object.level));
  const auto measured = find_tissue_threshold(volume, seen.contrast, seen.level, restored.noise);
  p.grey.threshold =
      choose_threshold(settings, p.grey, measured, settings.level.value_or(object.level));
  p.level = settings.level.value_or(level_above(p.grey, object));
  const double contrast = object.contrast.difference();
  chosen.choice.measured = {restored.noise_left,
                            restored.noise_correlation,
                            restored.impulses,
                            contrast,
                            settings.level ? 0 : object.uncertainty,
                            chosen.local.range};
  if (!settings.max_tets && !settings.preview) {
    const SurfaceExtent extent =
        measured_extent(restored.volume, restored.noise_left, contrast, p.level);
    p.max_tets = default_max_tets(extent.area, extent.thin_share, volume.spacing, p.accuracy);
  }
  if (!settings.gamma) {
    p.functional.gamma = choose_gamma(p, contrast, restored.noise_left);
  }
  require_contrast(restored.volume, p);
  return chosen;
}

/// @param restored  in native units; taken over.
Prepared prepared_from(const ChosenParameters& choice, Volume restored) {
  const GreyMap& map = choice.parameters.grey;
  Prepared prepared{choice.parameters, choice.measured, {}, spline_image(map, restored)};
  prepared.grey = apply(map, std::move(restored));
  return prepared;
}

}  // namespace

std::array<Index, 3> first_grid_size(const std::array<Index, 3>& voxels,
                                     const std::array<Index, 3>& stride) {
  std::array<Index, 3> size;
  for (std::size_t a = 0; a < 3; ++a) size[a] = std::max(2, (voxels[a] - 1) / stride[a] + 1);
  return size;
}

Prepared prepare_image(const VolumeView& volume, const Settings& settings) {
  Chosen chosen = choose(volume, volume, settings);
  Prepared prepared = prepared_from(chosen.choice, std::move(chosen.restored.volume));
  prepared.excess = std::move(chosen.local.excess);
  const double scale = prepared.parameters.grey.grey_per_native();
  for (float& value : prepared.excess.samples) value = static_cast<float>(scale * value);
  return prepared;
}

ChosenParameters choose_parameters(const VolumeView& part, const VoxelGrid& whole,
                                   const Settings& settings) {
  return choose(part, whole, settings).choice;
}

Prepared prepare_slab(const VolumeView& slab, const ChosenParameters& choice) {
  const Parameters& p = choice.parameters;
  Volume scan = clamped(slab, {p.grey.low, p.grey.high});
  if (!p.restore) return prepared_from(choice, std::move(scan));
  Restored restored =
      restore(std::move(scan), choice.object, {p.noise, p.blur, choice.impulse_height});
  return prepared_from(choice, std::move(restored.volume));
}

SurfaceExtent extent_of(const Prepared& slab) {
  const Parameters& p = slab.parameters;
  const double scale = p.grey.grey_per_native();
  return measured_extent(slab.grey, slab.measured.noise_left * scale,
                         slab.measured.contrast * scale, p.grey.to_grey(p.level));
}

}  // namespace mesamis
