// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/size_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesamis/base/parallel.h"
#include "mesamis/body/triangle_lattice.h"
#include "mesamis/surface/half_edges.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::body {
namespace {

/// Outside sizes grow this much over a length.
constexpr double kOuterGradation = 1;

double area_of(const TriMesh& surface, const Triangle& t) {
  const auto& p = surface.points;
  return 0.5 * norm(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
}

Vec3 normal_of(const TriMesh& surface, Index triangle) {
  const Triangle& t = surface.triangles[triangle];
  const auto& p = surface.points;
  return cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
}

/// Calls visit(edge, angle) for the edges between two triangles, with the angle by which these
/// turn.
template <class Visit>
void for_each_bend(const TriMesh& surface, Visit&& visit) {
  const auto half_edges = sorted_half_edges(surface.triangles, surface.points.size());
  for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
    if (edge.size() != 2) return;
    const Vec3 m = normal_of(surface, edge[0].triangle), n = normal_of(surface, edge[1].triangle);
    visit(edge[0], std::atan2(norm(cross(m, n)), dot(m, n)));
  });
}

/// The mean of the absolute curvature over the triangles around each point, 1/mm: the angles at
/// their edges times the edges' lengths, over the area.
std::vector<double> curvatures(const TriMesh& surface) {
  std::vector<double> bend(surface.points.size()), area(surface.points.size());
  for (const Triangle& t : surface.triangles) {
    for (const Index p : t) area[p] += area_of(surface, t);
  }
  for_each_bend(surface, [&](const HalfEdge& edge, double angle) {
    const double length = norm(surface.points[edge.hi] - surface.points[edge.lo]);
    bend[edge.lo] += angle * length;
    bend[edge.hi] += angle * length;
  });
  // Each edge is shared by two points and each triangle by three: an edge's bend counts 1/2, an
  // area 1/3, and a cylinder of curvature k has a mean of k / 2 on either side of its edges.
  for (std::size_t i = 0; i < bend.size(); ++i) {
    bend[i] = area[i] > 0 ? 1.5 * bend[i] / area[i] : 0;
  }
  return bend;
}

/// The sizes that edges ask for at their ends. Triangles of size h cut an edge off that turns by an
/// angle a by about h / 2 tan(a / 4).
std::vector<double> crease_sizes(const TriMesh& surface, double tolerance) {
  std::vector<double> sizes(surface.points.size(), std::numeric_limits<double>::infinity());
  for_each_bend(surface, [&](const HalfEdge& edge, double angle) {
    const double size = 2 * tolerance / std::tan(angle / 4);
    for (const Index p : {edge.lo, edge.hi}) sizes[p] = std::min(sizes[p], size);
  });
  return sizes;
}

/// Averages over neighbours: facets of a decimated surface bend at few edges only.
void smooth(const TriMesh& surface, std::vector<double>& values) {
  std::vector<double> sum(values.size()), weight(values.size());
  for (const Triangle& t : surface.triangles) {
    const double area = area_of(surface, t);
    const double mean = (values[t[0]] + values[t[1]] + values[t[2]]) / 3;
    for (const Index p : t) {
      sum[p] += area * mean;
      weight[p] += area;
    }
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (weight[i] > 0) values[i] = sum[i] / weight[i];
  }
}

