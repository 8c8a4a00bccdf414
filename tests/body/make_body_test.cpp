// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/make_body.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/region.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "support/metric_fields.h"
#include "support/shapes.h"
#include "support/solids.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kRadius = 10, kTolerance = 0.1;

BodyOptions of_size(double size) {
  BodyOptions options;
  options.element_size = size;
  options.tolerance = kTolerance;
  return options;
}

Box box_around(const TriMesh& surface, double margin = 2) {
  const Box box = bounding_box(surface.points);
  const Vec3 all{margin, margin, margin};
  return {box.lo - all, box.hi + all};
}

/// What holds for the skin of any body.
void expect_closed_skin(const TriMesh& skin) {
  EXPECT_EQ(solid_flaws_of(check_surface(skin)), "");
  EXPECT_TRUE(find_self_intersections(skin).empty());
}

/// Both directions, insides of triangles included.
void expect_within(const TriMesh& skin, const TriMesh& surface, double tolerance) {
  EXPECT_LT(max_distance(skin, surface, 0.01 * tolerance), tolerance);
  EXPECT_LT(max_distance(surface, skin, 0.01 * tolerance), tolerance);
}

void expect_good_elements(const MeshedBody& body) {
  EXPECT_EQ(body.quality.elements, std::ssize(body.elements.mesh.cells));
  EXPECT_EQ(body.elements.materials.size(), body.elements.mesh.cells.size());
  EXPECT_GT(body.quality.scaled_jacobian_min, 0.1);
  EXPECT_GT(body.quality.least_angle, 10.7);
}

TEST(MakeBody, FillsABall) {
  const TriMesh surface = ball_surface(kRadius, 64);
  const MeshedBody body = make_body(std::vector{surface}, box_around(surface), of_size(3));
  const TriMesh skin = body_skin(body.elements);
  expect_closed_skin(skin);
  // The middles of triangles and sides are held to the tolerance, what lies between is not much
  // off.
  expect_within(skin, surface, 1.5 * kTolerance);
  const double volume = check_surface(surface).volume;
  EXPECT_NEAR(mesh_volume(body.elements.mesh), volume, 0.002 * volume);
  EXPECT_NEAR(check_surface(skin).volume, mesh_volume(body.elements.mesh), 1e-9 * volume);
  expect_good_elements(body);
  EXPECT_EQ(body.element_size, 3);
  EXPECT_EQ(body.least_size, 0.75);
  EXPECT_EQ(body.narrow_share, 0);
  EXPECT_NEAR(body.fit.skin_to_surface, max_distance(skin, surface, 0.01 * kTolerance), 1e-9);
  EXPECT_EQ(body.fit.elements_of_skin_only, 0);
  EXPECT_EQ(body.parts, 1);
  EXPECT_EQ(body.parts_dropped, 0);
  EXPECT_TRUE(std::ranges::all_of(body.elements.materials, [](Material m) { return m == 1; }));
}

TEST(MakeBody, AFinerToleranceIsKeptToo) {
  const TriMesh surface = ball_surface(kRadius, 64);
  BodyOptions options = of_size(3);
  options.tolerance = 0.03;
  const MeshedBody body = make_body(std::vector{surface}, box_around(surface), options);
  expect_within(body_skin(body.elements), surface, 1.5 * 0.03);
}

TEST(MakeBody, WhereTheBoxCutsABallTheBodyIsFlat) {
  const TriMesh surface = ball_above(-4, kRadius, 64);
  const Box box{{-12, -12, -4}, {12, 12, 12}};
  const MeshedBody body = make_body(std::vector{surface}, box, of_size(3));
  const TriMesh skin = body_skin(body.elements);
  expect_closed_skin(skin);
  expect_good_elements(body);
  expect_within(skin, surface, 1.5 * kTolerance);
  double cap = 0;
  for (const Triangle& t : skin.triangles) {
    const Vec3 &a = skin.points[t[0]], &b = skin.points[t[1]], &c = skin.points[t[2]];
    if (a.z == -4 && b.z == -4 && c.z == -4) cap += 0.5 * norm(cross(b - a, c - a));
  }
  const double disc = std::numbers::pi * (kRadius * kRadius - 16);
  EXPECT_NEAR(cap, disc, 0.02 * disc);
  for (const Vec3& p : skin.points) EXPECT_GE(p.z, -4);
}

