// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/chosen_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mesamis/object/mirror.h"
#include "support/ball_volume.h"
#include "support/sampled_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Settings preview() {
  Settings settings;
  settings.preview = true;
  settings.tolerance = 0.02;
  return settings;
}

/// 200 in balls of 7 mm, 100 elsewhere.
Volume balls(const std::vector<Vec3>& middles, const std::array<Index, 3>& size) {
  return sampled_volume(size, {1, 1, 1}, [&](const Vec3& p) {
    double inside = 0;
    for (const Vec3& m : middles) inside = std::max(inside, blurred_ball(norm(p - m), 7, 0.7));
    return 100 + 100 * inside;
  });
}

ChosenObject choose(Volume volume, const Settings& settings, ObjectRequest request) {
  request.crop = settings.crop;
  request.level = settings.level;
  return choose_object(std::move(volume), request);
}

double ball_volume() { return 4.0 / 3 * M_PI * 343; }

TEST(RunOnObject, OfOneSeedDeliversOneClosedIsland) {
  const Volume scan = balls({{12, 12, 12}, {30, 12, 12}}, {44, 24, 24});
  const ChosenObject object = choose(scan, preview(), {.seeds = {{30, 12, 12}}});
  const Result result = run_on_object(object, preview());
  const SurfaceCheck check = check_surface(result.surface);
  EXPECT_EQ(solid_flaws_of(check), "");
  EXPECT_EQ(check.components, 1);
  EXPECT_NEAR(check.volume, ball_volume(), 0.03 * ball_volume());
  for (const Vec3& p : result.surface.points) ASSERT_NEAR(norm(p - Vec3{30, 12, 12}), 7, 0.3);
}

TEST(RunOnObject, WithNothingAskedIsTheMethodItself) {
  const Volume scan = make_ball({.size = 24, .radius = 7});
  const Result plain = mes_amis(scan, preview());
  const Result chosen = run_on_object(choose_object(scan, {}), preview());
  EXPECT_EQ(chosen.surface.points, plain.surface.points);
  EXPECT_EQ(chosen.parameters.level, plain.parameters.level);
  EXPECT_EQ(chosen.parameters.crop, plain.parameters.crop);
}

TEST(RunOnObject, InPlaceIsTheSame) {
  const Volume scan = make_ball({.size = 24, .radius = 7});
  const auto object = choose_in_place(scan, {});
  ASSERT_TRUE(object);
  const Result in_place = run_on_object(ObjectInPlace{*object, scan}, preview());
  const Result copied = run_on_object(choose_object(scan, {}), preview());
  EXPECT_EQ(in_place.surface.points, copied.surface.points);
  EXPECT_EQ(in_place.parameters.level, copied.parameters.level);
}

TEST(RunOnObject, OfADarkObjectTellsNativeUnits) {
  const BallVolume bright{.size = 26, .radius = 7};
  const Volume scan = make_ball(bright);
  const Result reference = mes_amis(scan, preview());
  const ChosenObject object = choose(mirrored(scan), preview(), {.tissue = parse_tissue("dark")});
  const Result dark = run_on_object(object, preview());
  EXPECT_NEAR(dark.parameters.level, -reference.parameters.level, 1e-3);
  EXPECT_LT(dark.parameters.grey.low, dark.parameters.level);
  EXPECT_GT(dark.parameters.grey.high, dark.parameters.level);
  EXPECT_NEAR(check_surface(dark.surface).volume, check_surface(reference.surface).volume, 1);

  // The settings used, given again, repeat the run.
  const Settings again = settings_of(dark.parameters);
  const Result repeated =
      run_on_object(choose(mirrored(scan), again, {.tissue = parse_tissue("dark")}), again);
  EXPECT_EQ(repeated.surface.points, dark.surface.points);
  EXPECT_EQ(repeated.parameters.grey.low, dark.parameters.grey.low);
  EXPECT_EQ(repeated.parameters.grey.threshold, dark.parameters.grey.threshold);
}

/// CT of a soft ball of 18 mm in air, in it a dense ball of bone of 8 mm beside a light one of 6 mm.
Volume body_with_bones() {
  const Vec3 middle{22, 22, 22};
  Volume scan = sampled_volume({45, 45, 45}, {1, 1, 1}, [&](const Vec3& p) {
    return -1000 + 1040 * blurred_ball(norm(p - middle), 18, 0.7) +
           1600 * blurred_ball(norm(p - middle - Vec3{7, 0, 0}), 8, 0.7) +
           350 * blurred_ball(norm(p - middle + Vec3{9, 0, 0}), 6, 0.7);
  });
  scan.modality = "CT";
  return scan;
}

