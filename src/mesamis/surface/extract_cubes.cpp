// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/extract_cubes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/extract.h"

namespace mesamis::detail::surface {
namespace {

/// An edge of a cube by the corner it begins at and its axis. Bit a of a corner's number is its
/// step along axis a.
struct CubeEdge {
  int corner, axis;
};
constexpr int edge_number(CubeEdge e) { return 3 * e.corner + e.axis; }

/// The corners of the six faces, counter-clockwise seen from outside.
constexpr std::array<std::array<int, 4>, 6> kFaces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

CubeEdge edge_between(int a, int b) {
  const int both = a ^ b;
  return {a & b, both == 1 ? 0 : both == 2 ? 1 : 2};
}

/// The loops of crossed edges of a cube, outward when seen counter-clockwise.
using Loops = std::vector<std::vector<CubeEdge>>;

/// @param inside  bit c is 1 if corner c is above the level.
Loops loops_of(unsigned inside) {
  const auto is_in = [inside](int corner) { return ((inside >> corner) & 1U) != 0; };
  std::array<int, 24> next;  // of each crossed edge, the one after it in its loop
  next.fill(-1);
  for (const auto& face : kFaces) {
    for (int i = 0; i < 4; ++i) {
      const auto at = [&face](int n) { return face[static_cast<std::size_t>(n % 4)]; };
      if (is_in(at(i)) || !is_in(at(i + 1))) continue;
      int last = i + 1;  // of the corners inside that follow each other
      while (is_in(at(last + 1))) ++last;
      const int entered = edge_number(edge_between(at(i), at(i + 1)));
      const int left = edge_number(edge_between(at(last), at(last + 1)));
      next[static_cast<std::size_t>(entered)] = left;
    }
  }
  Loops loops;
  for (int begin = 0; begin < 24; ++begin) {
    std::vector<CubeEdge> loop;
    for (int e = begin; next[static_cast<std::size_t>(e)] >= 0;) {
      loop.push_back({e / 3, e % 3});
      e = std::exchange(next[static_cast<std::size_t>(e)], -1);
    }
    if (!loop.empty()) loops.push_back(std::move(loop));
  }
  return loops;
}

const std::array<Loops, 256>& loop_table() {
  static const std::array<Loops, 256> table = [] {
    std::array<Loops, 256> loops;
    for (unsigned inside = 0; inside < 256; ++inside) loops[inside] = loops_of(inside);
    return loops;
  }();
  return table;
}

class Extraction {
 public:
  Extraction(const GridValues& grid, double level)
      : grid_(grid),
        level_(level),
        step_{1, grid.size[0], grid.size[0] * grid.size[1]},
        layers_(static_cast<std::size_t>(grid.size[2])) {}

  TriMesh run() {
    place_points();
    find_triangles();
    TriMesh surface;
    surface.points = std::move(points_);
    for (Layer& layer : layers_) {
      const auto first = static_cast<Index>(surface.points.size());
      surface.points.insert(surface.points.end(), layer.middles.begin(), layer.middles.end());
      for (Triangle t : layer.triangles) {
        for (Index& p : t) p = p < 0 ? first - 1 - p : p;
        surface.triangles.push_back(t);
      }
    }
    return surface;
  }

 private:
  /// Of the cubes between two layers of nodes. The n-th middle has the number -1 - n until all
  /// layers are joined.
  struct Layer {
    std::vector<Vec3> points;     // on the edges that begin in the layer
    std::vector<Index> of_point;  // these edges: 3 node + axis
    std::vector<Vec3> middles;
    std::vector<Triangle> triangles;
  };
  struct Node {
    Index number;
    std::array<Index, 3> place;
  };

  double value(Index node) const { return grid_.values[static_cast<std::size_t>(node)]; }
  bool at_box(const std::array<Index, 3>& place) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (place[a] == 0 || place[a] + 1 == grid_.size[a]) return true;
    }
    return false;
  }
  bool is_inside(const Node& n) const { return value(n.number) > level_ && !at_box(n.place); }
  Vec3 position(const std::array<Index, 3>& place) const {
    return {place[0] * grid_.spacing.x, place[1] * grid_.spacing.y, place[2] * grid_.spacing.z};
  }
  Node neighbour(Node n, std::size_t axis) const {
    n.number += step_[axis];
    ++n.place[axis];
    return n;
  }

  /// Calls visit(node) for the nodes of a layer.
  template <class Visit>
  void for_nodes_of(std::size_t k, Visit visit) const {
    Node n{static_cast<Index>(k) * step_[2], {0, 0, static_cast<Index>(k)}};
    for (n.place[1] = 0; n.place[1] < grid_.size[1]; ++n.place[1]) {
      for (n.place[0] = 0; n.place[0] < grid_.size[0]; ++n.place[0], ++n.number) visit(n);
    }
  }