/// Two balls nearer to each other than the least size: they stay apart.
TEST(MakeBody, ANarrowGapStaysOpen) {
  constexpr double kGap = 0.4;
  TriMesh pair = ball_surface(kRadius, 48);
  const TriMesh other = pair;
  const auto first = static_cast<Index>(pair.points.size());
  for (const Vec3& p : other.points) pair.points.push_back(p + Vec3{2 * kRadius + kGap, 0, 0});
  for (const Triangle& t : other.triangles) {
    pair.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  BodyOptions options = of_size(4);
  options.least_size = 2;
  const MeshedBody body = make_body(std::vector{pair}, box_around(pair), options);
  const TriMesh skin = body_skin(body.elements);
  expect_closed_skin(skin);
  expect_good_elements(body);
  EXPECT_EQ(body.parts, 2);
  EXPECT_GT(body.narrow_share, 0.01);
  EXPECT_LT(body.narrow_share, 0.5);
  EXPECT_EQ(check_surface(skin).components, 2);
}

using Triple = std::array<std::array<double, 3>, 3>;

/// The triangles by their places, in whatever order of the corners.
std::set<Triple> places_of(const TriMesh& skin) {
  std::set<Triple> places;
  for (const Triangle& t : skin.triangles) {
    Triple triple;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = skin.points[t[i]];
      triple[i] = {p.x, p.y, p.z};
    }
    std::sort(triple.begin(), triple.end());
    places.insert(triple);
  }
  return places;
}

double area_of(const Triple& t) {
  const auto point = [&](std::size_t i) { return Vec3{t[i][0], t[i][1], t[i][2]}; };
  return 0.5 * norm(cross(point(1) - point(0), point(2) - point(0)));
}

/// Two halves of a ball that share the disc at z = 0.
std::vector<TriMesh> two_halves() {
  const TriMesh upper = ball_above(0, kRadius, 48);
  return {upper, mirrored(upper)};
}

TEST(MakeBody, ObjectsThatTouchShareTheirTriangles) {
  const auto surfaces = two_halves();
  const Box box{{-12, -12, -12}, {12, 12, 12}};
  const MeshedBody body = make_body(surfaces, box, of_size(3));
  const TriMesh upper = body_skin(body.elements, 1), lower = body_skin(body.elements, 2);
  const TriMesh all = body_skin(body.elements);
  for (const TriMesh& skin : {upper, lower, all}) {
    EXPECT_TRUE(check_surface(skin).closed());
    EXPECT_EQ(check_surface(skin).misoriented_edges, 0);
  }
  const auto in_upper = places_of(upper), in_lower = places_of(lower), in_all = places_of(all);
  double shared = 0;
  std::size_t count = 0;
  for (const Triple& t : in_upper) {
    if (!in_lower.count(t)) continue;
    EXPECT_FALSE(in_all.count(t));
    for (const auto& p : t) EXPECT_NEAR(p[2], 0, kTolerance);
    shared += area_of(t);
    ++count;
  }
  EXPECT_EQ(in_all.size(), in_upper.size() + in_lower.size() - 2 * count);
  const double disc = std::numbers::pi * kRadius * kRadius;
  EXPECT_NEAR(shared, disc, 0.01 * disc);
  const double half = check_surface(surfaces[0]).volume;
  EXPECT_NEAR(check_surface(upper).volume, half, 0.005 * half);
  EXPECT_NEAR(check_surface(lower).volume, half, 0.005 * half);
  expect_within(upper, surfaces[0], 1.5 * kTolerance);
  expect_within(lower, surfaces[1], 1.5 * kTolerance);
  expect_good_elements(body);
}

