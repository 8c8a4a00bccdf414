// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/run_share.h"

#include <algorithm>
#include <utility>

namespace mesamis::detail::run {
namespace {

using Stages = std::vector<StageShare>;

void append(Stages& to, const Stages& more) { to.insert(to.end(), more.begin(), more.end()); }

/// As of a head CT of two million cells, which settles after two meshes. A mesh that few runs make,
/// or none that take long, has a small share.
Stages adaptations() {
  constexpr int kMost = 100;
  constexpr double kFirst = 15, kSecond = 27, kThird = 6, kFourth = 2, kFurther = 0.3;
  Stages stages{
      {"adaptation 1 of", kFirst}, {"adaptation 2 of", kSecond}, {"adaptation 3 of", kThird}};
  double share = kFourth;
  for (int k = 4; k <= kMost; ++k, share *= kFurther) {
    stages.push_back({"adaptation " + std::to_string(k) + " of", share});
  }
  stages.push_back({"final minimisation", 12});
  return stages;
}

Stages object_stages(const RunStages& run) {
  if (run.preview) {
    return {
        {"preparation", 40}, {"preview", 10}, {"surface", 35}, {"rounding", 10}, {"decimation", 1}};
  }
  Stages stages{{"preparation", 9}};
  append(stages, adaptations());
  append(stages, {{"surface", 12}, {"decimation", 39}});
  return stages;
}

Stages label_stages(const RunStages& run) {
  // A preview is not decimated unless that is asked for.
  const auto decimation = [&run](double share) {
    return StageShare{"decimation", run.preview ? 1 : share};
  };
  if (!run.scan) {
    return {{"preparation", 5}, {"smoothing the labels", 50}, {"surface", 15}, decimation(30)};
  }
  Stages stages{{"preparation", 4}, {"flow of the labels", 5}, {"surface", 26}, decimation(65)};
  if (!run.mesh || run.preview) return stages;
  stages.push_back({"preparation", 20});
  append(stages, adaptations());
  return stages;
}

/// Labels without a scan.
Stages label_slab_stages() {
  return {{"slabs: labels", 8},  {"slabs: look", 2},         {"slabs: parts", 6},
          {"slabs: steps", 14},  {"slabs: memberships", 18}, {"slabs: volumes", 12},
          {"slabs: surface", 3}, {"decimation", 30}};
}

Stages slab_stages() {
  Stages stages{
      {"slabs: look", 4}, {"slabs: choose", 2}, {"slabs: image", 1}, {"slabs: prepare", 15}};
  constexpr int kMost = 100;
  double share = 25;
  for (int k = 1; k <= kMost; ++k, share *= 0.5) {
    const std::string number = std::to_string(k);
    append(stages, {{"slabs: mesh " + number, share}, {"slabs: borders " + number, share / 10}});
  }
  append(stages, {{"slabs: final minimisation", 8},
                  {"slabs: surface", 2},
                  {"slabs: follow", 4},
                  {"slabs: parts", 1},
                  {"slabs: decimate", 12},
                  {"slabs: distances", 4}});
  return stages;
}

}  // namespace

Stages stage_shares(const RunStages& run) {
  Stages stages{{"reading", 2}};
  append(stages, run.slabs    ? (run.labels ? label_slab_stages() : slab_stages())
                 : run.labels ? label_stages(run)
                              : object_stages(run));
  if (run.elements) stages.push_back({"elements", 40});
  stages.push_back({"writing", 3});
  return stages;
}

RunShare::RunShare(std::vector<StageShare> stages) : stages_(std::move(stages)) {
  for (const StageShare& stage : stages_) all_ += stage.share;
}

double RunShare::done(std::string_view stage, double fraction) {
  double before = before_;
  for (std::size_t n = current_; n < stages_.size(); before += stages_[n++].share) {
    if (!stage.starts_with(stages_[n].name)) continue;
    current_ = n;
    before_ = before;
    const double share = stages_[n].share * std::clamp(fraction, 0.0, 1.0);
    done_ = std::max(done_, std::min((before + share) / all_, 1.0));
    break;
  }
  return done_;
}

}  // namespace mesamis::detail::run