  /// Where the surface crosses an edge: at its end, if that is a node of the box above the level.
  Vec3 crossing(const Node& a, const Node& b) const {
    const Vec3 p = position(a.place), q = position(b.place);
    const double at_a = value(a.number), at_b = value(b.number);
    if (at_a > level_ && at_b > level_) return at_box(a.place) ? p : q;
    const double t = (level_ - at_a) / (at_b - at_a);
    return p + std::clamp(t, kCrossingMargin, 1 - kCrossingMargin) * (q - p);
  }

  void place_points() {
    parallel_for_each(layers_.size(), [this](std::size_t k) {
      for_nodes_of(k, [&](const Node& a) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (a.place[axis] + 1 == grid_.size[axis]) continue;
          const Node b = neighbour(a, axis);
          if (is_inside(a) == is_inside(b)) continue;
          layers_[k].points.push_back(crossing(a, b));
          layers_[k].of_point.push_back(3 * a.number + static_cast<Index>(axis));
        }
      });
    });
    point_of_edge_.assign(3 * grid_.values.size(), kNoIndex);
    for (const Layer& layer : layers_) {
      for (std::size_t i = 0; i < layer.points.size(); ++i) {
        point_of_edge_[static_cast<std::size_t>(layer.of_point[i])] =
            static_cast<Index>(points_.size());
        points_.push_back(layer.points[i]);
      }
    }
  }

  void find_triangles() {
    parallel_for_each(layers_.size() - 1, [this](std::size_t k) {
      for_nodes_of(k, [&](const Node& n) {
        if (n.place[0] + 1 == grid_.size[0] || n.place[1] + 1 == grid_.size[1]) return;
        for (const auto& loop : loop_table()[corners_inside(n)]) span(loop, n, layers_[k]);
      });
    });
  }

  /// Bit c is 1 if corner c of the cube is inside.
  unsigned corners_inside(const Node& lowest) const {
    unsigned inside = 0;
    for (unsigned c = 0; c < 8; ++c) {
      Node n = lowest;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (((c >> axis) & 1U) != 0) n = neighbour(n, axis);
      }
      if (is_inside(n)) inside |= 1U << c;
    }
    return inside;
  }

  /// Fills a loop with triangles.
  void span(const std::vector<CubeEdge>& loop, const Node& lowest, Layer& layer) const {
    std::vector<Index> p;
    for (const CubeEdge& e : loop) {
      auto node = static_cast<std::size_t>(lowest.number);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (((e.corner >> axis) & 1) != 0) node += static_cast<std::size_t>(step_[axis]);
      }
      p.push_back(point_of_edge_[3 * node + static_cast<std::size_t>(e.axis)]);
    }
    if (p.size() == 3) {
      layer.triangles.push_back({p[0], p[1], p[2]});
    } else if (p.size() == 4) {
      const Vec3 d02 = points_[p[2]] - points_[p[0]], d13 = points_[p[3]] - points_[p[1]];
      if (dot(d13, d13) < dot(d02, d02)) std::rotate(p.begin(), p.begin() + 1, p.end());
      layer.triangles.insert(layer.triangles.end(), {{p[0], p[1], p[2]}, {p[0], p[2], p[3]}});
    } else {
      Vec3 sum{0, 0, 0};
      for (const Index i : p) sum += points_[i];
      layer.middles.push_back((1 / static_cast<double>(p.size())) * sum);
      const auto middle = -static_cast<Index>(layer.middles.size());
      for (std::size_t i = 0; i < p.size(); ++i) {
        layer.triangles.push_back({p[i], p[(i + 1) % p.size()], middle});
      }
    }
  }

  const GridValues& grid_;
  double level_;
  std::array<Index, 3> step_;
  std::vector<Layer> layers_;
  std::vector<Vec3> points_;
  std::vector<Index> point_of_edge_;
};

void require_values(const GridValues& grid, double level) {
  const auto [x, y, z] = grid.size;
  const bool fits = std::min({x, y, z}) >= 2 &&
                    std::size_t(x) * std::size_t(y) * std::size_t(z) == grid.values.size();
  if (!fits) throw InputError("cubes: expected one value per node of a grid of 2 or more a side");
  const auto is_finite = [](double v) { return std::isfinite(v); };
  if (!is_finite(level) || !std::all_of(grid.values.begin(), grid.values.end(), is_finite)) {
    throw InputError("cubes: a value or the level is not finite");
  }
}

}  // namespace

TriMesh extract_cubes(const GridValues& grid, double level) {
  require_values(grid, level);
  return Extraction(grid, level).run();
}

}  // namespace mesamis::detail::surface
