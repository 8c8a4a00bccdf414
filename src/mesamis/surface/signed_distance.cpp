// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/signed_distance.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/farthest.h"
#include "mesamis/surface/half_edges.h"

namespace mesamis::detail::surface {
namespace {

/// Where on a triangle the nearest point is: 0 to 2 its corners, 3 to 5 its edges from corner i to
/// i + 1, 6 its side.
constexpr int kEdge = 3, kSide = 6;

struct OnTriangle {
  Vec3 point;
  int feature = kSide;
};

double share_along(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double square = dot(ab, ab);
  return square > 0 ? dot(p - a, ab) / square : 0;
}

/// The nearest point on the triangle's edges.
OnTriangle nearest_on_edges(const Vec3& p, const Corners& t) {
  OnTriangle nearest;
  double least = INFINITY;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec3 &a = t[static_cast<std::size_t>(i)], &b = t[static_cast<std::size_t>(j)];
    const double share = share_along(p, a, b);
    OnTriangle here{a + std::clamp(share, 0.0, 1.0) * (b - a), kEdge + i};
    if (share <= 0) here = {a, i};
    if (share >= 1) here = {b, j};
    const Vec3 way = here.point - p;
    if (dot(way, way) >= least) continue;
    least = dot(way, way);
    nearest = here;
  }
  return nearest;
}

OnTriangle nearest_on(const Vec3& p, const Corners& t) {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double square = dot(normal, normal);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 inward = cross(normal, t[(i + 1) % 3] - t[i]);
    if (!(dot(inward, p - t[i]) > 0)) return nearest_on_edges(p, t);
  }
  return {p - dot(normal, p - t[0]) / square * normal, kSide};
}

/// The angle at corner i of a triangle.
double angle_at(const Corners& t, std::size_t i) {
  const Vec3 a = t[(i + 1) % 3] - t[i], b = t[(i + 2) % 3] - t[i];
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

const TriMesh& checked(const TriMesh& surface) {
  require_sound(surface);
  if (surface.triangles.empty()) throw InputError("surface: expected triangles, found none");
  return surface;
}

}  // namespace

SignedDistance::SignedDistance(const TriMesh& surface)
    : surface_(checked(surface)), tree_(surface_) {
  compute_normals();
  fill_hints();
}

void SignedDistance::compute_normals() {
  const std::size_t m = surface_.triangles.size();
  face_normals_.resize(m);
  edge_normals_.resize(m);
  point_normals_.resize(surface_.points.size());
  for (std::size_t t = 0; t < m; ++t) {
    const Corners k = corners_of(surface_, surface_.triangles[t]);
    face_normals_[t] = unit_normal(k);
    for (std::size_t i = 0; i < 3; ++i) {
      point_normals_[surface_.triangles[t][i]] += angle_at(k, i) * face_normals_[t];
    }
  }
  const auto half_edges = sorted_half_edges(surface_.triangles, surface_.points.size());
  for_each_edge(half_edges, [this](std::span<const HalfEdge> edge) {
    Vec3 sum;
    for (const HalfEdge& half : edge) sum += face_normals_[half.triangle];
    for (const HalfEdge& half : edge) edge_normals_[half.triangle][half.corner] = sum;
  });
}

void SignedDistance::fill_hints() {
  constexpr double kTrianglesPerBrick = 2;  // far from the surface a brick costs more
  constexpr Index kMostBricks = 128;
  box_ = bounding_box(surface_.points);
  const Vec3 extent = box_.extent();
  const double longest = std::max({extent.x, extent.y, extent.z});
  const double side =
      longest / std::cbrt(static_cast<double>(surface_.triangles.size()) / kTrianglesPerBrick);
  for (int axis = 0; axis < 3; ++axis) {
    const double wanted = std::ceil(extent[axis] / side);
    bricks_[axis] = static_cast<Index>(std::clamp(wanted, 1.0, double{kMostBricks}));
  }
  hints_.resize(static_cast<std::size_t>(bricks_[0]) * bricks_[1] * bricks_[2]);
  const auto columns = static_cast<std::size_t>(bricks_[1]) * bricks_[2];
  parallel_for(columns, [&](std::size_t column) {
    const std::size_t row = column % bricks_[1], layer = column / bricks_[1];
    const auto j = static_cast<double>(row), k = static_cast<double>(layer);
    std::size_t hint = 0;
    for (Index i = 0; i < bricks_[0]; ++i) {
      const Vec3 middle{box_.lo.x + (i + 0.5) * extent.x / bricks_[0],
                        box_.lo.y + (j + 0.5) * extent.y / bricks_[1],
                        box_.lo.z + (k + 0.5) * extent.z / bricks_[2]};
      tree_.squared_distance_to(middle, hint);
      hints_[column * bricks_[0] + i] = hint;
    }
  });
}

std::size_t SignedDistance::hint_at(const Vec3& p) const {
  std::array<std::size_t, 3> brick;
  const Vec3 extent = box_.extent();
  for (int axis = 0; axis < 3; ++axis) {
    const double t = extent[axis] > 0 ? (p[axis] - box_.lo[axis]) / extent[axis] : 0;
    brick[axis] = static_cast<std::size_t>(
        std::clamp(t * bricks_[axis], 0.0, static_cast<double>(bricks_[axis] - 1)));
  }
  return hints_[(brick[2] * bricks_[1] + brick[1]) * bricks_[0] + brick[0]];
}

Vec3 SignedDistance::pseudonormal(Index triangle, int feature) const {
  if (feature == kSide) return face_normals_[triangle];
  if (feature >= kEdge) return edge_normals_[triangle][feature - kEdge];
  return point_normals_[surface_.triangles[triangle][feature]];
}

NearestPoint SignedDistance::at(const Vec3& p) const {
  std::size_t hint = hint_at(p);
  tree_.squared_distance_to(p, hint);
  const Index triangle = tree_.index_of(hint);
  const OnTriangle on = nearest_on(p, tree_.triangle(hint));
  const Vec3 normal = pseudonormal(triangle, on.feature), way = p - on.point;
  const double distance = norm(way);
  return {on.point, distance, dot(way, normal) < 0 ? -distance : distance, triangle,
          unit_or_zero(normal)};
}

}  // namespace mesamis::detail::surface