TEST(MakeBody, IsTheSameForAnyNumberOfThreads) {
  const std::vector surfaces{brick({{0, 0, 0}, {6, 6, 5}}, {6, 6, 5}),
                             brick({{0, 0, 5}, {6, 6, 10}}, {6, 6, 5})};
  const Box box{{-2, -2, -2}, {8, 8, 12}};
  auto make = [&] { return make_body(surfaces, box, of_size(3)); };
  const MeshedBody once = with_threads(1, make);
  for (const int threads : {2, 4}) {
    const MeshedBody again = with_threads(threads, make);
    EXPECT_EQ(mesh_hash(again.elements.mesh), mesh_hash(once.elements.mesh)) << threads;
    EXPECT_EQ(again.elements.materials, once.elements.materials);
    EXPECT_EQ(again.quality.least_angle, once.quality.least_angle);
  }
}

TEST(MakeBody, SmallPartsAreLeftOutAndCounted) {
  const TriMesh surface =
      joined(ball_surface(kRadius, 40), moved(ball_surface(1.5, 24), {14, 0, 0}));
  BodyOptions options = of_size(6);
  options.least_size = 1;
  options.part_share = 0;
  const MeshedBody both = make_body(std::vector{surface}, box_around(surface), options);
  EXPECT_EQ(both.parts, 2);
  EXPECT_EQ(both.parts_dropped, 0);
  options.part_share = 0.01;  // the small ball has 0.3 %
  const MeshedBody one = make_body(std::vector{surface}, box_around(surface), options);
  EXPECT_EQ(one.parts, 1);
  EXPECT_EQ(one.parts_dropped, 1);
  EXPECT_EQ(one.elements.materials.size(), one.elements.mesh.cells.size());
  for (const Vec3& p : one.elements.mesh.points) EXPECT_LT(norm(p), kRadius + 0.5);
  EXPECT_LT(mesh_volume(one.elements.mesh), mesh_volume(both.elements.mesh));
}

/// A small object of its own stays, however large the others are.
TEST(MakeBody, ASmallObjectIsNoSmallPart) {
  const std::vector surfaces{ball_surface(kRadius, 40), moved(ball_surface(1.5, 24), {14, 0, 0})};
  BodyOptions options = of_size(4);
  options.least_size = 1;
  options.part_share = 0.01;
  const MeshedBody body = make_body(surfaces, {{-12, -12, -12}, {18, 12, 12}}, options);
  EXPECT_EQ(body.parts, 2);
  EXPECT_GT(std::ranges::count(body.elements.materials, Material{2}), 0);
}

/// A ball with something thin at its top: a cone or a rod that is as wide at its foot, a pit of
/// that width, or a rim around the equator that is as thick.
enum class Thin { kCone, kRod, kPit, kRim };

TriMesh ball_with(Thin kind, double width, double length) {
  constexpr int kSteps = 24;
  const double half = 0.5 * width;
  const double foot = std::asin(half / kRadius);  // as an angle at the ball's centre
  std::vector<ProfilePoint> profile;
  const auto arc = [&](double from, double to) {  // angles from the z axis
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = from + (to - from) * i / kSteps;
      const double radius = i == 0 && angle >= std::numbers::pi ? 0 : kRadius * std::sin(angle);
      profile.push_back({radius, kRadius * std::cos(angle)});
    }
  };
  if (kind == Thin::kRim) {
    arc(std::numbers::pi, 0.5 * std::numbers::pi + foot);
    profile.push_back({kRadius + length, -half});
    profile.push_back({kRadius + length, half});
    arc(0.5 * std::numbers::pi - foot, 0);
    profile.back().radius = 0;
    return revolved(profile, 64);
  }
  arc(std::numbers::pi, foot);
  if (kind == Thin::kRod) profile.push_back({half, kRadius + length});
  profile.push_back({0, kRadius + (kind == Thin::kPit ? -length : length)});
  return revolved(profile, 64);
}

/// How wide a cone or a pit is where the skin ends, that misses its tip by a distance.
double width_at(double missed, double width, double length) { return width * missed / length; }

