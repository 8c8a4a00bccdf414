// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/triangle_tree.h"

#include <algorithm>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis::detail::surface {
namespace {

constexpr std::size_t kLeafSize = 4;

double squared_norm(const Vec3& a) { return dot(a, a); }

double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a, ap = p - a;
  const double along = dot(ap, ab), whole = dot(ab, ab);
  if (along <= 0) return squared_norm(ap);
  if (along >= whole) return squared_norm(p - b);
  return squared_norm(ap - (along / whole) * ab);
}

/// The distance of a point that lies above or below the triangle, not beside it.
double squared_distance_to_side(const Vec3& p, const Corners& t) {
  // A triangle this low, relative to its length, has no normal to speak of.
  constexpr double kFlat = 1e-8;
  const Vec3 ab = t[1] - t[0], bc = t[2] - t[1], ca = t[0] - t[2];
  const Vec3 n = cross(ca, ab);
  const double longest = std::max({squared_norm(ab), squared_norm(bc), squared_norm(ca)});
  if (squared_norm(n) > kFlat * kFlat * longest * longest) {
    const double height = dot(n, p - t[0]);
    return height * height / squared_norm(n);
  }
  return std::min({squared_distance_to_segment(p, t[0], t[1]),
                   squared_distance_to_segment(p, t[1], t[2]),
                   squared_distance_to_segment(p, t[2], t[0])});
}

/// Finds the corner, edge or side that the nearest point is on from dot products alone (Ericson:
/// Real-time collision detection, 5.1.5). Most distances of a search are to corners and edges, which
/// need no normal.
/// @param corner  is given its number, and the way from it to p.
/// @param edge    is given its corners, the share of the way between them, and the way from the
///                first to p.
/// @param side    is given the barycentric coordinates, up to a factor.
template <class Corner, class Edge, class Side>
auto at_nearest(const Vec3& p, const Corners& t, Corner&& corner, Edge&& edge, Side&& side) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double ab_ap = dot(ab, ap), ac_ap = dot(ac, ap);
  if (ab_ap <= 0 && ac_ap <= 0) return corner(0, ap);
  const Vec3 bp = p - t[1];
  const double ab_bp = dot(ab, bp), ac_bp = dot(ac, bp);
  if (ab_bp >= 0 && ac_bp <= ab_bp) return corner(1, bp);
  const double beyond_ab = ab_ap * ac_bp - ab_bp * ac_ap;
  if (beyond_ab <= 0 && ab_ap >= 0 && ab_bp <= 0 && ab_ap > ab_bp) {
    return edge(0, 1, ab_ap / (ab_ap - ab_bp), ap);
  }
  const Vec3 cp = p - t[2];
  const double ab_cp = dot(ab, cp), ac_cp = dot(ac, cp);
  if (ac_cp >= 0 && ab_cp <= ac_cp) return corner(2, cp);
  const double beyond_ac = ab_cp * ac_ap - ab_ap * ac_cp;
  if (beyond_ac <= 0 && ac_ap >= 0 && ac_cp <= 0 && ac_ap > ac_cp) {
    return edge(0, 2, ac_ap / (ac_ap - ac_cp), ap);
  }
  const double beyond_bc = ab_bp * ac_cp - ab_cp * ac_bp;
  const double from_b = ac_bp - ab_bp, from_c = ab_cp - ac_cp;
  if (beyond_bc <= 0 && from_b >= 0 && from_c >= 0 && from_b + from_c > 0) {
    return edge(1, 2, from_b / (from_b + from_c), bp);
  }
  return side(beyond_bc, beyond_ac, beyond_ab);
}

std::vector<Corners> corners_of(const TriMesh& surface) {
  std::vector<Corners> corners;
  corners.reserve(surface.triangles.size());
  for (const Triangle& t : surface.triangles) corners.push_back(mesamis::corners_of(surface, t));
  return corners;
}

}  // namespace

double squared_distance(const Vec3& p, const Corners& t) {
  return at_nearest(
      p, t, [](std::size_t, const Vec3& way) { return squared_norm(way); },
      [&](std::size_t from, std::size_t to, double share, const Vec3& way) {
        return squared_norm(way - share * (t[to] - t[from]));
      },
      [&](double, double, double) { return squared_distance_to_side(p, t); });
}

