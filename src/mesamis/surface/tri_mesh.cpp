// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/tri_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/disjoint_sets.h"
#include "mesamis/surface/half_edges.h"
#include "mesamis/surface/measure.h"

namespace mesamis {
namespace {

void count_edges(std::span<const HalfEdge> half_edges, SurfaceCheck& check) {
  for_each_edge(half_edges, [&check](std::span<const HalfEdge> edge) {
    if (edge.size() == 1) ++check.open_edges;
    if (edge.size() == 2 && edge[0].forward == edge[1].forward) ++check.misoriented_edges;
    if (edge.size() > 2) ++check.nonmanifold_edges;
  });
}

/// Counts the components and, of a closed surface, which of them are islands.
void count_components(const TriMesh& surface, std::span<const HalfEdge> half_edges,
                      SurfaceCheck& check) {
  DisjointSets parts = connected_triangles(half_edges, surface.triangles.size());
  std::vector<double> volume(surface.triangles.size(), 0);  // of a part, at its first triangle
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!is_degenerate(surface.triangles[t])) volume[parts.find(t)] += cone_volume(surface, t);
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (parts.find(t) != t || is_degenerate(surface.triangles[t])) continue;
    ++check.components;
    check.cavities += volume[t] < 0;
  }
  if (!check.closed()) check.cavities = 0;
  if (check.closed()) check.islands = check.components - check.cavities;
}

std::string counted(std::int64_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

double sum_over_triangles(const TriMesh& surface, double (*measure)(const TriMesh&, std::size_t)) {
  return parallel_sum(surface.triangles.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t t = begin; t < end; ++t) sum += measure(surface, t);
    return sum;
  });
}

}  // namespace

void require_sound(const TriMesh& surface) {
  const auto points = static_cast<std::int64_t>(surface.points.size());
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const Vec3& p = surface.points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw InputError("surface: point " + std::to_string(i) + " is not finite");
    }
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (const Index i : surface.triangles[t]) {
      if (i >= 0 && i < points) continue;
      throw InputError("surface: triangle " + std::to_string(t) + " names point " +
                       std::to_string(i) + ", expected 0 to " + std::to_string(points - 1));
    }
  }
}

SurfaceCheck check_surface(const TriMesh& surface) {
  require_sound(surface);
  SurfaceCheck check;
  check.degenerate_triangles =
      std::count_if(surface.triangles.begin(), surface.triangles.end(), is_degenerate);
  const auto half_edges = sorted_half_edges(surface.triangles, surface.points.size());
  count_edges(half_edges, check);
  check.nonmanifold_points = std::ranges::count(
      points_of_several_fans(surface.triangles, half_edges, surface.points.size()), 1);
  count_components(surface, half_edges, check);
  check.volume = surface_volume(surface);
  check.area = surface_area(surface);
  return check;
}

double surface_area(const TriMesh& surface) { return sum_over_triangles(surface, triangle_area); }

double surface_volume(const TriMesh& surface) { return sum_over_triangles(surface, cone_volume); }

std::string flaws_of(const SurfaceCheck& check) {
  const std::array<std::pair<std::int64_t, const char*>, 5> counts{
      {{check.open_edges, "open edges"},
       {check.nonmanifold_edges, "edges with more than two triangles (non-manifold)"},
       {check.misoriented_edges, "edges between triangles that turn opposite ways"},
       {check.nonmanifold_points, "points where the surface touches itself"},
       {check.degenerate_triangles, "triangles with a repeated corner (degenerate)"}}};
  std::string flaws;
  for (const auto& [count, what] : counts) {
    if (count > 0) flaws += (flaws.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  }
  return flaws;
}

std::string components_text(const SurfaceCheck& check) {
  const std::string all = counted(check.components, "component", "components");
  if (!check.closed()) return all;
  return all + " (" + counted(check.islands, "island", "islands") + ", " +
         counted(check.cavities, "cavity", "cavities") + ")";
}

std::string solid_flaws_of(const SurfaceCheck& check) {
  const std::string flaws = flaws_of(check);
  if (!flaws.empty() || check.volume > 0) return flaws;
  return check.volume < 0 ? "triangles that face inward (negative volume)" : "no volume";
}

}  // namespace mesamis
