// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/body_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/body/wall_width.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis::detail::body {
namespace {

constexpr std::size_t kMostObjects = 255;

/// The triangles that do not lie in a plane of the box.
TriMesh without_caps(const TriMesh& surface, const Box& box) {
  TriMesh rest{surface.points, {}};
  for (const Triangle& t : surface.triangles) {
    const auto& p = surface.points;
    if (planes_of(box, p[t[0]]) & planes_of(box, p[t[1]]) & planes_of(box, p[t[2]])) continue;
    rest.triangles.push_back(t);
  }
  return rest;
}

/// How far a triangle may be left towards a side whose width is known at the points.
std::vector<double> tolerances(const TriMesh& skin, std::span<const double> width, double most) {
  constexpr double kShare = 0.2, kLeastShare = 0.05;
  std::vector<double> result;
  result.reserve(skin.triangles.size());
  for (const Triangle& t : skin.triangles) {
    const double room = std::min({width[t[0]], width[t[1]], width[t[2]]});
    result.push_back(std::clamp(kShare * room, kLeastShare * most, most));
  }
  return result;
}

Vec3 clamped(const Vec3& p, const Box& box) {
  return {std::clamp(p.x, box.lo.x, box.hi.x), std::clamp(p.y, box.lo.y, box.hi.y),
          std::clamp(p.z, box.lo.z, box.hi.z)};
}

double squared_distance_to(const Box& box, const Vec3& p) {
  const Vec3 way = p - clamped(p, box);
  return dot(way, way);
}

}  // namespace

BodySurface::BodySurface(std::span<const TriMesh> surfaces, const Box& box, double tolerance)
    : box_(box), inner_box_(box), tolerance_(tolerance), junctions_(surfaces) {
  if (surfaces.empty() || surfaces.size() > kMostObjects) {
    throw InputError("body: expected 1 to 255 objects, found " + std::to_string(surfaces.size()));
  }
  // A point in a plane of the box is asked for a little inside: there its sign is certain.
  constexpr double kInward = 1e-6;
  const Vec3 inward = kInward * norm(box.extent()) * Vec3{1, 1, 1};
  inner_box_ = {box.lo + inward, box.hi - inward};
  for (const TriMesh& surface : surfaces) {
    const TriMesh rest = without_caps(surface, box);
    auto part = std::make_unique<Part>(
        Part{bounding_box(surface.points), SignedDistance(surface), std::nullopt, {}, {}, {}, {}});
    if (rest.triangles.size() < surface.triangles.size()) part->off_box.emplace(rest);
    measure_walls(*part, surface, rest);
    parts_.push_back(std::move(part));
  }
}

// A small share of the wall inward and of the gap outward: their two sides never meet.
void BodySurface::measure_walls(Part& part, const TriMesh& surface, const TriMesh& skin) const {
  const double widest = norm(part.box.extent());
  part.thickness = wall_widths(surface, part.whole, Side::kWall, widest);
  part.gap = wall_widths(surface, part.whole, Side::kGap, widest);
  part.inner = tolerances(skin, part.thickness, tolerance_);
  part.outer = tolerances(skin, part.gap, tolerance_);
}

Vec3 BodySurface::off_planes(const Vec3& p) const { return clamped(p, inner_box_); }

double BodySurface::signed_distance(Material object, const Vec3& p) const {
  const Part& part = *parts_[object - 1U];
  const double d = part.whole.at(off_planes(p)).signed_to;
  if (!part.off_box) return d;
  return std::copysign(part.off_box->at(p).distance, d);
}

Material BodySurface::material_at(const Vec3& p) const {
  const Vec3 inside = off_planes(p);
  Material deepest = kOutside;
  double least = 0;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (!parts_[k]->box.contains(inside)) continue;
    const double d = signed_distance(static_cast<Material>(k + 1), p);
    if (!(d < least)) continue;
    least = d;
    deepest = static_cast<Material>(k + 1);
  }
  return deepest;
}

// Regula falsi with halved ends (Illinois): a bracket that always holds, and few look-ups where the
// distance is nearly linear.
double BodySurface::crossing(const Vec3& a, const Vec3& b) const {
  constexpr int kSteps = 12;
  constexpr double kFine = 1e-4;
  const Material of_a = material_at(a);
  const Material object = of_a != kOutside ? of_a : material_at(b);
  auto value = [&](double t) { return signed_distance(object, a + t * (b - a)); };
  double low = 0, high = 1, at_low = value(0), at_high = value(1);
  if ((at_low < 0) == (at_high < 0)) return 0.5;
  int last = 0;
  double t = 0.5;
  for (int step = 0; step < kSteps && high - low > kFine; ++step) {
    t = low + (high - low) * std::clamp(at_low / (at_low - at_high), 0.01, 0.99);
    const double here = value(t);
    if (std::abs(here) < kFine * norm(b - a)) return t;
    const bool moves_low = (here < 0) == (at_low < 0);
    (moves_low ? low : high) = t;
    (moves_low ? at_low : at_high) = here;
    const int side = moves_low ? -1 : 1;
    if (side == last) (moves_low ? at_high : at_low) *= 0.5;
    last = side;
  }
  return t;
}

/// How deep a point lies in other materials; below 0 in that one. Nowhere does it change by more
/// than the way.
double BodySurface::distance_beyond(Material material, const Vec3& p) const {
  if (material != kOutside) return signed_distance(material, p);
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const double to_box = std::sqrt(squared_distance_to(parts_[k]->box, p));
    if (-to_box <= deepest) continue;
    deepest =
        std::max(deepest, to_box > 0 ? -to_box : -signed_distance(static_cast<Material>(k + 1), p));
  }
  return deepest;
}

// Steps as long as the distance to the border skip nothing; those along it have a least length.
std::optional<double> BodySurface::hidden_crossing(const Vec3& a, const Vec3& b) const {
  constexpr double kLeastStep = 0.5;
  const Material material = material_at(a);
  const double length = norm(b - a);
  double deepest = tolerance_;
  std::optional<double> place;
  for (double t = 0; t < 1;) {
    const double beyond = distance_beyond(material, a + t * (b - a));
    if (beyond > deepest) {
      deepest = beyond;
      place = t;
    }
    t += std::max(std::abs(beyond), kLeastStep * tolerance_) / length;
  }
  return place;
}

BorderPoint BodySurface::nearest_border(const Vec3& p) const {
  BorderPoint nearest{p, tolerance_};
  double least = std::numeric_limits<double>::infinity();
  for (const auto& part : parts_) {
    if (least < std::numeric_limits<double>::infinity() &&
        squared_distance_to(part->box, p) >= least * least) {
      continue;
    }
    const NearestPoint found = part->skin().at(p);
    if (found.distance >= least) continue;
    least = found.distance;
    const auto& tolerance = found.signed_to < 0 ? part->inner : part->outer;
    nearest = {found.point, tolerance[found.triangle]};
  }
  return nearest;
}

}  // namespace mesamis::detail::body
