// SPDX-License-Identifier: Apache-2.0
// A report repeats its run: the same bits from the settings in it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mesamis/report/settings_json.h"
#include "mesamis/run/segment.h"
#include "mesamis/run/write.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

const Vec3 kDense{12, 12, 12}, kSpongy{30, 13, 12}, kFar{48, 12, 12};
constexpr double kRadius = 7;

/// Bones of different density in soft tissue, with air and noise, in HU.
Volume bones() {
  Volume scan = sampled_volume({60, 25, 25}, {1, 1, 1}, [](const Vec3& p) {
    if (p.y < 3) return -1000.0;
    return 50 + 1150 * blurred_ball(norm(p - kDense), kRadius, 0.8) +
           800 * blurred_ball(norm(p - kSpongy), kRadius, 0.8) +
           700 * blurred_ball(norm(p - kFar), kRadius, 0.8);
  });
  scan.modality = "CT";
  std::uint32_t state = 1;
  for (float& sample : scan.samples) {
    state = state * 1664525U + 1013904223U;
    sample += 20.0F * (static_cast<float>(state >> 8) / 8388608.0F - 1.0F);
  }
  return scan;
}

/// The voxels around two of them.
LabelMap marks() {
  LabelMap map;
  static_cast<VoxelGrid&>(map) = bones();
  map.segments = {{"dense", 1, 0, {}}, {"spongy", 2, 0, {}}};
  map.layers.emplace_back(map.voxel_count());
  for (std::size_t n = 0; n < map.voxel_count(); ++n) {
    const auto [i, j, k] = map.voxel(n);
    const Vec3 p{1.0 * i, 1.0 * j, 1.0 * k};
    map.layers[0][n] = norm(p - kDense) < kRadius ? 1 : norm(p - kSpongy) < kRadius ? 2 : 0;
  }
  return map;
}

enum class Object { kBright, kBone, kSeed, kSeeds, kMask, kMarksRemoved, kLabels };

Request request_of(Object object, const Settings& settings) {
  Request request;
  request.scan = bones();
  request.settings = settings;
  request.mesh = false;
  if (object == Object::kBone) request.object.tissue = parse_tissue("bone");
  if (object == Object::kSeed) request.object.seeds = {kSpongy};
  if (object == Object::kSeeds) request.object.seeds = {kDense, kSpongy};
  if (object == Object::kMask) request.object.mask = marks();
  if (object == Object::kMarksRemoved) request.object.remove = marks();
  if (object == Object::kLabels) request.labels = LabelChoice{marks()};
  return request;
}

/// That a run with the settings of a report, and with those an outcome tells, has the same surfaces.
void expect_repeats(Object object, const Settings& settings) {
  const Outcome first = segment(request_of(object, settings));
  Settings read;
  from_json(nlohmann::json::parse(report_text(first))["settings"], read);
  for (const Settings& again : {read, first.settings_used()}) {
    const Outcome second = segment(request_of(object, again));
    ASSERT_EQ(second.objects().size(), first.objects().size());
    for (std::size_t n = 0; n < first.objects().size(); ++n) {
      EXPECT_EQ(second.objects()[n].surface.points, first.objects()[n].surface.points);
      EXPECT_EQ(second.objects()[n].surface.triangles, first.objects()[n].surface.triangles);
    }
  }
}

/// A level, or none and whether each place has its own.
struct Level {
  std::optional<double> value;
  bool local;
};

/// A threshold, and its rule.
struct Threshold {
  ThresholdRule rule;
  double value;
};

TEST(Report, RepeatsItsRunWhateverTheObjectIs) {
  for (const Object object : {Object::kBright, Object::kBone, Object::kSeed, Object::kSeeds,
                              Object::kMask, Object::kMarksRemoved, Object::kLabels}) {
    for (const bool cropped : {false, true}) {
      for (const Level level : {Level{{}, true}, Level{{}, false}, Level{180, false}}) {
        Settings settings;
        settings.preview = true;
        settings.local_level = level.local;
        settings.level = level.value;
        if (cropped) settings.crop = {{2, 2, 2}, {44, 25, 24}};
        SCOPED_TRACE(testing::Message()
                     << "object " << static_cast<int>(object) << ", cropped " << cropped
                     << ", level " << level.value.value_or(0) << ", local " << level.local);
        expect_repeats(object, settings);
      }
    }
  }
}

TEST(Report, RepeatsItsRunWhateverTheThresholdIs) {
  for (const Object object : {Object::kBright, Object::kSeed}) {
    for (const Threshold threshold :
         {Threshold{ThresholdRule::kNone, 0}, Threshold{ThresholdRule::kPaper, 0},
          Threshold{ThresholdRule::kValue, 100}, Threshold{ThresholdRule::kValue, 500}}) {
      Settings settings;
      settings.preview = true;
      settings.threshold_rule = threshold.rule;
      settings.threshold = threshold.value;
      settings.crop = {{2, 2, 2}, {44, 25, 24}};
      SCOPED_TRACE(testing::Message()
                   << "object " << static_cast<int>(object) << ", threshold " << threshold.value);
      expect_repeats(object, settings);
    }
  }
}

TEST(Report, RepeatsTheLoopToo) {
  for (const Object object : {Object::kBright, Object::kSeeds}) {
    Settings settings;
    settings.max_tets = 3000;
    settings.adaptations = 2;
    settings.crop = {{2, 2, 2}, {44, 25, 24}};
    expect_repeats(object, settings);
  }
}

}  // namespace
}  // namespace mesamis