std::array<double, 3> nearest_place(const Vec3& p, const Corners& t) {
  using Place = std::array<double, 3>;
  return at_nearest(
      p, t,
      [](std::size_t corner, const Vec3&) {
        Place place{};
        place[corner] = 1;
        return place;
      },
      [](std::size_t from, std::size_t to, double share, const Vec3&) {
        Place place{};
        place[from] = 1 - share;
        place[to] = share;
        return place;
      },
      [](double a, double b, double c) {
        const double sum = a + b + c;
        return Place{a / sum, b / sum, c / sum};
      });
}

TriangleTree::TriangleTree(const TriMesh& surface) : TriangleTree(corners_of(surface)) {}

TriangleTree::TriangleTree(std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
  std::vector<PlacedItem> items(triangles_.size());
  parallel_for(items.size(), [&](std::size_t t) {
    const Box box = bounding_box(triangles_[t]);
    items[t] = {box.lo + box.hi, static_cast<Index>(t)};
  });
  nodes_.resize(nodes_over(items.size()));
  build(items, 0, 0);
  std::vector<Corners> sorted(items.size());
  order_.resize(items.size());
  parallel_for(items.size(), [&](std::size_t i) {
    order_[i] = items[i].item;
    sorted[i] = triangles_[order_[i]];
  });
  triangles_ = std::move(sorted);
}

/// Makes the node of some items and, halved at the median, its children.
/// @param first  the number of items before these.
void TriangleTree::build(std::span<PlacedItem> items, std::size_t first, std::size_t place) {
  if (items.size() <= kLeafSize) {
    Box box = kNoBox;
    for (const PlacedItem& i : items) box = united(box, bounding_box(triangles_[i.item]));
    nodes_[place] = {box, static_cast<Index>(first), static_cast<Index>(items.size())};
    return;
  }
  const std::size_t half = halve(items);
  const std::size_t second = place + 1 + nodes_over(half);
  const auto build_half = [&](std::size_t child) {
    child == 0 ? build(items.first(half), first, place + 1)
               : build(items.subspan(half), first + half, second);
  };
  parallel_halves(items.size(), build_half);
  nodes_[place] = {united(nodes_[place + 1].box, nodes_[second].box), static_cast<Index>(second),
                   0};
}

/// The nodes of a tree over so many triangles.
std::size_t TriangleTree::nodes_over(std::size_t triangles) {
  if (triangles <= kLeafSize) return 1;
  return 1 + nodes_over(triangles / 2) + nodes_over(triangles - triangles / 2);
}

double TriangleTree::squared_distance_to_box(const Vec3& p, std::size_t node) const {
  const Box& box = nodes_[node].box;
  const double x = std::max({box.lo.x - p.x, 0.0, p.x - box.hi.x});
  const double y = std::max({box.lo.y - p.y, 0.0, p.y - box.hi.y});
  const double z = std::max({box.lo.z - p.z, 0.0, p.z - box.hi.z});
  return x * x + y * y + z * z;
}

double TriangleTree::squared_distance_to(const Vec3& p, std::size_t& hint) const {
  struct Waiting {
    std::size_t node;
    double lower_bound;
  };
  std::array<Waiting, 64> stack;  // the tree is halved at each step: depth at most 32
  std::size_t size = 0;
  double nearest = squared_distance(p, triangles_[hint]);
  stack[size++] = {0, squared_distance_to_box(p, 0)};
  while (size > 0) {
    auto [node, bound] = stack[--size];
    while (bound < nearest && nodes_[node].count == 0) {
      std::size_t near = node + 1, far = static_cast<std::size_t>(nodes_[node].first);
      double near_bound = squared_distance_to_box(p, near);
      double far_bound = squared_distance_to_box(p, far);
      if (far_bound < near_bound) {
        std::swap(near, far);
        std::swap(near_bound, far_bound);
      }
      if (far_bound < nearest) stack[size++] = {far, far_bound};
      node = near;
      bound = near_bound;
    }
    if (!(bound < nearest)) continue;
    const auto first = static_cast<std::size_t>(nodes_[node].first);
    for (std::size_t i = first; i < first + static_cast<std::size_t>(nodes_[node].count); ++i) {
      const double distance = squared_distance(p, triangles_[i]);
      if (distance < nearest) {
        nearest = distance;
        hint = i;
      }
    }
  }
  return nearest;
}

}  // namespace mesamis::detail::surface
