// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/fan_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mesamis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A point seen along the normal: its place in the view, and its height.
struct Seen {
  double x, y, height;
};

double turn(const Seen& a, const Seen& b) { return a.x * b.y - a.y * b.x; }

Seen from_to(const Seen& a, const Seen& b) { return {b.x - a.x, b.y - a.y, b.height - a.height}; }

/// The ring seen from the apex, which is the origin; empty where the first fan has no area.
std::vector<Seen> seen_ring(const Vec3& apex, std::span<const Vec3> ring) {
  Vec3 normal{0, 0, 0};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    normal += cross(ring[i] - apex, ring[(i + 1) % ring.size()] - apex);
  }
  const double length = norm(normal);
  if (!(length > 0)) return {};
  normal = (1 / length) * normal;
  const bool steep = std::abs(normal.z) < 0.5;
  Vec3 side = cross(normal, steep ? Vec3{0, 0, 1} : Vec3{1, 0, 0});
  side = (1 / norm(side)) * side;
  const Vec3 up = cross(normal, side);
  std::vector<Seen> seen;
  seen.reserve(ring.size());
  for (const Vec3& p : ring) {
    const Vec3 d = p - apex;
    seen.push_back({dot(d, side), dot(d, up), dot(d, normal)});
  }
  return seen;
}

/// Whether no triangle of either fan is turned over, and the ring goes round the apex once. The
/// second fan has the same rim as the first: without a turned triangle it covers the same part of
/// the view, once.
bool lies_flat(const std::vector<Seen>& ring) {
  const std::size_t n = ring.size();
  int rounds = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Seen &a = ring[i], &b = ring[(i + 1) % n];
    if (!(turn(a, b) > 0)) return false;
    if (a.y < 0 && b.y >= 0) ++rounds;
    const bool at_target = i == 0 || i + 1 == n;
    if (!at_target && !(turn(from_to(ring[0], a), from_to(ring[0], b)) > 0)) return false;
  }
  return rounds == 1;
}

/// The height of the second fan at the apex.
double height_at_apex(const std::vector<Seen>& ring) {
  const Seen apex = from_to(ring[0], {0, 0, 0});
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Seen a = from_to(ring[0], ring[i]), b = from_to(ring[0], ring[i + 1]);
    const double to_a = turn(apex, b), to_b = turn(a, apex);
    if (to_a < 0 || to_b < 0) continue;
    return ring[0].height + (to_a * a.height + to_b * b.height) / turn(a, b);
  }
  return kInfinity;  // the apex is at the rim, but for round-off
}

/// The greatest height between edges of the first fan and of the second that cross.
double height_at_crossings(const std::vector<Seen>& ring) {
  double greatest = 0;
  for (std::size_t j = 2; j + 1 < ring.size(); ++j) {
    const Seen second = from_to(ring[0], ring[j]);
    for (std::size_t i = 1; i < ring.size(); ++i) {
      if (i == j) continue;
      const double both = turn(ring[i], second);
      const double on_first = turn(ring[0], second) / both,
                   on_second = turn(ring[0], ring[i]) / both;
      if (!(on_first > 0 && on_first < 1 && on_second > 0 && on_second < 1)) continue;
      const double height = ring[0].height + on_second * second.height;
      greatest = std::max(greatest, std::abs(on_first * ring[i].height - height));
    }
  }
  return greatest;
}

}  // namespace

double fan_distance(const Vec3& apex, std::span<const Vec3> ring) {
  const std::vector<Seen> seen = seen_ring(apex, ring);
  if (seen.empty() || !lies_flat(seen)) return kInfinity;
  return std::max(std::abs(height_at_apex(seen)), height_at_crossings(seen));
}

}  // namespace mesamis
