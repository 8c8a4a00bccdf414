// SPDX-License-Identifier: Apache-2.0
#include "mesamis/study/experiment.h"

#include "mesamis/base/error.h"

namespace mesamis::detail::study {
namespace {

constexpr Index kInPlane = 2;  // of the paper: 102 x 122 of 204 x 244 pixels

/// Refuses an experiment before hours of work if one of its runs could not start.
void require_usable_runs(const Experiment& experiment) {
  for (const PlannedRun& plan : experiment.runs) {
    try {
      require_usable(subsample(experiment.volume, plan.stride));
    } catch (const InputError& error) {
      throw InputError(plan.name + ": " + error.what());
    }
  }
}

}  // namespace

Experiment subsampling_experiment(const Volume& scan, const Settings& settings,
                                  std::span<const int> s) {
  const bool cropped = settings.crop != CropRange{};
  Experiment experiment{"subsampling", "",       cropped ? crop(scan, settings.crop) : scan,
                        cropped,       settings, {}};
  experiment.settings.crop = {};
  for (const int step : s) {
    experiment.runs.push_back({"s" + std::to_string(step), step, {1, 1, step}});
  }
  require_usable_runs(experiment);
  return experiment;
}

Experiment region_experiment(const Volume& scan, const CropRange& region, const Settings& settings,
                             std::span<const int> s) {
  Experiment experiment{"region", "region_", crop(scan, region), true, settings, {}};
  experiment.settings.crop = {};
  experiment.settings.stride = std::array<Index, 3>{1, 1, 1};
  experiment.runs.push_back({"region_full", 1, {1, 1, 1}, true});
  for (const int step : s) {
    experiment.runs.push_back(
        {"region_s" + std::to_string(step), step, {kInPlane, kInPlane, step}});
  }
  require_usable_runs(experiment);
  return experiment;
}

}  // namespace mesamis::detail::study