/// Sizes at the nodes of a regular grid.
class SizeGrid {
 public:
  /// @param detail  mm: nodes need not be closer.
  SizeGrid(const Box& box, const SizeRules& rules, double detail) : box_(box), rules_(rules) {
    constexpr double kMostNodes = 160;
    const Vec3 extent = box.extent();
    const double longest = std::max({extent.x, extent.y, extent.z});
    const double spacing = std::max(detail, longest / kMostNodes);
    for (int axis = 0; axis < 3; ++axis) {
      size_[axis] = std::max(2, static_cast<Index>(std::ceil(extent[axis] / spacing)) + 1);
      step_[axis] = extent[axis] / (size_[axis] - 1);
    }
    sizes_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2],
                  std::numeric_limits<float>::infinity());
    inside_.assign(sizes_.size(), true);
  }

  /// The shortest distance between nodes, mm; nothing smaller is told apart.
  double spacing() const { return std::min({step_.x, step_.y, step_.z}); }

  /// A size wanted at a point, at the nodes of the brick that holds it.
  void want(const Vec3& p, double size) {
    std::array<Index, 3> low;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = (p[axis] - box_.lo[axis]) / step_[axis];
      low[axis] = std::clamp(static_cast<Index>(std::floor(at)), 0, size_[axis] - 2);
    }
    for (int corner = 0; corner < 8; ++corner) {
      const std::size_t n =
          offset(low[0] + (corner & 1), low[1] + (corner >> 1 & 1), low[2] + (corner >> 2 & 1));
      sizes_[n] = std::min(sizes_[n], static_cast<float>(size));
    }
  }

  /// Takes over what another field asks for where that is less.
  void limit(const GridMetricField& field) {
    parallel_for(sizes_.size(), [&](std::size_t n) {
      Index hint = 0;
      sizes_[n] = std::min(sizes_[n], static_cast<float>(size_at(field, position(n), hint)));
    });
  }

  /// Sizes inside grow to the target; outside they grow faster and without end.
  void spread(const BodySurface& shape) {
    parallel_for(sizes_.size(), [&](std::size_t n) {
      inside_[n] = shape.material_at(position(n)) != kOutside;
      if (inside_[n]) sizes_[n] = std::min(sizes_[n], static_cast<float>(rules_.target));
    });
    grow();
  }

  /// Sizes grow from node to node no faster than they may: as inside, unless spread() told.
  void grow() {
    for (int sweep = 0; sweep < 2; ++sweep) {
      sweep_nodes(1);
      sweep_nodes(-1);
    }
  }

  GridMetricField metric() const {
    std::vector<std::array<float, 6>> logs(sizes_.size());
    for (std::size_t n = 0; n < logs.size(); ++n) {
      const float log = -2 * std::log(sizes_[n]);
      logs[n] = {log, 0, 0, log, 0, log};
    }
    return {box_, size_, std::move(logs)};
  }

 private:
  std::size_t offset(Index i, Index j, Index k) const {
    return (static_cast<std::size_t>(k) * size_[1] + j) * size_[0] + i;
  }
  Vec3 position(std::size_t n) const {
    const auto i = n % size_[0], j = n / size_[0] % size_[1], k = n / size_[0] / size_[1];
    return box_.lo + Vec3{static_cast<double>(i) * step_.x, static_cast<double>(j) * step_.y,
                          static_cast<double>(k) * step_.z};
  }

  /// One pass over all nodes, forward or backward, from each to the 13 neighbours behind it.
  void sweep_nodes(int direction) {
    const auto count = static_cast<std::ptrdiff_t>(sizes_.size());
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      relax(static_cast<std::size_t>(direction > 0 ? i : count - 1 - i), direction);
    }
  }

  void relax(std::size_t n, int direction) {
    const std::array<Index, 3> at{static_cast<Index>(n % size_[0]),
                                  static_cast<Index>(n / size_[0] % size_[1]),
                                  static_cast<Index>(n / size_[0] / size_[1])};
    const double growth = inside_[n] ? rules_.gradation : kOuterGradation;
    for (int near = 0; near < 13; ++near) {  // the first half of the 27 in a brick of neighbours
      const std::array<Index, 3> step{near % 3 - 1, near / 3 % 3 - 1, near / 9 - 1};
      std::array<Index, 3> from;
      bool there = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        from[axis] = at[axis] + direction * step[axis];
        there = there && from[axis] >= 0 && from[axis] < size_[axis];
      }
      if (!there) continue;
      const Vec3 way{step[0] * step_.x, step[1] * step_.y, step[2] * step_.z};
      const double grown = sizes_[offset(from[0], from[1], from[2])] + growth * norm(way);
      sizes_[n] = std::min(sizes_[n], static_cast<float>(grown));
    }
  }

  Box box_;
  SizeRules rules_;
  std::array<Index, 3> size_;
  Vec3 step_;
  std::vector<float> sizes_;
  std::vector<char> inside_;
};

/// Sizes at the corners and, so that large triangles leave no gap, at points within a spacing.
void want_on_triangles(const TriMesh& surface, const std::vector<double>& sizes, SizeGrid& grid) {
  for (const Triangle& t : surface.triangles) {
    const double smallest =
        std::max(grid.spacing(), std::min({sizes[t[0]], sizes[t[1]], sizes[t[2]]}));
    visit_lattice(surface::corners_of(surface, t), smallest,
                  [&](const Vec3& p, const auto& weights) {
                    const auto [w, u, v] = weights;
                    grid.want(p, w * sizes[t[0]] + u * sizes[t[1]] + v * sizes[t[2]]);
                  });
  }
}

}  // namespace

std::vector<double> surface_sizes(const TriMesh& surface, std::span<const double> thickness,
                                  const SizeRules& rules) {
  std::vector<double> bend = curvatures(surface);
  for (int pass = 0; pass < 2; ++pass) smooth(surface, bend);
  std::vector<double> sizes = crease_sizes(surface, rules.tolerance);
  parallel_for(sizes.size(), [&](std::size_t i) {
    double size = std::min(sizes[i], rules.target);
    if (bend[i] > 0) size = std::min(size, std::sqrt(6 * rules.tolerance / bend[i]));
    if (rules.through_wall > 0) size = std::min(size, thickness[i] / rules.through_wall);
    sizes[i] = std::max(size, rules.least);
  });
  return sizes;
}

GridMetricField size_field(std::span<const TriMesh> surfaces, const BodySurface& shape,
                           const Box& box, const SizeRules& rules) {
  SizeGrid grid(box, rules, std::max(rules.least, 0.5 * rules.target));
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const auto& thickness = shape.thickness(static_cast<Material>(k + 1));
    want_on_triangles(surfaces[k], surface_sizes(surfaces[k], thickness, rules), grid);
  }
  grid.spread(shape);
  return grid.metric();
}

double size_at(const GridMetricField& sizes, const Vec3& p, Index& hint) {
  return 1 / std::sqrt(sizes.at(p, hint).xx);
}

GridMetricField refined(const GridMetricField& sizes, const Box& box,
                        std::span<const WantedSize> wanted, const SizeRules& rules) {
  double smallest = rules.target;
  for (const WantedSize& place : wanted) smallest = std::min(smallest, place.size);
  SizeGrid grid(box, rules, smallest);
  for (const WantedSize& place : wanted) grid.want(place.point, place.size);
  grid.grow();
  grid.limit(sizes);
  return grid.metric();
}

}  // namespace mesamis::detail::body
