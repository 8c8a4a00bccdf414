// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/phantom_designs.h"

#include <limits>

#include "mesamis/phantom/implicit_shapes.h"

namespace mesamis::detail::phantom {
namespace {

/// The vector in a frame that is turned about z, then about its own y.
Vec3 turned(const Vec3& p, double about_z, double about_y) {
  const double cz = std::cos(about_z), sz = std::sin(about_z);
  const Vec3 q{cz * p.x + sz * p.y, cz * p.y - sz * p.x, p.z};
  const double cy = std::cos(about_y), sy = std::sin(about_y);
  return {cy * q.x - sy * q.z, q.y, cy * q.z + sy * q.x};
}

double sphere(const Vec3& p) { return ball(p, {0, 0, 0}, 20); }

double plate(const Vec3& p) { return round_box(turned(p, 0.35, 0.25), {22, 18, 1}, 0.6); }

/// A wall that grows thin, beside a ball of the same value. The wall is 3 mm thick at one end and
/// 0.3 mm at the other one, 52 mm further.
double wall(const Vec3& p) {
  const Vec3 q = turned(p - Vec3{0, 9, 0}, 0.3, 0.2);
  const double taper = tapered_profile(std::abs(q.y), 26 - q.x, {1.5, 0.15, 52});
  const double sheet = smooth_intersection(taper, 24 - std::abs(q.z), 0.3);
  return std::max(sheet, ball(p, {0, -16, 0}, 12));
}

/// The wedge that is missing runs along y; it is 5 mm wide where it begins and 0.5 mm at its tip.
double fracture(const Vec3& p) {
  const Vec3 q = turned(p, 0, 0.12);
  const double bone = round_box(turned(p, 0.2, 0), {17, 13, 25}, 7);
  const double gap = tapered_profile(std::abs(q.z), q.x + 5, {0.25, 2.5, 27});
  return smooth_intersection(bone, -gap, 0.6);
}

/// Shaft, neck, head and greater trochanter; the shaft is sawn off.
double femur(const Vec3& p) {
  const double bow = 0.0008 * (p.z + 10) * (p.z + 10);
  const Vec3 q{p.x - 6, (p.y - bow) / 1.1, p.z};
  const double shaft = tapered_capsule(q, {{0, 0, -60}, 7.5}, {{1, 0, 14}, 9});
  const double neck = capsule(q, {1, 0, 14}, {-18, -1, 28}, 6.5);
  const double trochanter = tapered_capsule(q, {{3, 1, 14}, 8.5}, {{6, 2, 25}, 6});
  const double whole = smooth_union(smooth_union(smooth_union(shaft, trochanter, 5), neck, 6),
                                    ball(q, {-19, -1, 29}, 11), 3);
  return smooth_intersection(whole / 1.1, p.z + 42, 1);
}

/// A gyroid, about -1 to 1.
double gyroid(const Vec3& p, double wavelength) {
  const double k = 2 * 3.14159265358979323846 / wavelength;
  return (std::sin(k * p.x) * std::cos(k * p.y) + std::sin(k * p.y) * std::cos(k * p.z) +
          std::sin(k * p.z) * std::cos(k * p.x)) /
         1.5;
}

/// A dense shell, thick at the shaft and thin at the head, around a network of beams.
double femur_grey(const Vec3& p, double depth) {
  const double thickness = 3.5 - 2 * smooth_step(p.z, -10, 18);
  const double spongy = 200 + 15 * std::clamp(2 * gyroid(p, 7), -1.0, 1.0);
  return kBone + (spongy - kBone) * smooth_step(depth, thickness - 0.5, thickness + 0.5);
}

}  // namespace

const std::vector<PhantomDesign>& phantom_designs() {
  static const std::vector<PhantomDesign> designs{
      {"sphere", "a ball of radius 20 mm", {64, 64, 64}, 1, {}, sphere, nullptr},
      {"plate", "a thin wall, 44 x 36 x 2 mm, askew", {64, 64, 64}, 0.8, {}, plate, nullptr},
      {"wall",
       "a wall that grows thin, 3 to 0.3 mm, beside a ball",
       {72, 72, 72},
       0.25,
       {},
       wall,
       nullptr},
      {"femur",
       "the upper end of a femur: dense shell, spongy core",
       {64, 64, 96},
       1,
       {},
       femur,
       femur_grey,
       std::numeric_limits<double>::infinity()},
      {"fracture",
       "a block of bone with a gap that closes to a crack tip",
       {64, 64, 64},
       0.8,
       {{2, -5, 4, 0.2}, {0, -7, -3, 0.25}},
       fracture,
       nullptr},
      {"hemipelvis",
       "a fractured hip bone: thin curved wing, socket, obturator foramen",
       {204, 244, 304},
       1.2,
       {{1, -20, 6, 0.3}, {2, 17, 25, 0.3}},
       hemipelvis_inside,
       hemipelvis_grey,
       2},
  };
  return designs;
}

}  // namespace mesamis::detail::phantom
