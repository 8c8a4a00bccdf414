// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "mesamis/decimate/collapse.h"
#include "support/level_set.h"

/// The collapses of a surface, for tests.
namespace mesamis {

inline TriMesh small_sphere() {
  return level_set({{-1, -1, -1}, {1, 1, 1}}, {5, 5, 5}, [](const Vec3& p) {
    return 0.8 - norm(p + Vec3{0.03, 0.02, 0.01});
  });
}

/// A sphere without its top.
inline TriMesh small_bowl() {
  TriMesh bowl = small_sphere();
  std::erase_if(bowl.triangles, [&](const Triangle& t) {
    return std::max({bowl.points[t[0]].z, bowl.points[t[1]].z, bowl.points[t[2]].z}) > 0.3;
  });
  return bowl;
}

/// Of each triangle, unit length or 0; none may be removed.
inline std::vector<Vec3> normals_of(const EditableSurface& surface,
                                    const std::vector<Vec3>& points) {
  std::vector<Vec3> normals;
  for (Index t = 0; t < surface.count(); ++t) {
    const Triangle k = surface.triangle(t);
    normals.push_back(unit_normal({points[k[0]], points[k[1]], points[k[2]]}));
  }
  return normals;
}

/// A surface, its half-edges, and each collapse that keeps it a closed 2-manifold.
class Collapses {
 public:
  explicit Collapses(const TriMesh& mesh)
      : points(mesh.points), surface(mesh.points.size(), mesh.triangles) {}

  /// Calls visit(collapse, surface after it) for every step-th half-edge; the kept point stays, or
  /// goes part of the way to the one removed.
  template <class Visit>
  void for_each(int step, Visit visit) {
    for (Index h = 0; h < 3 * surface.count(); h += step) {
      if (surface.is_removed(h / 3) || !surface.may_collapse(h)) continue;
      for (const double share : {0.0, 0.4}) {
        const Vec3 &from = points[surface.from(h)], &to = points[surface.to(h)];
        Collapse collapse;
        describe(surface, points, h, to + share * (from - to), collapse);
        visit(collapse, after(collapse));
      }
    }
  }

  /// The same for collapses along rims.
  template <class Visit>
  void for_each_at_rim(Visit visit) {
    for (Index h = 0; h < 3 * surface.count(); ++h) {
      if (surface.is_removed(h / 3) || surface.opposite(h) != kNoIndex) continue;
      for (const auto& [removed, kept] :
           {std::pair{surface.from(h), surface.to(h)}, std::pair{surface.to(h), surface.from(h)}}) {
        if (!surface.may_collapse_at_rim(h, removed)) continue;
        for (const double share : {0.0, 0.4}) {
          const Vec3 &from = points[removed], &to = points[kept];
          Collapse collapse;
          describe_at_rim(surface, points, h, removed, to + share * (from - to), collapse);
          visit(collapse, after(collapse));
        }
      }
    }
  }

  TriMesh now() const {
    TriMesh mesh{points, {}};
    for (Index t = 0; t < surface.count(); ++t) {
      if (!surface.is_removed(t)) mesh.triangles.push_back(surface.triangle(t));
    }
    return mesh;
  }

  std::vector<Vec3> points;
  EditableSurface surface;

 private:
  TriMesh after(const Collapse& collapse) const {
    TriMesh result{points, {}};
    result.points[collapse.kept] = collapse.place;
    for (Triangle t : now().triangles) {
      std::replace(t.begin(), t.end(), collapse.removed, collapse.kept);
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) result.triangles.push_back(t);
    }
    return result;
  }
};

}  // namespace mesamis