/// Bones differ in density; a level that followed them would leave the range of other tissues.
TEST(RunOnObject, OnlyBoneHasALevelForEachPlace) {
  const Volume scan = body_with_bones();
  const auto run = [&](const char* tissue, double level) {
    ObjectRequest request;
    if (*tissue != 0) request.tissue = parse_tissue(tissue);
    Settings settings = preview();
    if (level != 0) settings.level = level;
    return run_on_object(choose(scan, settings, request), settings);
  };
  const Result skin = run("skin", 0);
  EXPECT_FALSE(skin.image.has_local_levels());
  const double ball = 4.0 / 3 * M_PI * 18 * 18 * 18;
  EXPECT_NEAR(check_surface(skin.surface).volume, ball, 0.03 * ball);
  EXPECT_EQ(check_surface(skin.surface).components, 1);
  EXPECT_FALSE(run("teeth", 0).image.has_local_levels());
  EXPECT_FALSE(run("soft", 0).image.has_local_levels());
  EXPECT_FALSE(run("", -400).image.has_local_levels()) << "a level of the skin";
  EXPECT_TRUE(run("bone", 0).image.has_local_levels());
}

/// What else a crop shows, such as metal, does not change how its bones are found.
TEST(RunOnObject, ACropOfCtIsRestoredAsTheWholeIs) {
  const Vec3 middle{24, 24, 24};
  Volume scan = sampled_volume({96, 48, 48}, {1, 1, 1}, [&](const Vec3& p) {
    double hu = -1000 + 1040 * blurred_ball(norm(p - Vec3{48, 24, 24}), 44, 0.7);
    for (const double x : {30.0, 50.0, 70.0}) {
      hu += 900 * blurred_ball(norm(p - Vec3{x, 24, 24}), 8, 0.7);
    }
    return hu + 2500 * blurred_ball(norm(p - middle + Vec3{6, 0, 0}), 7, 1.6);
  });
  scan.modality = "CT";
  Settings settings = preview();
  const Result whole = run_on_object(choose(scan, settings, {}), settings);
  settings.crop = {{0, 0, 0}, {40, 48, 48}};
  const ChosenObject object = choose(scan, settings, {});
  const Result part = run_on_object(object, settings);
  EXPECT_EQ(part.parameters.noise, whole.parameters.noise);
  EXPECT_EQ(part.parameters.blur, whole.parameters.blur);
  EXPECT_EQ(part.parameters.grey.low, whole.parameters.grey.low);
  EXPECT_EQ(part.parameters.grey.high, whole.parameters.grey.high);
  EXPECT_EQ(part.image.contrast, whole.image.contrast);
  EXPECT_NE(part.parameters.blur, mes_amis(object.volume, preview()).parameters.blur)
      << "the crop by itself tells another";
  settings.noise = 7;
  EXPECT_EQ(run_on_object(object, settings).parameters.noise, 7) << "the user's comes first";
}

/// The window of the whole has room for the level of the tissue, which may be far from that of bone.
TEST(RunOnObject, ACropHasRoomForTheLevelThatIsAsked) {
  Settings settings = preview();
  settings.crop = {{0, 0, 0}, {-1, -1, 30}};
  const Volume scan = body_with_bones();
  for (const char* tissue : {"skin", "soft", "bone", "teeth"}) {
    ObjectRequest request;
    request.tissue = parse_tissue(tissue);
    EXPECT_FALSE(run_on_object(choose(scan, settings, request), settings).surface.points.empty());
  }
  settings.level = -600;
  EXPECT_FALSE(run_on_object(choose(scan, settings, {}), settings).surface.points.empty());
}

TEST(RunOnObject, TellsTheCropThatRepeatsIt) {
  Settings settings = preview();
  settings.crop = {{4, 0, 0}, {24, -1, -1}};
  const Volume scan = balls({{13, 12, 12}}, {32, 24, 24});
  const Result result = run_on_object(choose(scan, settings, {}), settings);
  EXPECT_EQ(result.parameters.crop, settings.crop);
  EXPECT_EQ(result.surface.points, mes_amis(scan, settings).surface.points);
}

/// Triangles by the places of their corners, in any order and turn.
std::set<std::set<std::array<double, 3>>> triangle_set(const TriMesh& mesh) {
  std::set<std::set<std::array<double, 3>>> triangles;
  for (const Triangle& t : mesh.triangles) {
    std::set<std::array<double, 3>> corners;
    for (const Index n : t) {
      const Vec3& p = mesh.points[static_cast<std::size_t>(n)];
      corners.insert({p.x, p.y, p.z});
    }
    triangles.insert(corners);
  }
  return triangles;
}

TEST(RunOnLabels, MakesClosedPartsOfTouchingBallsThatShareTheirBoundary) {
  const Vec3 left{12, 12, 12}, right{24.5, 12, 12};
  const Volume scan = balls({left, right}, {38, 25, 25});
  const ChosenObject object = choose(scan, preview(), {.level = 150, .seeds = {left, right}});
  const LabelResult result = run_on_labels(object, {*object.parts}, preview());
  ASSERT_EQ(result.objects.size(), 2U);
  for (const LabelledObject& part : result.objects) {
    const SurfaceCheck check = check_surface(part.surface);
    EXPECT_EQ(solid_flaws_of(check), "") << part.segment.name;
    EXPECT_EQ(check.components, 1);
    EXPECT_NEAR(check.volume, ball_volume(), 0.05 * ball_volume());
  }
  const auto first = triangle_set(result.objects[0].surface);
  const auto second = triangle_set(result.objects[1].surface);
  std::size_t shared = 0;
  for (const auto& triangle : first) {
    if (!second.contains(triangle)) continue;
    ++shared;
    for (const auto& p : triangle) EXPECT_NEAR(p[0], 18.25, 1.5) << "half way";
  }
  EXPECT_GT(shared, 4U);
}

