// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/label_choice.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include "mesamis/base/median.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/image/sample_slices.h"
#include "mesamis/method/label_surfaces.h"

namespace mesamis::detail::method {
namespace {

constexpr std::size_t kMostLookedAt = std::size_t{1} << 24;  // voxels

/// Nothing is looked for but the window, noise and blur.
Settings looking(Settings settings) {
  settings.crop = {};
  settings.stride = {1, 1, 1};
  settings.preview = true;       // no mesh is made
  settings.local_level = false;  // each boundary has its own
  settings.surface = SurfaceKind::kBand;
  if (settings.threshold_rule == ThresholdRule::kAuto) {
    settings.threshold_rule = ThresholdRule::kNone;
  }
  return settings;
}

/// Chooses in the usual window, or in one that is as wide as the values need.
Chosen choose_in_window(const VolumeView& part, const VoxelGrid& whole, ImageSettings settings,
                        const Window& values) {
  Chosen found = choose_from_part(part, whole, settings).chosen;
  const GreyMap& grey = found.parameters.grey;
  if (settings.asked.window || (grey.low <= values.low && values.high <= grey.high)) return found;
  settings.asked.window = {std::min(grey.low, values.low), std::max(grey.high, values.high)};
  return choose_from_part(part, whole, settings).chosen;
}

/// Native units half way between the voxels that are chosen and the others; nothing where they are
/// alike.
std::optional<double> level_between(const VolumeView& scan, const std::vector<char>& chosen) {
  std::vector<float> in, out;
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    (chosen[n] != 0 ? in : out).push_back(scan.samples[n]);
  }
  if (in.empty() || out.empty()) return std::nullopt;
  const double a = median(in), b = median(out);
  return a == b ? std::nullopt : std::optional((a + b) / 2);
}

}  // namespace

LabelledValues values_of_labels(const VolumeView& part, const ChosenLabels& labels) {
  std::vector<char> chosen(part.samples.size(), 0);
  std::vector<double> medians;
  for (const Index layer : layers_of(labels.chosen)) {
    const std::vector<char> marks = marks_of(labels.chosen, layer);
    const std::vector<std::uint16_t> found = labels_in(labels.map, layer, labels.block);
    std::map<std::uint16_t, std::vector<float>> of_label;
    for (std::size_t n = 0; n < chosen.size(); ++n) {
      if (marks[found[n]] == 0) continue;
      chosen[n] = 1;
      of_label[found[n]].push_back(part.samples[n]);
    }
    for (auto& [label, samples] : of_label) medians.push_back(median(samples));
  }
  LabelledValues values{level_between(part, chosen)};
  if (medians.empty()) return values;
  const auto [least, most] = std::ranges::minmax(medians);
  values.medians = {least, most};
  return values;
}

Chosen choose_beside_labels(const VolumeView& scan, const ImageSettings& settings,
                            const LabelledValues& values) {
  const SliceRange seen = sample_slices(scan, kMostLookedAt);
  const CropRange range{{0, 0, seen.first}, {scan.size[0], scan.size[1], seen.first + seen.count}};
  const bool is_whole = seen.count == scan.size[2];
  Volume slices;
  if (!is_whole) slices = crop(scan, range);
  ImageSettings looked(looking(settings.asked));
  looked.scan = settings.scan;
  Chosen found =
      choose_in_window(is_whole ? scan : VolumeView(slices), scan, looked, values.medians);
  Parameters& p = found.parameters;
  p.surface = SurfaceKind::kSolid;
  p.level = settings.level ? settings.level->value : values.level.value_or(p.level);
  found.measured.level_uncertainty = 0;  // each boundary has a level of its own
  return found;
}

}  // namespace mesamis::detail::method
