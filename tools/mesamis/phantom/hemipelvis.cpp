// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/implicit_shapes.h"
#include "mesamis/phantom/phantom_designs.h"

namespace mesamis::detail::phantom {
namespace {

/// A left hip bone: x to the side, y to the back, z up; the middle of the socket is at kSocket.
constexpr Vec3 kSocket{22, -8, -32};

// The wing lies near a sphere, whose middle is in front of it, on the side of the belly.
constexpr double kWingRadius = 120;

/// Coordinates along the wing: over the sphere from its pole (a to the back, b up, seen along
/// its axis) and off it.
struct WingPlace {
  double a, b, off;
  bool behind;  ///< on the other half of the sphere
};

struct WingFrame {
  Vec3 pole = unit({0.86, 0.46, -0.12});  ///< from the middle of the sphere
  Vec3 up = unit(Vec3{0, 0, 1} - pole.z * pole);
  Vec3 back = cross(up, pole);
  Vec3 center = Vec3{6, 14, 82} - kWingRadius * pole;  ///< seen from the socket

  WingPlace place(const Vec3& p) const {
    const Vec3 v = p - center;
    const double radius = norm(v);
    const double stretch = kWingRadius / std::max(radius, 0.85 * kWingRadius);
    return {stretch * dot(v, back), stretch * dot(v, up), radius - kWingRadius, dot(v, pole) < 0};
  }
};

constexpr double kOutlineEnd = 15;

/// Within the wing's edge, seen along its normal; cut off where it is far from zero.
double wing_outline(double a, double b) {
  const double crest = 80 - length(a, b + 15);
  const double front = 0.907 * (a + 76) + 0.42 * (b - 15);
  const double rear = -0.88 * (a - 78) + 0.476 * (b - 5);
  const double fan = smooth_intersection(smooth_intersection(crest, front, 20), rear, 20);
  const double sciatic_notch = length(a - 70, b + 48) - 25;
  const double front_notch = length(a + 70, b + 24) - 14;
  const double outline =
      smooth_intersection(smooth_intersection(fan, sciatic_notch, 10), front_notch, 8);
  return std::clamp(outline, -kOutlineEnd, kOutlineEnd);
}

/// A sheet, 4 mm thin in its middle, bent like an S, with a bead along its edge.
double wing(const WingPlace& q) {
  const double s_shape = 6 * std::sin(q.a / 38) * smooth_step(q.b, -60, 50);
  const double off = q.off - s_shape;
  const double outline = q.behind ? -kOutlineEnd : wing_outline(q.a, q.b);
  const double half = 2 + 5 * (1 - smooth_step(q.b, -85, -25)) + 3 * smooth_step(q.a, 25, 75);
  const double sheet = smooth_intersection(half - std::abs(off), outline, 3);
  const double bead = 4.5 - length(off, outline - 3.5);
  return smooth_union(sheet, bead, 5) / 1.35;
}

/// From above the crest down into the wing, along a wave; 7 mm wide there and 0.6 mm at the tip.
double gap(const WingPlace& q) {
  const double across = std::abs(q.a + 10 - 3 * std::sin(q.b / 18));
  return tapered_profile(across, q.b + 30, {0.3, 3.5, 110}) / 1.35;
}

/// What bears the load: around the socket, up to the wing, down to the ischium.
double columns(const Vec3& p) {
  const double rim = ball(p, {-6, 2, 3}, 31);
  const double pillar = tapered_capsule(p, {{-6, 0, 12}, 20}, {{-8, 6, 46}, 7});
  const double buttress = tapered_capsule(p, {{-6, 10, 12}, 16}, {{-19, 40, 46}, 7});
  const double ischium = tapered_capsule(p, {{-10, 14, -10}, 18}, {{-14, 30, -66}, 13});
  const double tuber = tapered_capsule(p, {{-14, 30, -66}, 14}, {{-20, 20, -80}, 10});
  const double spine = tapered_capsule(p, {{-14, 26, -16}, 8}, {{-30, 42, -24}, 3});
  double all = smooth_union(smooth_union(rim, pillar, 14), buttress, 12);
  all = smooth_union(smooth_union(all, ischium, 10), tuber, 6);
  return smooth_union(all, spine, 6);
}

/// Around the obturator foramen.
double pubis(const Vec3& p) {
  const double upper = tapered_capsule(p, {{-12, -16, -4}, 13}, {{-62, -48, -22}, 8.5});
  const double body = tapered_capsule(p, {{-64, -49, -24}, 10}, {{-68, -42, -48}, 9});
  const double lower = tapered_capsule(p, {{-66, -40, -50}, 7}, {{-24, 16, -82}, 7.5});
  return smooth_union(smooth_union(upper, body, 8), lower, 8);
}

/// The joint with the sacrum, and the bumps where muscles begin.
double bumps(const WingPlace& q, const Vec3& p) {
  const double joint = 7 - norm(Vec3{std::max(std::abs(q.a - 56) - 10, 0.0),
                                     std::max(std::abs(q.b + 4) - 12, 0.0), q.off + 1});
  const double front = tapered_capsule(p, {{4, -18, 16}, 9}, {{7, -28, 33}, 5});
  return smooth_union(joint / 1.35, front, 5);
}

double socket(const Vec3& p) { return ball(p, {9, -7, -7}, 26); }

double whole_bone(const Vec3& p, const WingPlace& q) {
  const double upper = smooth_union(wing(q), bumps(q, p), 8);
  const double all = smooth_union(smooth_union(upper, columns(p), 12), pubis(p), 8);
  return smooth_intersection(all, -socket(p), 3);
}

}  // namespace

double hemipelvis_inside(const Vec3& p) {
  static const WingFrame frame;
  const Vec3 local = p - kSocket;
  const WingPlace place = frame.place(local);
  return smooth_intersection(whole_bone(local, place), -gap(place), 0.6);
}

/// A dense shell of 1.5 mm around lighter bone.
double hemipelvis_grey(const Vec3&, double depth) { return kBone - 30 * smooth_step(depth, 1, 2); }

}  // namespace mesamis::detail::phantom