/// A ball of 7 mm, marked by a label.
LabelMap label_of_ball(const VoxelGrid& grid, const Vec3& middle) {
  LabelMap map{grid, {{}}, {{"ball", 1, 0, {}}}};
  for (std::size_t n = 0; n < grid.voxel_count(); ++n) {
    const auto [i, j, k] = grid.voxel(n);
    map.layers[0].push_back(norm(Vec3{double(i), double(j), double(k)} - middle) < 6.5 ? 1 : 0);
  }
  return map;
}

TEST(RunOnLabels, TellsLevelsAndCropOfTheScanAlsoWhereTheImageIsMirrored) {
  const Vec3 middle{32, 12, 12};
  const Volume scan = balls({middle}, {64, 24, 24});
  const LabelMap map = label_of_ball(scan, middle);
  Settings settings = preview();
  const LabelResult whole = run_on_labels(choose(scan, settings, {}), {map}, settings);
  settings.crop = {{6, 0, 0}, {58, -1, -1}};
  const LabelResult bright = run_on_labels(choose(scan, settings, {}), {map}, settings);
  const ChosenObject object = choose(mirrored(scan), settings, {.tissue = parse_tissue("dark")});
  const LabelResult dark = run_on_labels(object, {map}, settings);
  ASSERT_GT(whole.parameters.crop.begin[0], 6) << "the crop leaves what is looked at";
  for (const LabelResult* result : {&bright, &dark}) {
    EXPECT_EQ(result->parameters.crop, whole.parameters.crop);
    ASSERT_EQ(result->boundaries.size(), 1U);
    EXPECT_NEAR(std::abs(result->boundaries[0].level), 150, 2);
    ASSERT_EQ(result->objects.size(), 1U);
    EXPECT_NEAR(check_surface(result->objects[0].surface).volume, ball_volume(),
                0.03 * ball_volume());
  }
  EXPECT_GT(bright.boundaries[0].level, 0);
  EXPECT_LT(dark.boundaries[0].level, 0);
  EXPECT_NEAR(dark.boundaries[0].contrast, -bright.boundaries[0].contrast, 2);
}

TEST(SettingsFor, LeaveTheLevelOpenWhereNobodyMeasuredIt) {
  const ChosenObject plain;
  EXPECT_FALSE(settings_for(plain, {}).level);
  ChosenObject measured;
  measured.level = {70, LevelSource::kScan, 5};
  const auto level = settings_for(measured, {}).level;
  ASSERT_TRUE(level);
  EXPECT_EQ(level->value, 70);
  EXPECT_EQ(level->uncertainty, 5);
  Settings paper;
  paper.threshold_rule = ThresholdRule::kPaper;
  EXPECT_TRUE(settings_for(measured, paper).level) << "a T alone changes nothing";
  EXPECT_TRUE(object_request(paper).measure_level);
  paper.surface = SurfaceKind::kBand;
  EXPECT_FALSE(settings_for(measured, paper).level);
  EXPECT_FALSE(object_request(paper).measure_level);
}

/// Of a dark object too, whose image has changed its sign.
TEST(RunOnObject, RefusesInTheUnitsOfTheScan) {
  const Volume scan = sampled_volume({20, 20, 20}, {1, 1, 1}, [](const Vec3& p) {
    return 100 - 90 * blurred_ball(norm(p - Vec3{9.5, 9.5, 9.5}), 6, 0.7);
  });
  Settings settings;
  settings.level = 400;
  const auto run = [&] {
    ObjectRequest request = object_request(settings);
    request.tissue = parse_tissue("dark");
    run_on_object(choose_object(scan, request), settings);
  };
  EXPECT_REFUSED(run(), AllOf(HasSubstr("data, 10 to 100"), HasSubstr("found 400")));
  settings.level.reset();
  settings.window = Window{300, 400};
  EXPECT_REFUSED(run(), HasSubstr("found 300,400"));
}

TEST(InScanUnits, TurnsWhatSettingsForTurned) {
  ChosenObject dark;
  dark.kind = TissueKind::kDark;
  dark.level = {400, LevelSource::kScan};
  Settings asked;
  asked.window = Window{-900, 100};
  asked.threshold_rule = ThresholdRule::kValue;
  asked.threshold = -20;
  const Settings run = settings_for(dark, asked).asked;
  EXPECT_EQ(run.window->low, -100);
  EXPECT_EQ(run.window->high, 900);
  EXPECT_EQ(run.threshold, 20);
  Parameters p;
  p.grey = {run.window->low, run.window->high, run.threshold};
  p.level = 400;
  const Parameters told = in_scan_units(p, dark);
  EXPECT_EQ(told.level, -400);
  EXPECT_EQ(told.grey.low, -900);
  EXPECT_EQ(told.grey.high, 100);
  EXPECT_EQ(told.grey.threshold, -20);
}

}  // namespace
}  // namespace mesamis
