// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/choose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fit/close_tunnels.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/restore/level_crossings.h"
#include "mesamis/restore/local_level.h"
#include "mesamis/restore/object_edge.h"
#include "mesamis/restore/surface_extent.h"
#include "mesamis/restore/tissue_threshold.h"

namespace mesamis::detail::method {
namespace {

/// Voxels: what is smaller cannot be told from noise.
constexpr double kDefaultMinVolume = 4;
/// The paper's T of (13), of 255 grey values.
constexpr double kPaperThreshold = 140;
/// Half the contrast at a place, of that of the object.
constexpr double kLeastHalf = 0.1;

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

/// What the user says of noise and blur comes before what the whole scan shows.
RestoreOptions restore_options(const ImageSettings& settings) {
  RestoreOptions options = settings.scan ? settings.scan->options() : RestoreOptions{};
  if (settings.asked.noise) options.noise = settings.asked.noise;
  if (settings.asked.blur) options.blur = settings.asked.blur;
  return options;
}

/// What restore() makes of the image; where restoring is off, the image as it is, with its noise.
Restored restore_if_asked(Volume image, const HalfMaximumLevel& object,
                          const ImageSettings& settings) {
  RestoreOptions options = restore_options(settings);
  if (settings.asked.restore) return restore::restore(std::move(image), object, options);
  options.blur = std::array<double, 3>{};
  options.impulse_height = std::nullopt;
  Restored as_it_is = restore::restore(image, object, options);
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

/// The level of the object's edge, here or in the whole scan. Where T lies above one that was
/// measured, T is the background that is left: midway between T and the object.
double level_above(const GreyMap& map, const std::optional<KnownLevel>& known,
                   const HalfMaximumLevel& object) {
  const double level = known ? known->value : object.level;
  const bool measured =
      !known || known->from == LevelSource::kScan || known->from == LevelSource::kCrop;
  if (!measured || !map.has_threshold() || level > map.threshold) return level;
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

/// The least and the greatest of the samples, in units of the scan.
Window range_of_data(const VolumeView& volume, const ImageUnits& units) {
  const auto [least, most] = sample_range(volume.samples);
  return units.turned(Window{least, most});
}

/// A level that no voxel, or every voxel, lies above has no surface, whatever the window is: it is
/// refused before any work.
void require_level_in_data(const VolumeView& volume, const ImageSettings& settings) {
  if (!settings.level || settings.asked.surface != SurfaceKind::kSolid) return;
  const auto [least, most] = range_of_data(volume, settings.units);
  const double level = settings.units.turned(settings.level->value);
  if (least < level && level < most) return;
  std::ostringstream message;
  message << "level: expected a value between the least and the greatest of the data, " << least
          << " to " << most << ", found " << level;
  throw InputError(message.str());
}

/// Settings that leave nothing to see, or nothing at the level, are refused.
void require_contrast(const VolumeView& volume, const Parameters& p,
                      const ImageSettings& settings) {
  const auto [least, most] = sample_range(volume.samples);
  const bool sees_samples = least < p.grey.high && most > p.grey.threshold;
  const bool sees_level = p.grey.threshold < p.level && p.level < p.grey.high;
  const auto [low, high] = settings.units.turned(Window{p.grey.threshold, p.grey.high});
  const Window data = settings.units.turned(Window{least, most});
  std::ostringstream message;
  if (!sees_samples) {
    message << "window: expected a range that contains samples, which lie between " << data.low
            << " and " << data.high << ", found " << low << "," << high;
    if (!settings.asked.window) message << ", chosen from the scan: --window LOW,HIGH sets it";
  } else if (p.surface == SurfaceKind::kSolid && !sees_level) {
    message << "level: expected a value between the window's ends and above the threshold, " << low
            << " to " << high << ", found " << settings.units.turned(p.level);
  }
  if (!message.str().empty()) throw InputError(message.str());
}

/// A preview makes no cells.
bool cells_are_open(const Parameters& p) { return p.max_tets == 0 && !p.preview; }

/// The level that is known, or one that was measured.
double level_or(const ImageSettings& settings, double measured) {
  return settings.level ? settings.level->value : measured;
}

/// Takes what the level of each place exceeds the object's off the image.
LocalLevel level_out(Restored& restored, const ObjectContrast& contrast, double level,
                     const std::optional<double>& share) {
  if (!(contrast.difference() > 0)) return {};
  LocalLevel local =
      find_local_level(restored.volume, contrast, level, {restored.noise_left, share});
  take_off(local.excess, restored.volume);
  return local;
}

/// Lowers the level where a faint sheet closes a tunnel through a thin wall.
/// @param excess    of the level of each place; gets less.
/// @param levelled  the image less the excess; rises by as much.
/// @return how many sheets there are.
std::int64_t lower_at_tunnels(Volume& excess, const ObjectContrast& contrast, double level,
                              Volume& levelled) {
  const auto half = [&](std::size_t n) {
    return std::max(level + excess.samples[n] - contrast.background,
                    kLeastHalf * contrast.difference());
  };
  Volume height{excess, std::vector<float>(excess.samples.size())};
  parallel_for(height.samples.size(), [&](std::size_t n) {
    height.samples[n] = static_cast<float>((levelled.samples[n] - level) / half(n));
  });
  const TunnelLift found = find_tunnel_lift(std::move(height));
  if (found.sheets == 0) return 0;
  parallel_for(excess.samples.size(), [&](std::size_t n) {
    const auto lift = static_cast<float>(half(n) * found.lift.samples[n]);
    excess.samples[n] -= lift;
    levelled.samples[n] += lift;
  });
  return found.sheets;
}

/// The window and the object that is seen in it.
struct Seen {
  HalfMaximumLevel object;  ///< through all of the surface
  Window window;
};

Seen look_at(const VolumeView& image, const ImageSettings& settings) {
  if (const auto& scan = settings.scan) {
    return {scan->object.seen, settings.asked.window.value_or(scan->object.window)};
  }
  const HalfMaximumLevel seen = find_half_maximum_level(image);
  if (seen.in_noise && !settings.level && settings.asked.surface == SurfaceKind::kSolid) {
    throw InputError("level: found no object that stands out from the noise; expected --level");
  }
  return {seen, settings.asked.window.value_or(
                    window_with_room(image, seen.contrast, level_or(settings, seen.level)))};
}

/// What was found out about the image beside the parameters.
MeasuredImage measured_of(const Restored& restored, const HalfMaximumLevel& object,
                          const ImageSettings& settings) {
  return {restored.noise_left,
          restored.noise_correlation,
          restored.surface_noise,
          restored.impulses,
          object.contrast.difference(),
          settings.level ? settings.level->uncertainty : object.uncertainty};
}

ChosenImage choose_but_cells(const VolumeView& image, const VoxelGrid& whole,
                             const ImageSettings& settings) {
  require_level_in_data(image, settings);
  const Settings& asked = settings.asked;
  const auto [seen, window] = look_at(image, settings);
  Volume scan = clamped(image, window);
  const HalfMaximumLevel object =
      settings.scan ? settings.scan->object.object : find_object_edge(scan, seen);
  Restored restored = restore_if_asked(std::move(scan), object, settings);

  ChosenImage found{{parameters_from_grid(whole, asked), {}, object, restored.impulse_height}, {}};
  Parameters& p = found.chosen.parameters;
  p.grey = {window.low, window.high, window.low};
  p.noise = restored.noise;
  p.blur = restored.blur;
  const double level = level_or(settings, object.level);
  MeasuredImage& measured = found.chosen.measured;
  measured = measured_of(restored, object, settings);
  p.local_level = p.local_level && is_likely_bone(image, level);
  if (p.local_level) {
    const auto share = settings.scan ? settings.scan->level_share : std::nullopt;
    LocalLevel local = level_out(restored, object.contrast, level, share);
    measured.level_range = local.range;
    found.excess = std::move(local.excess);
  }
  if (measured.has_local_levels() && !asked.keep_topology) {
    measured.closed_tunnels =
        lower_at_tunnels(found.excess, object.contrast, level, restored.volume);
  }
  const auto threshold = find_tissue_threshold(image, seen.contrast, seen.level, restored.noise);
  p.grey.threshold = choose_threshold(asked, p.grey, threshold, level);
  p.level = level_above(p.grey, settings.level, object);
  if (!asked.gamma) {
    p.functional.gamma = choose_gamma(p, object.contrast.difference(), restored.noise_left);
  }
  require_contrast(restored.volume, p, settings);
  found.restored = std::move(restored.volume);
  return found;
}

}  // namespace

ChosenImage choose(const VolumeView& image, const ImageSettings& settings) {
  ChosenImage found = choose_but_cells(image, image, settings);
  Parameters& p = found.chosen.parameters;
  if (!cells_are_open(p)) return found;
  const MeasuredImage& measured = found.chosen.measured;
  const LevelInNoise object{p.level, measured.contrast, measured.noise_left};
  choose_max_tets(p, cells_of_image(found.restored, object, p.accuracy));
  return found;
}

ChosenImage choose_from_part(const VolumeView& part, const VoxelGrid& whole,
                             const ImageSettings& settings) {
  return choose_but_cells(part, whole, settings);
}

double cells_of_image(const VolumeView& image, const LevelInNoise& object, double accuracy) {
  constexpr double kQuiet = 0.1;  // of the contrast: noise reaches the level at five deviations
  const SurfaceExtent extent = object.noise < kQuiet * object.contrast
                                   ? measure_extent(image, object.level)
                                   : SurfaceExtent{level_area(smoothed(image), object.level), 0};
  return cells_for_surface(extent.area, extent.thin_share, image.spacing, accuracy);
}

void choose_max_tets(Parameters& p, double cells, Index slabs) {
  if (!cells_are_open(p)) return;
  p.max_tets =
      std::llround(std::clamp<double>(cells, kFewestTets, static_cast<double>(kMostTets) * slabs));
}

void choose_tolerance(Parameters& p, double voxel, double expected_error, double errors) {
  constexpr double kLeast = 0.0168, kMost = 0.056, kFinest = 0.01;  // voxels
  if (p.tolerance) return;
  if (p.triangles > 0) {
    p.tolerance = std::numeric_limits<double>::infinity();
  } else if (p.accuracy > 0) {
    p.tolerance = std::max(p.accuracy / 2, kFinest * voxel);
  } else {
    p.tolerance = errors * std::clamp(expected_error, kLeast * voxel, kMost * voxel);
  }
}

}  // namespace mesamis::detail::method
