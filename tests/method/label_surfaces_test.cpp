// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/label_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/base/single_precision.h"
#include "mesamis/fit/boundary_parts.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/surface/join_diagonals.h"
#include "mesamis/surface/self_intersections.h"
#include "support/ball_volume.h"
#include "support/edge_lengths.h"
#include "support/label_grids.h"
#include "support/sampled_volume.h"
#include "support/throws.h"

namespace mesamis {
namespace {

constexpr Index kSide = 48;
const Vec3 kFirst{17.3, 23.6, 24.2}, kSecond{31.1, 24.3, 23.4};
constexpr double kRadius = 11, kSecondRadius = 9.5;

/// Two balls that touch: the second ends where the first begins.
int ball_at(const Vec3& p) {
  if (norm(p - kFirst) < kRadius) return 1;
  return norm(p - kSecond) < kSecondRadius ? 2 : 0;
}

/// Grey values of the balls, blurred by sampling, with noise.
Volume scan_of(double first, double second, double background, double noise) {
  Volume scan{{.size = {kSide, kSide, kSide}}, {}};
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, noise);
  const std::array<double, 3> values{background, first, second};
  for (Index k = 0; k < kSide; ++k) {
    for (Index j = 0; j < kSide; ++j) {
      for (Index i = 0; i < kSide; ++i) {
        double sum = 0;
        for (int s = 0; s < 125; ++s) {  // a box of 1.6 voxels
          const Vec3 at{i + 0.4 * (s % 5 - 2), j + 0.4 * (s / 5 % 5 - 2), k + 0.4 * (s / 25 - 2)};
          sum += values[static_cast<std::size_t>(ball_at(at))];
        }
        scan.samples.push_back(static_cast<float>(sum / 125 + normal(generator)));
      }
    }
  }
  return scan;
}

/// The scan of most tests.
const Volume& usual_scan() {
  static const Volume scan = scan_of(200, 130, 50, 4);
  return scan;
}

/// Labels on every n-th voxel, shifted by so many millimetres.
LabelMap labels_of(Index every, double shift) {
  LabelMap map;
  map.size = {kSide / every, kSide / every, kSide / every};
  const double step = every;
  map.spacing = {step, step, step};
  map.layers.emplace_back();
  for (Index k = 0; k < map.size[2]; ++k) {
    for (Index j = 0; j < map.size[1]; ++j) {
      for (Index i = 0; i < map.size[0]; ++i) {
        map.layers[0].push_back(
            static_cast<std::uint16_t>(ball_at({i * step, j * step, k * step})));
      }
    }
  }
  map.origin = {shift, shift, shift};
  map.segments = {{"first", 1, 0, {255, 0, 0}}, {"second", 2, 0, {0, 255, 0}}};
  return map;
}

double distance_to(int object, const Vec3& p) {
  const double a = norm(p - kFirst) - kRadius, b = norm(p - kSecond) - kSecondRadius;
  if (object == 1) return std::abs(a);
  return a > 0 && b <= 0 ? std::min(a, -b) : std::max(std::abs(std::max(-a, b)), 0.0);
}

/// Mean over the triangles' middles, by area.
double mean_error(int object, const TriMesh& surface) {
  double sum = 0, area = 0;
  for (const Triangle& t : surface.triangles) {
    const Vec3 &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
    const double weight = norm(cross(b - a, c - a));
    sum += weight * distance_to(object, (1.0 / 3) * (a + b + c));
    area += weight;
  }
  return sum / area;
}

/// The objects of a layer in one: points of one place are one, and so are triangles that two share.
TriMesh together(const LabelResult& found, Index layer) {
  TriMesh all;
  std::map<std::array<double, 3>, Index> number;
  std::set<std::set<Index>> seen;
  for (const LabelledObject& object : found.objects) {
    if (object.segment.layer != layer) continue;
    for (Triangle t : object.surface.triangles) {
      for (Index& p : t) {
        const Vec3& at = object.surface.points[p];
        const auto next = static_cast<Index>(all.points.size());
        const auto [place, is_new] = number.emplace(std::array{at.x, at.y, at.z}, next);
        if (is_new) all.points.push_back(at);
        p = place->second;
      }
      if (seen.insert({t[0], t[1], t[2]}).second) all.triangles.push_back(t);
    }
  }
  return all;
}

void expect_closed(const LabelResult& found) {
  for (const LabelledObject& object : found.objects) {
    EXPECT_EQ(solid_flaws_of(check_surface(object.surface)), "") << object.segment.name;
    const TriMesh all = together(found, object.segment.layer);
    EXPECT_TRUE(find_self_intersections(all).empty()) << object.segment.name;
  }
}

/// Points of both objects.
std::size_t shared_points(const LabelResult& found) {
  std::set<std::array<double, 3>> first;
  for (const Vec3& p : found.objects[0].surface.points) first.insert({p.x, p.y, p.z});
  return static_cast<std::size_t>(
      std::ranges::count_if(found.objects[1].surface.points, [&](const Vec3& p) {
        return first.contains({p.x, p.y, p.z});
      }));
}

/// Of the usual scan and a label for each of its voxels.
const LabelResult& objects_by_one_thread() {
  static const LabelResult found = with_threads(
      1, [] { return find_labelled_objects(usual_scan(), {labels_of(1, 0)}, Settings{}); });
  return found;
}

TEST(LabelSurfaces, TheImagePlacesWhatLabelsChoose) {
  const Volume& scan = usual_scan();
  for (const auto& [every, shift] : {std::pair{1, 0.5}, {2, 1.0}, {3, 0.0}}) {
    const LabelMap labels = labels_of(every, shift);
    const LabelResult found = find_labelled_objects(scan, {labels}, Settings{});
    const std::string what = std::to_string(every) + " shifted by " + std::to_string(shift);
    ASSERT_EQ(found.objects.size(), 2U) << what;
    EXPECT_TRUE(found.flow_converged) << what;
    expect_closed(found);
    EXPECT_GT(shared_points(found), 20U) << what;
    EXPECT_LT(mean_error(1, found.objects[0].surface), 0.15) << what;
    EXPECT_LT(mean_error(2, found.objects[1].surface), 0.15) << what;
  }
}

/// The first ball's surface goes on where the second one touches it.
TEST(LabelSurfaces, ABallThatAnotherTouchesHasNoCreases) {
  constexpr double kMost = 0.02;
  const auto first_of = [](const LabelMap& map, bool with_image) {
    const LabelResult found = with_image ? find_labelled_objects(usual_scan(), {map}, Settings{})
                                         : surfaces_of_labels({map}, Settings{});
    const TriMesh& first = found.objects.at(0).surface;
    return edge_lengths(first).creases / surface_area(first);
  };
  for (const Index every : {1, 2}) {
    const LabelMap map = labels_of(every, 0);
    EXPECT_LT(first_of(map, true), kMost) << every;
    EXPECT_LT(every * first_of(map, false), kMost) << every;
  }
}

/// Two balls whose labels share 3 x 3 voxel faces are as round as if they did not.
TEST(LabelSurfaces, ANarrowContactLeavesNoSpikes) {
  constexpr Index kLong = 34, kWide = 21;
  LabelMap map;
  map.size = {kLong, kWide, kWide};
  map.layers.emplace_back();
  Volume scan{{.size = map.size}, {}};
  for (Index k = 0; k < kWide; ++k) {
    for (Index j = 0; j < kWide; ++j) {
      for (Index i = 0; i < kLong; ++i) {
        const Vec3 p{1.0 * i, 1.0 * j, 1.0 * k};
        const double first = norm(p - Vec3{10, 10, 10}), second = norm(p - Vec3{22.9, 10, 10});
        map.layers[0].push_back(first < 6.2 ? 1 : second < 6.2 ? 2 : 0);
        const double within = 6.2 - std::min(first, second);
        scan.samples.push_back(static_cast<float>(100 + 100 * std::clamp(within, -0.8, 0.8)));
      }
    }
  }
  map.segments = {{"first", 1, 0, {255, 0, 0}}, {"second", 2, 0, {0, 255, 0}}};
  for (const bool with_image : {true, false}) {
    const auto find = [&](bool keep_topology) {
      Settings settings;
      settings.keep_topology = keep_topology;
      return with_image ? find_labelled_objects(scan, {map}, settings)
                        : surfaces_of_labels({map}, settings);
    };
    const LabelResult apart = find(false), touching = find(true);
    expect_closed(apart);
    EXPECT_EQ(shared_points(apart), 0U);
    EXPECT_GT(shared_points(touching), 3U);
    const TriMesh& ball = apart.objects.at(0).surface;
    EXPECT_LT(edge_lengths(ball).creases / surface_area(ball), 0.01);
    for (const Vec3& p : ball.points) EXPECT_NEAR(norm(p - Vec3{10, 10, 10}), 6.2, 0.6);
  }
}

/// Slanted layers of three labels, and any label in half of the voxels between them.
LabelMap layers_and_any(unsigned seed) {
  std::mt19937 generator(seed);
  const auto any = [&](unsigned count) { return static_cast<int>(generator() % count); };
  LabelMap map;
  map.size = {9, 8, 9};
  map.spacing = {1, 2, 0.5};
  map.origin = {-101.7, 250.3, 1313.1};
  map.layers = {labels_where(map.size, {1, 1, 1}, [&](const Vec3& p) {
                  const int layer = static_cast<int>(0.6 * p.x + 0.5 * p.y + 0.4 * p.z);
                  if (layer % 2 == 1) return layer / 2 % 3 + 1;
                  return any(4) != 0 ? 0 : 1 + any(3);
                }).labels};
  map.segments = {{"first", 1, 0, {}}, {"second", 2, 0, {}}, {"third", 3, 0, {}}};
  return map;
}

/// Also in the single precision of a file, which is coarse far from the origin.
TEST(LabelSurfaces, OfAnyLabelsDoNotMeet) {
  for (const unsigned seed : {1, 17}) {
    const LabelMap map = layers_and_any(seed);
    Volume scan{map, {}};
    std::mt19937 generator(seed);
    std::normal_distribution<double> noise(0, 6);
    for (const std::uint16_t label : map.layers[0]) {
      scan.samples.push_back(static_cast<float>(100 + 100 * (label != 0) + noise(generator)));
    }
    Settings settings;
    settings.tolerance = 0;
    expect_closed(find_labelled_objects(scan, {map}, settings));
    expect_closed(surfaces_of_labels({map}, settings));
  }
}

/// Two balls far from each other, the second of which is darker and more blurred.
TEST(LabelSurfaces, DoNotDependOnObjectsThatDoNotTouch) {
  const Vec3 one{12, 12, 12}, other{46, 12, 12};
  Volume scan = sampled_volume({60, 25, 25}, {1, 1, 1}, [&](const Vec3& p) {
    return 40 + 400 * blurred_ball(norm(p - one), 7, 0.6) +
           90 * blurred_ball(norm(p - other), 8, 1.5);
  });
  std::mt19937 generator(5);
  std::normal_distribution<float> noise(0, 4);
  for (float& sample : scan.samples) sample += noise(generator);
  LabelMap map{scan, {{}}, {{"one", 1, 0, {}}, {"other", 2, 0, {}}}};
  for (std::size_t n = 0; n < map.voxel_count(); ++n) {
    const auto [i, j, k] = map.voxel(n);
    const Vec3 p{1.0 * i, 1.0 * j, 1.0 * k};
    map.layers[0].push_back(norm(p - one) < 7 ? 1 : norm(p - other) < 8 ? 2 : 0);
  }
  Settings settings;
  settings.tolerance = 0;
  const LabelResult both = find_labelled_objects(scan, {map}, settings);
  for (const std::size_t n : {0, 1}) {
    const LabelResult alone = find_labelled_objects(scan, {map, {map.segments[n]}}, settings);
    EXPECT_EQ(alone.parameters.blur, both.parameters.blur);
    const double volume = check_surface(both.objects.at(n).surface).volume;
    EXPECT_NEAR(check_surface(alone.objects.at(0).surface).volume, volume, 5e-4 * volume) << n;
  }
}

TEST(LabelSurfaces, TheLabelsDecideWhereTheImageShowsNothing) {
  const Volume scan = scan_of(200, 200, 50, 4);  // no edge between the balls
  const LabelMap labels = labels_of(1, 0);
  const LabelResult found = find_labelled_objects(scan, {labels}, Settings{});
  expect_closed(found);
  EXPECT_LT(mean_error(1, found.objects[0].surface), 0.3);
  for (const LabelBoundary& b : found.boundaries) {
    EXPECT_EQ(b.followed, b.first.empty()) << b.first << " and " << b.second;
  }
}

/// What the scan shows of an object may be little or nothing: labels that flow then keep what they have.
/// Noise with values like those of a CT, in which no object is found, and plain noise.
TEST(LabelSurfaces, NothingIsExpectedOfBoundariesInNoise) {
  for (const auto& [mean, noise] : {std::pair{40.0, 100.0}, std::pair{0.0, 50.0}}) {
    const LabelResult result =
        find_labelled_objects(scan_of(mean, mean, mean, noise), {labels_of(1, 0)}, {});
    ASSERT_FALSE(result.boundaries.empty());
    for (const LabelBoundary& b : result.boundaries) EXPECT_FALSE(b.followed) << mean;
    for (const LabelledObject& o : result.objects) EXPECT_TRUE(o.expected_error.empty()) << mean;
  }
}

TEST(LabelSurfaces, OfCoarseLabelsKeepTheirVolumeWhereTheImageShowsLittle) {
  for (const double contrast : {0.0, 60.0}) {
    const Volume scan = scan_of(600, 50 + contrast, 50, 20);
    for (const Index every : {1, 3}) {
      const LabelMap labels = labels_of(every, 0);
      Settings settings;
      settings.fit = every > 1;
      const LabelResult found =
          find_labelled_objects(scan, {labels, {labels.segments[1]}}, settings);
      const double volume = check_surface(found.objects[0].surface).volume;
      const auto voxels = std::count(labels.layers[0].begin(), labels.layers[0].end(), 2);
      const double expected = static_cast<double>(voxels) * std::pow(every, 3);
      EXPECT_NEAR(volume, expected, 0.2 * expected) << contrast << ", every " << every;
    }
  }
}

TEST(LabelSurfaces, OneObjectEndsWhereAnotherBegins) {
  const LabelMap labels = labels_of(1, 0);
  const LabelResult& both = objects_by_one_thread();
  const LabelResult one =
      find_labelled_objects(usual_scan(), {labels, {labels.segments[1]}}, Settings{});
  ASSERT_EQ(one.objects.size(), 1U);
  EXPECT_EQ(one.objects[0].segment.name, "second");
  EXPECT_NEAR(check_surface(one.objects[0].surface).volume,
              check_surface(both.objects[1].surface).volume, 0.01 * 2900);
}

/// With the voxels that mend their topology, if they may.
TEST(LabelSurfaces, OfLabelsAloneKeepTheVolume) {
  for (const auto& [every, as_they_are] :
       {std::pair<Index, bool>{1, true}, {1, false}, {2, true}, {2, false}}) {
    const LabelMap labels = labels_of(every, 0);
    Settings settings;
    settings.keep_topology = as_they_are;
    const LabelResult found = surfaces_of_labels({labels}, settings);
    ASSERT_EQ(found.objects.size(), 2U);
    expect_closed(found);
    std::vector<std::uint16_t> kept = labels.layers[0];
    if (!as_they_are) kept = join_diagonals({labels.size, labels.spacing, kept});
    for (const LabelledObject& object : found.objects) {
      const auto voxels =
          std::count(kept.begin(), kept.end(), static_cast<std::uint16_t>(object.segment.label));
      const double volume = static_cast<double>(voxels * every * every * every);
      EXPECT_NEAR(check_surface(object.surface).volume, volume, 0.01 * volume);
      EXPECT_LT(mean_error(object.segment.label, object.surface), 0.3 * every);
    }
  }
}

/// A rod of two voxels and a cube of three beside a ball of the same label. Where the image places
/// them, their corners are round.
TEST(LabelSurfaces, ThinPartsKeepTheirVolume) {
  const Vec3 middle{16, 16, 14};
  const OwnedLabels labels = labels_where({34, 34, 28}, {1, 1, 1}, [&](const Vec3& p) {
    const bool rod = p.x >= 27 && p.x < 29 && p.y >= 27 && p.y < 29 && p.z >= 4 && p.z < 24;
    const bool cube = std::min({p.x, p.y, p.z}) >= 3 && std::max({p.x, p.y, p.z}) < 6;
    return rod || cube || norm(p - middle) < 9 ? 1 : 0;
  });
  LabelMap map;
  map.size = labels.size;
  map.layers = {labels.labels};
  map.segments = {{"all", 1, 0, {}}};
  Volume scan{map, {}};
  for (const std::uint16_t label : labels.labels) scan.samples.push_back(label == 0 ? 40 : 240);
  scan = smoothed(scan);
  Settings settings;
  settings.tolerance = 0;
  for (const bool with_image : {false, true}) {
    const LabelResult found = with_image ? find_labelled_objects(scan, {map}, settings)
                                         : surfaces_of_labels({map}, settings);
    const TriMesh& surface = found.objects.at(0).surface;
    const std::vector<std::array<Index, 2>> sides(surface.triangles.size(), {1, 0});
    std::vector<double> volumes = parts_of_boundaries(surface, sides).volumes;
    ASSERT_EQ(volumes.size(), 4U) << with_image;
    std::sort(volumes.begin() + 1, volumes.end());
    EXPECT_GT(volumes[1], (with_image ? 0.5 : 0.7) * 27) << with_image;
    EXPECT_GT(volumes[2], 0.7 * 80) << with_image;
    EXPECT_LT(volumes[2], 80) << with_image;
  }
}

/// Without an image nothing tells where an object that nobody chose begins.
TEST(LabelSurfaces, OfLabelsAloneDoNotDependOnObjectsThatNobodyChose) {
  const LabelMap both = labels_of(2, 0);
  LabelMap first = both;
  for (std::uint16_t& label : first.layers[0]) label = label == 1 ? 1 : 0;
  first.segments.pop_back();
  const LabelResult chosen = surfaces_of_labels({both, {both.segments[0]}}, Settings{});
  const LabelResult alone = surfaces_of_labels({first}, Settings{});
  ASSERT_EQ(chosen.objects.size(), 1U);
  EXPECT_EQ(chosen.objects[0].surface.points, alone.objects.at(0).surface.points);
  EXPECT_EQ(chosen.objects[0].surface.triangles, alone.objects[0].surface.triangles);
}

TEST(LabelSurfaces, OfALabelAtTheBorderOfTheMapAreWhole) {
  LabelMap labels;
  labels.size = {6, 6, 6};
  labels.layers.assign(1, std::vector<std::uint16_t>(216, 4));  // nothing but the label
  labels.segments = {{"all", 4, 0, {}}};
  Settings as_extracted;
  as_extracted.tolerance = 0;
  const LabelResult found = surfaces_of_labels({labels}, as_extracted);
  ASSERT_EQ(found.objects.size(), 1U);
  EXPECT_NEAR(check_surface(found.objects[0].surface).volume, 216, 2.16);
}

/// Single voxels of a label shrink to almost nothing; one that is all of its label stays.
TEST(LabelSurfaces, HaveNoPartsBelowAVoxelButTheLargest) {
  LabelMap map = labels_of(2, 0);
  map.segments.push_back({"voxel", 3, 0, {}});
  const auto at = [&](Index i, Index j, Index k) -> std::uint16_t& {
    return map.layers[0][static_cast<std::size_t>(i + map.size[0] * (j + map.size[1] * k))];
  };
  at(2, 2, 2) = 1;
  at(21, 2, 2) = 3;
  Settings settings;
  const auto parts_of = [&](std::size_t object) {
    const LabelResult found = surfaces_of_labels({map}, settings);
    return check_surface(found.objects.at(object).surface).components;
  };
  EXPECT_EQ(parts_of(0), 1);
  EXPECT_EQ(parts_of(2), 1) << "the voxel that is all of its label";
  settings.keep_topology = true;
  EXPECT_EQ(parts_of(0), 2);
}

TEST(LabelSurfaces, OfAPreviewAreRoundedButNotDecimated) {
  Settings settings;
  settings.preview = true;
  const LabelMap labels = labels_of(1, 0);
  for (const LabelResult& found : {find_labelled_objects(usual_scan(), {labels}, settings),
                                   surfaces_of_labels({labels}, settings)}) {
    EXPECT_EQ(*found.parameters.tolerance, 0);
    expect_closed(found);
    for (const LabelledObject& object : found.objects) {
      EXPECT_EQ(std::ssize(object.surface.triangles), object.triangles_extracted);
      EXPECT_TRUE(find_self_intersections(object.surface).empty());
      for (const Vec3& p : object.surface.points) EXPECT_EQ(p, rounded(p));
    }
  }
}

TEST(LabelSurfaces, OfMirroredGridsFaceOutward) {
  Volume scan = usual_scan();
  LabelMap labels = labels_of(1, 0);
  scan.direction.rows[0] = {-1, 0, 0};
  labels.direction.rows[0] = {-1, 0, 0};
  expect_closed(find_labelled_objects(scan, {labels}, Settings{}));
  expect_closed(surfaces_of_labels({labels}, {}));
}

TEST(LabelSurfaces, OverlappingLayersAreFoundEachByItself) {
  LabelMap labels = labels_of(2, 0);
  labels.layers.push_back(labels.layers[0]);
  for (std::uint16_t& label : labels.layers[1]) label = label == 0 ? 0 : 1;
  labels.segments.push_back({"both", 1, 1, {}});
  const LabelResult found = surfaces_of_labels({labels}, {});
  ASSERT_EQ(found.objects.size(), 3U);
  expect_closed(found);
  EXPECT_NEAR(check_surface(found.objects[2].surface).volume,
              check_surface(found.objects[0].surface).volume +
                  check_surface(found.objects[1].surface).volume,
              60);
}

/// The first ball in one layer and the second in another.
LabelMap layered_labels(bool second_first) {
  const LabelMap both = labels_of(1, 0);
  LabelMap map = both;
  map.layers.assign(2, std::vector<std::uint16_t>(both.layers[0].size(), 0));
  const std::size_t of_second = second_first ? 0 : 1;
  for (std::size_t n = 0; n < both.layers[0].size(); ++n) {
    const std::uint16_t label = both.layers[0][n];
    if (label > 0) map.layers[label == 2 ? of_second : 1 - of_second][n] = label;
  }
  map.segments[0].layer = static_cast<Index>(1 - of_second);
  map.segments[1].layer = static_cast<Index>(of_second);
  return map;
}

/// A run has one level, one window and one tolerance, whichever layer comes last.
TEST(LabelSurfaces, DoNotDependOnTheOrderOfLayers) {
  const LabelResult one = find_labelled_objects(usual_scan(), {layered_labels(false)}, Settings{}),
                    other = find_labelled_objects(usual_scan(), {layered_labels(true)}, Settings{});
  ASSERT_EQ(one.objects.size(), 2U);
  ASSERT_EQ(other.objects.size(), 2U);
  EXPECT_EQ(one.parameters.level, other.parameters.level);
  EXPECT_NEAR(*one.parameters.tolerance, *other.parameters.tolerance, 1e-9);
  EXPECT_EQ(one.parameters.blur, other.parameters.blur);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(one.objects[n].segment.name, other.objects[1 - n].segment.name);
    EXPECT_EQ(one.objects[n].surface.points, other.objects[1 - n].surface.points);
  }
}

