// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/body_request.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "mesamis/body/rim.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

VoxelGrid grid_of(const Vec3& spacing) {
  VoxelGrid grid;
  grid.size = {10, 10, 10};
  grid.spacing = spacing;
  return grid;
}

const VoxelGrid kGrid = grid_of({2, 2, 2});
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(BodyRequest, TheSkinsToleranceIsTheNearestThatWasGiven) {
  BodyWishes wishes;
  EXPECT_DOUBLE_EQ(complete_request(wishes, {}, {kGrid}).elements.tolerance, 0.6)
      << "a tenth of three voxels";
  wishes.elements.element_size = 4;
  EXPECT_DOUBLE_EQ(complete_request(wishes, {}, {kGrid}).elements.tolerance, 0.4);
  EXPECT_DOUBLE_EQ(complete_request(wishes, {}, {kGrid, 0.3}).elements.tolerance, 0.3);
  EXPECT_DOUBLE_EQ(complete_request(wishes, {}, {kGrid, 0.0}).elements.tolerance,
                   0.4);  // a preview's
  wishes.tolerance = 0.2;
  EXPECT_DOUBLE_EQ(complete_request(wishes, {}, {kGrid, 0.3}).elements.tolerance, 0.2);
}

TEST(BodyRequest, TheRimIsOfMaterials) {
  BodyWishes wishes;
  const BodySource source{kGrid, {}, {1, 1, 2}};
  EXPECT_EQ(complete_request(wishes, {}, source).rim.x, 0);
  wishes.material.emplace();
  EXPECT_EQ(complete_request(wishes, {}, source).rim.z, rim_depth(kGrid, {1, 1, 2}).z);
  wishes.rim = 0.5;
  EXPECT_EQ(complete_request(wishes, {}, source).rim.z, 0.5);
}

TEST(BodyRequest, MemoryLimitsTheElements) {
  EXPECT_EQ(complete_request({}, {}, {kGrid, {}, {}, 0.006}).elements.most_elements, 10000);
  EXPECT_GT(complete_request({}, {}, {kGrid}).elements.most_elements, 0);
}

TEST(BodyRequest, RefusesNumbersOutOfTheirRanges) {
  const std::vector<std::pair<std::function<void(BodyWishes&)>, std::string>> cases{
      {[](BodyWishes& w) { w.elements.element_size = -1; }, "element size: expected"},
      {[](BodyWishes& w) { w.elements.element_size = kNone; }, "element size: expected"},
      {[](BodyWishes& w) { w.elements.least_size = kInfinite; }, "least size: expected"},
      {[](BodyWishes& w) { w.elements.least_size = 2, w.elements.element_size = 1; },
       "least size: expected at most the element size 1, found 2"},
      {[](BodyWishes& w) { w.tolerance = 0; }, "tolerance: expected a finite number above 0"},
      {[](BodyWishes& w) { w.tolerance = kInfinite; }, "tolerance: expected"},
      {[](BodyWishes& w) { w.elements.gradation = 0; }, "gradation: expected 0.05 to 5, found 0"},
      {[](BodyWishes& w) { w.elements.through_wall = 11; }, "wall elements: expected 0 to 10"},
      {[](BodyWishes& w) { w.rim = -1; }, "material rim: expected"},
      {[](BodyWishes& w) { w.material.emplace().gap = -1; }, "material gap: expected"},
      {[](BodyWishes& w) { w.material.emplace().poisson = 0.5; }, "poisson: expected"}};
  EXPECT_NO_THROW(require_valid(BodyWishes{}));
  for (const auto& [change, message] : cases) {
    BodyWishes wishes;
    change(wishes);
    EXPECT_REFUSED(complete_request(wishes, {}, {kGrid}), HasSubstr(message));
  }
}

TEST(BodyRequest, RefusesSetsOfObjectsThatAreNotThere) {
  const TriMesh none;
  const std::vector<FoundObject> objects{{none, {"femur", 1, 0, {}}}, {none, {"tibia", 2, 0, {}}}};
  BodyWishes wishes;
  wishes.sets = {parse_face_query("JOINT=between:1,2")};
  EXPECT_NO_THROW(complete_request(wishes, objects, {kGrid}));
  wishes.sets = {parse_face_query("JOINT=between:1,3")};
  EXPECT_REFUSED(complete_request(wishes, objects, {kGrid}),
                 HasSubstr("set JOINT: expected two of the objects 1 'femur', 2 'tibia', found 3"));
}

TEST(BodyRequest, ASkinNeedsASolidAndATolerance) {
  Settings settings;
  EXPECT_NO_THROW(require_fillable(settings, {}));
  settings.triangles = 1000;
  EXPECT_REFUSED(require_fillable(settings, {}), HasSubstr("beside triangles"));
  settings.tolerance = 0;
  EXPECT_REFUSED(require_fillable(settings, {}), HasSubstr("above 0"));
  EXPECT_NO_THROW(require_fillable(settings, 0.1));
  settings.preview = true;  // its tolerance is 0, as its report says
  EXPECT_NO_THROW(require_fillable(settings, {}));
  settings.surface = SurfaceKind::kBand;
  EXPECT_REFUSED(require_fillable(settings, 0.1), HasSubstr("found band"));
}

TEST(BodyRequest, LooseParts) {
  EXPECT_EQ(loose_parts(2, 2), "");
  EXPECT_THAT(loose_parts(3, 2), HasSubstr("found 3 that do not touch"));
}

}  // namespace
}  // namespace mesamis
