// SPDX-License-Identifier: Apache-2.0
#include "mesamis/prepare.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/image/edge_sides.h"
#include "mesamis/image/restore.h"

namespace mesamis {
namespace {

/// A quarter of the box's longest side, in length units.
double default_h_max(const Volume& volume, double unit_mm) {
  const Vec3 extent = volume.box().extent();
  return std::max({extent.x, extent.y, extent.z}) / 4 / unit_mm;
}

/// The default, widened where the level has not room for an edge on both its sides.
Window choose_window(const Volume& volume, const EdgeSides& sides, double level) {
  const Window window = default_window(volume, sides.outside);
  const double room = std::abs(sides.inside - sides.outside) / 2;
  return {std::min(window.low, level - room), std::max(window.high, level + room)};
}

/// Beyond the window nothing is seen: what lies there (air, metal) must not ring when the blur is
/// undone, nor count as noise.
Volume clamped(Volume volume, const Window& window) {
  const auto low = static_cast<float>(window.low), high = static_cast<float>(window.high);
  for (float& x : volume.samples) x = std::clamp(x, low, high);
  return volume;
}

/// T of (13), in native units; nothing if it would not act.
std::optional<double> choose_threshold(const Settings& settings, double found, double level) {
  const ThresholdRule rule = settings.threshold_rule;
  const double t = rule == ThresholdRule::kAuto ? found : settings.threshold;
  if (rule == ThresholdRule::kNone || !(t > settings.window->low)) return std::nullopt;
  // A level below T would be everywhere: what the user asks to see comes first.
  if (rule == ThresholdRule::kAuto && t >= level) return std::nullopt;
  return t;
}

/// See default_gamma(); the paper's value where there is no object to tell the contrast from.
double choose_gamma(const Prepared& prepared, const EdgeSides& sides) {
  constexpr double kPaper = 0.1;
  const double grey_per_native = prepared.map.to_grey(1) - prepared.map.to_grey(0);
  const double contrast = sides.contrast() * grey_per_native;
  if (!(contrast > 0)) return kPaper;
  const Settings& s = prepared.settings;
  return default_gamma(s.epsilon, s.beta, contrast, prepared.noise_left * grey_per_native);
}

/// Settings that leave nothing to see, or nothing at the level, are refused.
void require_contrast(const Volume& volume, const Prepared& prepared) {
  const Settings& settings = prepared.settings;
  const double low = prepared.threshold_used ? prepared.map.threshold : settings.window->low;
  const double high = settings.window->high, level = prepared.level_native;
  const auto [least, most] = std::minmax_element(volume.samples.begin(), volume.samples.end());
  const bool sees_samples = *least<high&& * most> low;
  const bool sees_level = low < level && level < high;
  std::ostringstream message;
  if (!sees_samples) {
    message << "window: expected one that holds some of the samples, which go from " << *least
            << " to " << *most << ", found " << low << "," << high;
  } else if (settings.surface == SurfaceKind::kSolid && !sees_level) {
    message << "level: expected a value between the window's ends and above the threshold, " << low
            << " to " << high << ", found " << level;
  }
  if (!message.str().empty()) throw InputError(message.str());
}

}  // namespace

std::array<Index, 3> first_grid_size(const std::array<Index, 3>& voxels,
                                     const std::array<Index, 3>& stride) {
  std::array<Index, 3> size;
  for (std::size_t a = 0; a < 3; ++a) size[a] = std::max(2, (voxels[a] - 1) / stride[a] + 1);
  return size;
}

Prepared prepare_image(const Volume& volume, const Settings& settings) {
  Prepared prepared;
  prepared.settings = settings;
  prepared.unit_mm = settings.length_unit == LengthUnit::kMm ? 1 : volume.voxel_size();
  Settings& chosen = prepared.settings;
  if (!chosen.eta) chosen.eta = chosen.epsilon * chosen.epsilon;
  if (!chosen.h_max) {
    chosen.h_max = std::max(chosen.h_min, default_h_max(volume, prepared.unit_mm));
  }
  if (!chosen.tolerance && !chosen.triangles) {
    chosen.tolerance = kDefaultTolerance * volume.voxel_size();
  }
  if (!chosen.min_volume) {
    const Vec3& voxel = volume.spacing;
    chosen.min_volume = kDefaultMinVolume * voxel.x * voxel.y * voxel.z;
  }
  const ObjectEdges seen = find_object(volume);
  if (!chosen.window) {
    chosen.window = choose_window(volume, seen.sides, chosen.level.value_or(seen.level));
  }
  Restored restored = restore(clamped(volume, *chosen.window), seen, {chosen.noise, chosen.blur});
  chosen.noise = restored.noise;
  chosen.blur = restored.blur;
  prepared.noise_left = restored.noise_left;
  prepared.impulses = restored.impulses;
  const ObjectEdges object =
      find_object(restored.volume, {.area_at = chosen.level, .start = seen.level});
  prepared.level_native = chosen.level.value_or(object.level);
  if (!chosen.max_tets) chosen.max_tets = default_max_tets(object.area, volume.spacing);
  prepared.map = {chosen.window->low, chosen.window->high, chosen.window->low};
  const double found = find_threshold(volume, seen.sides, seen.level, restored.noise);
  if (const auto t = choose_threshold(chosen, found, prepared.level_native)) {
    prepared.threshold_used = true;
    prepared.map.threshold = chosen.threshold = *t;
  }
  if (!chosen.gamma) chosen.gamma = choose_gamma(prepared, object.sides);
  require_contrast(restored.volume, prepared);
  prepared.grey = apply(prepared.map, std::move(restored.volume));
  return prepared;
}

}  // namespace mesamis