TEST(LabelSurfaces, AreTheSameForAnyNumberOfThreads) {
  const LabelResult& one = objects_by_one_thread();
  const LabelResult two = with_threads(
      2, [] { return find_labelled_objects(usual_scan(), {labels_of(1, 0)}, Settings{}); });
  ASSERT_EQ(one.objects.size(), two.objects.size());
  for (std::size_t n = 0; n < one.objects.size(); ++n) {
    EXPECT_EQ(one.objects[n].surface.triangles, two.objects[n].surface.triangles);
    EXPECT_EQ(one.objects[n].surface.points, two.objects[n].surface.points);
    EXPECT_EQ(one.objects[n].expected_error, two.objects[n].expected_error);
  }
}

TEST(LabelSurfaces, RefuseWhatIsNotThere) {
  const Volume& scan = usual_scan();
  LabelMap labels = labels_of(1, 0);
  labels.origin.x = 500;
  EXPECT_REFUSED(find_labelled_objects(scan, {labels}, Settings{}),
                 ::testing::HasSubstr("expected voxels of chosen labels"));
  LabelMap many = labels_of(1, 0);
  for (Index label = 3; label < 5000; ++label) many.segments.push_back({"one", label, 0, {}});
  EXPECT_REFUSED(surfaces_of_labels({many}, {}), ::testing::HasSubstr("at most 4096"));
  LabelMap none = labels_of(1, 0);
  none.segments.push_back({"third", 3, 0, {}});
  EXPECT_REFUSED(surfaces_of_labels({none, {none.segments[2]}}, {}),
                 ::testing::HasSubstr("'third'"));
}

}  // namespace
}  // namespace mesamis