/// Rods and rims are kept, cones and pits down to about the width of the smallest elements that are
/// tried, which are there alone.
TEST(MakeBody, ThinThingsAreKept) {
  constexpr double kLength = 4, kNarrow = 2;
  constexpr double kSmallest = 6.0 / 4 / 8;  // a quarter of the element size, halved three times
  const TriMesh ball = ball_surface(kRadius, 64);
  BodyOptions options = of_size(6);
  options.tolerance = 0.3;
  const auto plain = make_body(std::vector{ball}, box_around(ball), options).quality.elements;
  for (const Thin kind : {Thin::kCone, Thin::kRod, Thin::kPit, Thin::kRim}) {
    for (const double width : {0.4, 0.8, 1.6}) {
      SCOPED_TRACE(testing::Message() << "kind " << static_cast<int>(kind) << ", width " << width);
      const bool is_rim = kind == Thin::kRim;
      const TriMesh surface = ball_with(kind, width, is_rim ? 1 : kLength);
      ASSERT_EQ(solid_flaws_of(check_surface(surface)), "");
      const MeshedBody body = make_body(std::vector{surface}, box_around(surface), options);
      const TriMesh skin = body_skin(body.elements);
      expect_closed_skin(skin);
      expect_good_elements(body);
      EXPECT_LT(body.fit.skin_to_surface, options.tolerance);
      const double missed = body.fit.surface_to_skin;
      if (is_rim) {
        EXPECT_LT(missed, 0.5) << "of 1 mm: its sharp edges are cut, but it is there";
      } else if (kind == Thin::kRod) {
        EXPECT_LT(missed, options.tolerance);
      } else if (missed > options.tolerance) {
        EXPECT_LT(width_at(missed, width, kLength), kNarrow * kSmallest) << missed;
      }
      EXPECT_LT(body.quality.elements, (is_rim ? 20 : 2) * plain);
    }
  }
}

/// A rod thinner than the least size that is asked for is lost, and nothing is made twice.
TEST(MakeBody, ALeastSizeThatIsGivenIsKept) {
  const TriMesh surface = ball_with(Thin::kRod, 0.4, 4);
  BodyOptions options = of_size(6);
  options.tolerance = 0.3;
  options.least_size = 1.5;
  const MeshedBody body = make_body(std::vector{surface}, box_around(surface), options);
  EXPECT_EQ(body.least_size, 1.5);
  EXPECT_GT(body.fit.surface_to_skin, 3);
  EXPECT_LT(body.fit.skin_to_surface, options.tolerance);
}

TEST(MakeBody, RefusesMoreElementsThanMayBeMade) {
  const TriMesh surface = ball_surface(kRadius, 40);
  BodyOptions options = of_size(3);
  options.most_elements = 1000;
  EXPECT_REFUSED(make_body(std::vector{surface}, box_around(surface), options),
                 AllOf(HasSubstr("of which 1000 may be made; expected an element size of at least"),
                       HasSubstr(" mm")));
  options.element_size = 1e-4;  // as fast
  options.most_elements = 1'000'000;
  EXPECT_REFUSED(make_body(std::vector{surface}, box_around(surface), options),
                 HasSubstr("of which 1000000 may be made"));
}

TEST(MakeBody, TheElementSizeIsAThirtiethOfTheLongestSideUnlessGiven) {
  const TriMesh surface = brick({{0, 0, 0}, {30, 4, 4}}, {30, 4, 4});
  const MeshedBody body = make_body(std::vector{surface}, box_around(surface), {});
  EXPECT_DOUBLE_EQ(body.element_size, 1);
}

TEST(MakeBody, RefusesElementsLargerThanTheBody) {
  const TriMesh surface = ball_surface(kRadius, 24);
  EXPECT_REFUSED(make_body(std::vector{surface}, box_around(surface), of_size(21)),
                 HasSubstr("expected an element size of at most"));
}

TEST(MakeBody, RefusesNoObjects) {
  EXPECT_REFUSED(make_body({}, kUnitBox, of_size(1)), testing::_);
  EXPECT_REFUSED(make_body({}, kUnitBox, {}), HasSubstr("expected 1 to 255 objects, found 0"));
}

TEST(MakeBody, ProgressStopsIt) {
  const TriMesh surface = ball_surface(kRadius, 24);
  BodyOptions options = of_size(4);
  double last = 0;
  options.progress = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    return fraction < 0.6;
  };
  EXPECT_THROW(make_body(std::vector{surface}, box_around(surface), options), Cancelled);
  EXPECT_GE(last, 0.6);
}

}  // namespace
}  // namespace mesamis
