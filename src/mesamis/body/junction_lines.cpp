// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/junction_lines.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <utility>

#include "mesamis/base/each_once.h"
#include "mesamis/mesh/edges.h"

namespace mesamis::detail::body {
namespace {

/// A corner of a surface, by its place.
struct Corner {
  std::array<double, 3> place;
  std::size_t surface;
  Index point;
  bool operator<(const Corner& o) const {
    return std::tie(place, surface, point) < std::tie(o.place, o.surface, o.point);
  }
};

/// Points of more than one surface: their common numbers, by surface and point.
struct SharedPoints {
  std::vector<Vec3> points;
  std::vector<std::vector<Index>> number;  ///< kNoIndex: of one surface alone
};

SharedPoints find_shared(std::span<const TriMesh> surfaces) {
  SharedPoints shared;
  std::vector<Corner> corners;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    shared.number.emplace_back(surfaces[s].points.size(), kNoIndex);
    for (std::size_t p = 0; p < surfaces[s].points.size(); ++p) {
      const Vec3& place = surfaces[s].points[p];
      corners.push_back({{place.x, place.y, place.z}, s, static_cast<Index>(p)});
    }
  }
  std::sort(corners.begin(), corners.end());
  for (auto first = corners.begin(); first != corners.end();) {
    const auto last = std::find_if(first, corners.end(),
                                   [&](const Corner& c) { return c.place != first->place; });
    if (first->surface != (last - 1)->surface) {
      for (auto c = first; c != last; ++c) {
        shared.number[c->surface][c->point] = static_cast<Index>(shared.points.size());
      }
      shared.points.push_back({first->place[0], first->place[1], first->place[2]});
    }
    first = last;
  }
  return shared;
}

/// A triangle whose corners are shared points, and what it bounds.
struct SharedTriangle {
  Triangle sorted;
  Material material;
  bool operator<(const SharedTriangle& o) const {
    return std::tie(sorted, material) < std::tie(o.sorted, o.material);
  }
};

/// An edge between shared points, and a material at it.
struct EdgeMaterial {
  Edge edge;
  Material material;
  bool operator==(const EdgeMaterial&) const = default;
  bool operator<(const EdgeMaterial& o) const {
    return std::tie(edge, material) < std::tie(o.edge, o.material);
  }
};

/// The materials at edges between shared points.
class EdgeMaterials {
 public:
  void add(const Edge& edge, Material material) {
    if (edge[0] != edge[1]) found_.push_back({edge, material});
  }

  /// Of triangles with three shared points: beyond those of one surface alone there is the outside.
  void add(std::vector<SharedTriangle>& triangles) {
    std::sort(triangles.begin(), triangles.end());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const auto& [t, material] = triangles[i];
      const bool is_shared = (i > 0 && triangles[i - 1].sorted == t) ||
                             (i + 1 < triangles.size() && triangles[i + 1].sorted == t);
      for (const Edge& edge : {Edge{t[0], t[1]}, Edge{t[1], t[2]}, Edge{t[0], t[2]}}) {
        add(edge, material);
        if (!is_shared) add(edge, kOutside);
      }
    }
  }

  /// By edge, each pair once.
  std::vector<EdgeMaterial> sorted() && {
    sort_once(found_);
    return std::move(found_);
  }

 private:
  std::vector<EdgeMaterial> found_;
};

std::vector<EdgeMaterial> materials_at_edges(std::span<const TriMesh> surfaces,
                                             const SharedPoints& shared) {
  std::vector<SharedTriangle> triangles;
  EdgeMaterials materials;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const auto material = static_cast<Material>(s + 1);
    const auto& number = shared.number[s];
    for (const Triangle& t : surfaces[s].triangles) {
      Triangle numbers{number[t[0]], number[t[1]], number[t[2]]};
      std::sort(numbers.begin(), numbers.end());
      if (numbers[0] != kNoIndex) {
        triangles.push_back({numbers, material});
      } else if (numbers[1] != kNoIndex) {  // beyond it there is the outside
        materials.add({numbers[1], numbers[2]}, material);
        materials.add({numbers[1], numbers[2]}, kOutside);
      }
    }
  }
  materials.add(triangles);
  return std::move(materials).sorted();
}

}  // namespace

JunctionLines::JunctionLines(std::span<const TriMesh> surfaces) {
  if (surfaces.size() < 2) return;
  const SharedPoints shared = find_shared(surfaces);
  const auto at_edges = materials_at_edges(surfaces, shared);
  std::map<MaterialTriple, TriMesh> lines;
  for (auto first = at_edges.begin(); first != at_edges.end();) {
    const auto last = std::find_if(first, at_edges.end(),
                                   [&](const EdgeMaterial& e) { return e.edge != first->edge; });
    if (last - first == 3) {
      const auto [a, b] = first->edge;
      TriMesh& line = lines[{first->material, (first + 1)->material, (first + 2)->material}];
      const auto at = static_cast<Index>(line.points.size());
      line.points.insert(line.points.end(), {shared.points[a], shared.points[b]});
      line.triangles.push_back({at, at + 1, at + 1});  // an edge, as the tree takes it
      ++edges_;
    }
    first = last;
  }
  for (const auto& [materials, line] : lines) lines_.emplace(materials, line);
}

std::optional<JunctionPoint> JunctionLines::nearest(const Vec3& p,
                                                    const MaterialTriple& materials) const {
  const auto line = lines_.find(materials);
  if (line == lines_.end()) return std::nullopt;
  std::size_t hint = 0;
  line->second.squared_distance_to(p, hint);
  const Corners& edge = line->second.triangle(hint);
  const Vec3 along = edge[1] - edge[0];
  const double share = std::clamp(dot(p - edge[0], along) / dot(along, along), 0.0, 1.0);
  return JunctionPoint{edge[0] + share * along, unit_or_zero(along)};
}

}  // namespace mesamis::detail::body
