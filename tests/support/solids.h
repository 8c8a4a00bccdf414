// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "mesamis/surface/tri_mesh.h"

/// Closed surfaces with as many triangles as wanted, outward.
namespace mesamis {

/// A point of a profile: its distance from the z axis, and z.
struct ProfilePoint {
  double radius = 0, z = 0;
};

/// The surface that a profile sweeps around the z axis, in `turns` steps.
/// @param profile  from a point on the axis to one above or on it, the inside to its left.
inline TriMesh revolved(const std::vector<ProfilePoint>& profile, Index turns) {
  TriMesh mesh;
  std::vector<std::vector<Index>> rings;
  for (const auto& [radius, z] : profile) {
    std::vector<Index> ring;
    for (Index k = 0; k < turns; ++k) {
      if (k == 0 || radius > 0) {
        const double angle = 2 * std::numbers::pi * k / turns;
        mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
      }
      ring.push_back(static_cast<Index>(mesh.points.size()) - 1);
    }
    rings.push_back(ring);
  }
  for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
    for (std::size_t k = 0; k < rings[r].size(); ++k) {
      const std::size_t next = (k + 1) % rings[r].size();
      const Index a = rings[r][k], b = rings[r][next], c = rings[r + 1][next], d = rings[r + 1][k];
      if (a != b) mesh.triangles.push_back({a, b, c});
      if (c != d) mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

/// The part of a ball around the origin above the height z, closed by a flat disc; all of it for
/// z = -radius.
inline TriMesh ball_above(double z, double radius, Index turns) {
  std::vector<ProfilePoint> profile{{0, z}};
  const double lowest = std::asin(std::max(z / radius, -1.0)), highest = std::numbers::pi / 2;
  const auto steps =
      static_cast<int>(std::ceil((highest - lowest) * turns / (2 * std::numbers::pi)));
  for (int i = z > -radius ? 0 : 1; i < steps; ++i) {
    const double angle = lowest + (highest - lowest) * i / steps;
    profile.push_back({radius * std::cos(angle), i == 0 ? z : radius * std::sin(angle)});
  }
  profile.push_back({0, radius});
  return revolved(profile, turns);
}

inline TriMesh ball_surface(double radius, Index turns) {
  return ball_above(-radius, radius, turns);
}

/// Mirrored at the plane z = 0.
inline TriMesh mirrored(TriMesh mesh) {
  for (Vec3& p : mesh.points) p.z = -p.z;
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline TriMesh moved(TriMesh mesh, const Vec3& way) {
  for (Vec3& p : mesh.points) p += way;
  return mesh;
}

/// A brick whose sides are cut into n[axis] steps.
inline TriMesh brick(const Box& box, const std::array<Index, 3>& n) {
  TriMesh mesh;
  std::map<std::array<Index, 3>, Index> numbers;
  auto number = [&](const std::array<Index, 3>& at) {
    const auto [found, is_new] = numbers.try_emplace(at, static_cast<Index>(mesh.points.size()));
    if (is_new) {
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        p[axis] = at[a] == n[a] ? box.hi[axis]
                                : box.lo[axis] + (box.hi[axis] - box.lo[axis]) * at[a] / n[a];
      }
      mesh.points.push_back(p);
    }
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool high : {false, true}) {
      for (Index i = 0; i < n[u]; ++i) {
        for (Index j = 0; j < n[v]; ++j) {
          auto corner = [&](Index du, Index dv) {
            std::array<Index, 3> at;
            at[axis] = high ? n[axis] : 0;
            at[u] = i + du;
            at[v] = j + dv;
            return number(at);
          };
          const Index a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          mesh.triangles.push_back(high ? Triangle{a, b, c} : Triangle{a, c, b});
          mesh.triangles.push_back(high ? Triangle{a, c, d} : Triangle{a, d, c});
        }
      }
    }
  }
  return mesh;
}

}  // namespace mesamis
