// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/finish_labels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "mesamis/surface/grid_partition.h"
#include "mesamis/surface/smooth_memberships.h"
#include "support/label_grids.h"

namespace mesamis {
namespace {

/// Two blocks that touch, and a voxel of the first one's label by itself.
OwnedLabels blocks() {
  return labels_where({20, 14, 14}, {1, 1, 2}, [](const Vec3& p) {
    if (p == Vec3{17, 10, 20}) return 1;
    if (std::min({p.x, p.y, p.z / 2}) < 2 || std::max(p.y, p.z / 2) > 9 || p.x > 15) return 0;
    return p.x < 9 ? 1 : 2;
  });
}

LabelMap map_of(const OwnedLabels& labels) {
  LabelMap map;
  map.size = labels.size;
  map.spacing = labels.spacing;
  map.layers = {labels.labels};
  map.segments = {{"first", 1, 0, {}}, {"second", 2, 0, {}}};
  return map;
}

/// What blocks() become with some settings, without an image.
LabelResult finished(const Settings& settings) {
  const OwnedLabels labels = blocks();
  const LabelMap map = map_of(labels);
  const LabelRequest request{map};
  const ImageSettings of_image(settings);
  const Progress none;
  const LabelRun run(request, of_image, none);
  LabelResult result;
  result.parameters = parameters_asked(settings);
  std::vector<LayerBoundaries> layers;
  layers.push_back({0, extract_partition_on_grid(smooth_memberships(labels.grid()))});
  finish_layers(run, std::move(layers), nullptr, result);
  return result;
}

std::set<std::array<double, 3>> places_of(const TriMesh& surface) {
  std::set<std::array<double, 3>> places;
  for (const Vec3& p : surface.points) places.insert({p.x, p.y, p.z});
  return places;
}

TEST(FinishLabels, TheLeastVolumeIsThatOfAVoxelUnlessTheSettingsSayOtherwise) {
  const LabelMap map = map_of(blocks());
  const auto least = [&](const Settings& settings) {
    const LabelRequest request{map};
    const ImageSettings of_image(settings);
    const Progress none;
    return least_volume(LabelRun(request, of_image, none));
  };
  Settings settings;
  EXPECT_EQ(least(settings), 2);
  settings.keep_topology = true;
  EXPECT_EQ(least(settings), 0);
  settings.min_volume = 7;
  EXPECT_EQ(least(settings), 7);
}

TEST(FinishLabels, DecimateWhatObjectsShareByOneTolerance) {
  Settings settings;
  settings.min_volume = 5;
  settings.tolerance = 0;
  const LabelResult all = finished(settings);
  settings.tolerance = 0.3;
  const LabelResult few = finished(settings);
  EXPECT_EQ(all.decimated, 0);
  EXPECT_GT(few.decimated, 0);
  EXPECT_LE(few.decimated, 0.3);
  for (const LabelResult* result : {&all, &few}) {
    ASSERT_EQ(result->objects.size(), 2U);
    for (const LabelledObject& object : result->objects) {
      const SurfaceCheck check = check_surface(object.surface);
      EXPECT_EQ(solid_flaws_of(check), "");
      EXPECT_EQ(check.components, 1) << "the single voxel goes";
      EXPECT_TRUE(object.expected_error.empty());
    }
    const auto first = places_of(result->objects[0].surface),
               second = places_of(result->objects[1].surface);
    EXPECT_GT(std::ranges::count_if(first, [&](const auto& p) { return second.contains(p); }), 3);
  }
  for (std::size_t n = 0; n < 2; ++n) {
    const LabelledObject &was = all.objects[n], &is = few.objects[n];
    EXPECT_EQ(was.triangles_extracted, is.triangles_extracted);
    EXPECT_LT(is.surface.triangles.size(), was.surface.triangles.size() / 2);
  }
}

TEST(FinishLabels, RoundAPreviewInAnyCase) {
  Settings settings;
  settings.preview = true;
  settings.tolerance = 0;
  for (const LabelledObject& object : finished(settings).objects) {
    for (const Vec3& p : object.surface.points) {
      for (const double x : {p.x, p.y, p.z}) EXPECT_EQ(x, static_cast<float>(x));
    }
  }
}

}  // namespace
}  // namespace mesamis
