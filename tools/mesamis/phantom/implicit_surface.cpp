// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/implicit_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/kuhn.h"
#include "mesamis/surface/extract.h"
#include "mesamis/surface/half_edges.h"
#include "mesamis/surface/measure.h"

namespace mesamis::detail::phantom {
namespace {

constexpr std::size_t kBlockBricks = 8;  // bricks per direction that are decided at once
constexpr int kPasses = 16;
constexpr int kSparingPasses = 8;     // that cut no more than they must
constexpr double kGradientMin = 0.2;  // a promise of the field

/// A parameter and the function's value there.
struct Sample {
  double t, f;
};

/// Zero of a function between two samples of different sign. Regula falsi with halving (Illinois):
/// superlinear, and never leaves the bracket.
template <class Function>
double find_zero(const Function& f, const Sample& from, const Sample& to) {
  double a = from.t, fa = from.f, b = to.t, fb = to.f;
  const double enough = 1e-8 * std::max(std::abs(fa), std::abs(fb));
  int side = 0;
  for (int i = 0; i < 60 && std::abs(b - a) > 1e-12 * (std::abs(a) + std::abs(b)); ++i) {
    const double t = (fa * b - fb * a) / (fa - fb), ft = f(t);
    if (std::abs(ft) <= enough) return t;
    const bool replaces_b = (ft > 0) == (fb > 0);
    if (replaces_b) b = t, fb = ft;
    if (!replaces_b) a = t, fa = ft;
    if (replaces_b && side == 1) fa /= 2;
    if (!replaces_b && side == -1) fb /= 2;
    side = replaces_b ? 1 : -1;
  }
  return (fa * b - fb * a) / (fa - fb);
}

/// @param value  f at p.
Vec3 gradient(const ImplicitField& f, const Vec3& p, double value, double h) {
  Vec3 g;
  for (int a = 0; a < 3; ++a) {
    Vec3 step;
    step[a] = h;
    g[a] = (f(p + step) - value) / h;
  }
  return g;
}

/// The nearest zero along the gradient.
struct Foot {
  Vec3 point;
  double distance;       ///< mm
  bool is_found = true;  ///< false: the field breaks its promise here
};

Foot foot_of(const ImplicitField& f, const Vec3& p) {
  const double value = f(p);
  if (value == 0) return {p, 0};
  const Vec3 g = gradient(f, p, value, std::max(0.1 * std::abs(value), 1e-6));
  const double slope = norm(g);
  if (!(slope > 0)) return {p, std::abs(value), false};
  const Vec3 way = (value > 0 ? -1 : 1) / slope * g;
  const auto along = [&](double t) { return f(p + t * way); };
  double far = std::abs(value);  // 1-Lipschitz: the zero is not nearer
  double far_value = along(far);
  for (int i = 0; i < 8 && (far_value > 0) == (value > 0) && far_value != 0; ++i) {
    far *= 1.5;
    far_value = along(far);
  }
  if (far_value == 0) return {p + far * way, far};
  if ((far_value > 0) == (value > 0)) return {p, far, false};
  const double t = find_zero(along, {0, value}, {far, far_value});
  return {p + t * way, t};
}

/// A node's number in the whole grid.
using GridNode = std::int64_t;

/// The bricks of the grid that the surface crosses.
class SparseGrid {
 public:
  SparseGrid(const GridLines& lines, const ImplicitField& inside) : lines_(lines), inside_(inside) {
    for (std::size_t a = 0; a < 3; ++a) bricks_[a] = lines[a].size() - 1;
  }

  /// The Kuhn tetrahedra of these bricks.
  TetMesh crossed() const {
    const std::vector<GridNode> corners = crossed_bricks();
    const std::vector<GridNode> nodes = nodes_of(corners);
    TetMesh mesh;
    for (const GridNode n : nodes) mesh.points.push_back(position(n));
    for (const GridNode corner : corners) append_cells(corner, nodes, mesh.cells);
    return mesh;
  }

 private:
  GridNode node(std::size_t i, std::size_t j, std::size_t k) const {
    return static_cast<GridNode>((k * lines_[1].size() + j) * lines_[0].size() + i);
  }
  Vec3 position(GridNode n) const {
    const auto x = static_cast<std::size_t>(n);
    const std::size_t nx = lines_[0].size(), ny = lines_[1].size();
    return {lines_[0][x % nx], lines_[1][x / nx % ny], lines_[2][x / nx / ny]};
  }
  std::array<GridNode, 8> corners_of(GridNode corner) const {
    std::array<GridNode, 8> all;
    for (std::size_t c = 0; c < 8; ++c) all[c] = corner + node(c & 1, c >> 1 & 1, c >> 2);
    return all;
  }

  /// Their lowest corners, ascending within a layer of blocks, layer by layer.
  std::vector<GridNode> crossed_bricks() const {
    const std::size_t layers = (bricks_[2] + kBlockBricks - 1) / kBlockBricks;
    return parallel_collect<GridNode>(layers, 1, [&](std::size_t k, std::size_t, auto& found) {
      for (std::size_t j = 0; j < bricks_[1]; j += kBlockBricks) {
        for (std::size_t i = 0; i < bricks_[0]; i += kBlockBricks) {
          search_block({i, j, k * kBlockBricks}, found);
        }
      }
    });
  }

  void search_block(const std::array<std::size_t, 3>& begin, std::vector<GridNode>& found) const {
    std::array<std::size_t, 3> end;
    Vec3 lo, hi;
    for (std::size_t a = 0; a < 3; ++a) {
      end[a] = std::min(begin[a] + kBlockBricks, bricks_[a]);
      lo[static_cast<int>(a)] = lines_[a][begin[a]];
      hi[static_cast<int>(a)] = lines_[a][end[a]];
    }
    if (std::abs(inside_(0.5 * (lo + hi))) > 0.5 * norm(hi - lo)) return;
    const std::vector<char> in = signs(begin, end);
    const std::size_t nx = end[0] - begin[0] + 1, ny = end[1] - begin[1] + 1;
    for (std::size_t k = begin[2]; k < end[2]; ++k) {
      for (std::size_t j = begin[1]; j < end[1]; ++j) {
        for (std::size_t i = begin[0]; i < end[0]; ++i) {
          const std::size_t at = ((k - begin[2]) * ny + j - begin[1]) * nx + i - begin[0];
          int count = 0;
          for (std::size_t c = 0; c < 8; ++c) {
            count += in[at + (c & 1) + nx * ((c >> 1 & 1) + ny * (c >> 2))];
          }
          if (count != 0 && count != 8) found.push_back(node(i, j, k));
        }
      }
    }
  }

  /// 1 for each node of the block that is inside, its last ones included.
  std::vector<char> signs(const std::array<std::size_t, 3>& begin,
                          const std::array<std::size_t, 3>& end) const {
    std::vector<char> in;
    for (std::size_t k = begin[2]; k <= end[2]; ++k) {
      for (std::size_t j = begin[1]; j <= end[1]; ++j) {
        for (std::size_t i = begin[0]; i <= end[0]; ++i) {
          in.push_back(inside_(position(node(i, j, k))) > 0);
        }
      }
    }
    return in;
  }

  std::vector<GridNode> nodes_of(const std::vector<GridNode>& corners) const {
    std::vector<GridNode> nodes;
    for (const GridNode corner : corners) {
      for (const GridNode n : corners_of(corner)) nodes.push_back(n);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  void append_cells(GridNode corner, const std::vector<GridNode>& nodes,
                    std::vector<Cell>& cells) const {
    std::array<Index, 8> known;
    const std::array<GridNode, 8> all = corners_of(corner);
    for (std::size_t c = 0; c < 8; ++c) {
      const auto found = std::lower_bound(nodes.begin(), nodes.end(), all[c]);
      known[c] = static_cast<Index>(found - nodes.begin());
    }
    for (const auto& path : kKuhnPaths) {
      Cell cell = kuhn_cell(0, {1, 2, 4}, path);  // corners of the brick by their bits
      for (Index& n : cell) n = known[static_cast<std::size_t>(n)];
      cells.push_back(cell);
    }
  }

  const GridLines& lines_;
  const ImplicitField& inside_;
  std::array<std::size_t, 3> bricks_{};
};

TriMesh extract_on_grid(const GridLines& lines, const ImplicitField& inside) {
  const TetMesh mesh = SparseGrid(lines, inside).crossed();
  std::vector<double> values(mesh.points.size());
  parallel_for(values.size(), [&](std::size_t n) { values[n] = inside(mesh.points[n]); });
  const auto crossing = [&inside](const Vec3& a, const Vec3& b) {
    const double fa = inside(a), fb = inside(b);
    return find_zero([&](double t) { return inside(a + t * (b - a)); }, {0, fa}, {1, fb});
  };
  return extract_solid(mesh, values, 0, {.close_at_box = false, .crossing = crossing});
}

/// A side's new point, or none.
struct Cut {
  Index lo, hi;
  Index point = kNoIndex;
  bool is_new = true;  ///< a triangle at it is
};

/// One pass of cuts over a surface.
class Refinement {
 public:
  /// @param is_new   1 for each triangle that no pass has looked at.
  /// @param sparing  false: all sides of a triangle are cut if one is. Else slivers between points
  ///                 in one line may make each other again, pass after pass.
  Refinement(TriMesh& surface, std::vector<char>& is_new, const ImplicitField& inside,
             double tolerance, bool sparing)
      : surface_(surface),
        is_new_(is_new),
        inside_(inside),
        tolerance_(tolerance),
        sparing_(sparing) {}

  /// @return whether anything was cut.
  bool run() {
    const auto half_edges = sorted_half_edges(surface_.triangles, surface_.points.size());
    list_edges(half_edges);
    std::vector<char> marked(edges_.size(), 0);
    parallel_for(edges_.size(), [&](std::size_t e) {
      const Cut& edge = edges_[e];
      marked[e] = edge.is_new && is_far(0.5 * (point(edge.lo) + point(edge.hi)));
    });
    mark_longest_sides(marked);
    if (!sparing_) mark_all_sides(marked);
    const std::size_t before = surface_.points.size();
    add_points(marked);
    if (surface_.points.size() == before) return false;
    cut_triangles();
    return true;
  }

 private:
  const Vec3& point(Index n) const { return surface_.points[static_cast<std::size_t>(n)]; }

  /// Mostly one value decides: the distance lies between |f| and |f| / kGradientMin.
  bool is_far(const Vec3& p) const {
    const double value = std::abs(inside_(p));
    if (value <= kGradientMin * tolerance_) return false;
    const Foot foot = foot_of(inside_, p);
    return foot.is_found && foot.distance > tolerance_;  // else cuts would not help
  }

  void list_edges(std::span<const HalfEdge> half_edges) {
    edge_of_.assign(3 * surface_.triangles.size(), 0);
    for_each_edge(half_edges, [this](std::span<const HalfEdge> edge) {
      for (const HalfEdge& s : edge) {
        edge_of_[3 * static_cast<std::size_t>(s.triangle) + static_cast<std::size_t>(s.corner)] =
            edges_.size();
      }
      edges_.push_back({edge[0].lo, edge[0].hi});
      edges_.back().is_new = std::any_of(edge.begin(), edge.end(), [this](const HalfEdge& s) {
        return is_new_[static_cast<std::size_t>(s.triangle)] != 0;
      });
    });
  }

  std::size_t longest_side(std::size_t t) const {
    const auto squared_length = [&](std::size_t i) {
      const Cut& edge = edges_[edge_of_[3 * t + i]];
      const Vec3 d = point(edge.hi) - point(edge.lo);
      return dot(d, d);
    };
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (squared_length(i) > squared_length(longest)) longest = i;
    }
    return edge_of_[3 * t + longest];
  }

  /// For triangles whose middle is too far.
  void mark_longest_sides(std::vector<char>& marked) const {
    std::vector<char> far(surface_.triangles.size());
    parallel_for(far.size(), [&](std::size_t t) {
      const Triangle& k = surface_.triangles[t];
      far[t] = is_new_[t] != 0 && is_far(1.0 / 3 * (point(k[0]) + point(k[1]) + point(k[2])));
    });
    for (std::size_t t = 0; t < far.size(); ++t) {
      if (far[t] != 0) marked[longest_side(t)] = 1;
    }
  }

  /// Of triangles that have a marked side.
  void mark_all_sides(std::vector<char>& marked) const {
    const std::vector<char> before = marked;
    for (std::size_t side = 0; side < edge_of_.size(); ++side) {
      if (before[edge_of_[side]] == 0) continue;
      for (std::size_t i = 0; i < 3; ++i) marked[edge_of_[side / 3 * 3 + i]] = 1;
    }
  }

  void add_points(const std::vector<char>& marked) {
    std::vector<std::size_t> chosen;
    for (std::size_t e = 0; e < marked.size(); ++e) {
      if (marked[e] != 0) chosen.push_back(e);
    }
    const std::size_t first = surface_.points.size();
    surface_.points.resize(first + chosen.size());
    parallel_for(chosen.size(), [&](std::size_t i) {
      Cut& edge = edges_[chosen[i]];
      edge.point = static_cast<Index>(first + i);
      surface_.points[first + i] = foot_of(inside_, 0.5 * (point(edge.lo) + point(edge.hi))).point;
    });
  }

  void cut_triangles() {
    std::vector<Triangle> triangles;
    std::vector<char> is_new;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      std::array<Index, 3> middle;
      for (std::size_t i = 0; i < 3; ++i) middle[i] = edges_[edge_of_[3 * t + i]].point;
      const std::size_t before = triangles.size();
      append_parts(surface_.triangles[t], middle, triangles);
      is_new.resize(triangles.size(), triangles.size() > before + 1);
    }
    surface_.triangles = std::move(triangles);
    is_new_ = std::move(is_new);
  }

  /// @param middle  of the side from corner i to the next, or kNoIndex.
  void append_parts(Triangle k, std::array<Index, 3> middle, std::vector<Triangle>& out) const {
    const auto count = 3 - std::count(middle.begin(), middle.end(), kNoIndex);
    if (count == 0) {
      out.push_back(k);
      return;
    }
    // One cut: on the first side. Two: not on the last.
    while (count == 1 ? middle[0] == kNoIndex : count == 2 && middle[2] != kNoIndex) {
      std::rotate(k.begin(), k.begin() + 1, k.end());
      std::rotate(middle.begin(), middle.begin() + 1, middle.end());
    }
    const auto [a, b, c] = middle;
    if (count == 1) out.insert(out.end(), {{k[0], a, k[2]}, {a, k[1], k[2]}});
    if (count == 3) out.insert(out.end(), {{k[0], a, c}, {a, k[1], b}, {c, b, k[2]}, {a, b, c}});
    if (count != 2) return;
    out.push_back({a, k[1], b});
    const Vec3 d = point(b) - point(k[0]), e = point(k[2]) - point(a);
    if (dot(d, d) <= dot(e, e)) out.insert(out.end(), {{k[0], a, b}, {k[0], b, k[2]}});
    if (dot(d, d) > dot(e, e)) out.insert(out.end(), {{k[0], a, k[2]}, {a, b, k[2]}});
  }

  TriMesh& surface_;
  std::vector<char>& is_new_;
  const ImplicitField& inside_;
  double tolerance_;
  bool sparing_;
  std::vector<Cut> edges_;
  std::vector<std::size_t> edge_of_;  // of side 3 t + i
};

void require_lines(const GridLines& lines) {
  for (const auto& axis : lines) {
    const bool ascends = std::adjacent_find(axis.begin(), axis.end(), [](double a, double b) {
                           return !(a < b);
                         }) == axis.end();
    if (axis.size() < 2 || axis.size() > (1u << 20) || !ascends) {
      throw InputError("implicit surface: expected 2 to 2^20 ascending grid lines, found " +
                       std::to_string(axis.size()) + (ascends ? "" : " that do not ascend"));
    }
  }
}

}  // namespace

ImplicitError implicit_error(const TriMesh& surface, const ImplicitField& inside) {
  require_sound(surface);
  const auto distance = [&](const Vec3& p) { return foot_of(inside, p).distance; };
  const auto& points = surface.points;
  const auto middle = [&](const Triangle& k) {
    return 1.0 / 3 * (points[k[0]] + points[k[1]] + points[k[2]]);
  };
  ImplicitError error;
  error.max = parallel_max(points.size(), 0, [&](std::size_t begin, std::size_t end) {
    double max = 0;
    for (std::size_t n = begin; n < end; ++n) max = std::max(max, distance(points[n]));
    return max;
  });
  std::vector<double> at_middle(surface.triangles.size());
  const double at_triangles =
      parallel_max(at_middle.size(), 0, [&](std::size_t begin, std::size_t end) {
        double max = 0;
        for (std::size_t t = begin; t < end; ++t) {
          const Triangle& k = surface.triangles[t];
          at_middle[t] = distance(middle(k));
          max = std::max(max, at_middle[t]);
          for (std::size_t i = 0; i < 3; ++i) {
            const Index a = k[i], b = k[(i + 1) % 3];
            if (a < b) max = std::max(max, distance(0.5 * (points[a] + points[b])));
          }
        }
        return max;
      });
  error.max = std::max(error.max, at_triangles);
  double area = 0;
  for (std::size_t t = 0; t < at_middle.size(); ++t) {
    area += triangle_area(surface, t);
    error.mean += triangle_area(surface, t) * at_middle[t];
  }
  if (area > 0) error.mean /= area;
  return error;
}

TriMesh extract_implicit(const GridLines& lines, const ImplicitField& inside, double tolerance) {
  require_lines(lines);
  if (!(tolerance > 0)) {
    throw InputError("implicit surface: expected a positive tolerance, found " +
                     std::to_string(tolerance));
  }
  TriMesh surface = extract_on_grid(lines, inside);
  std::vector<char> is_new(surface.triangles.size(), 1);
  for (int pass = 0; pass < kPasses; ++pass) {
    const bool sparing = pass < kSparingPasses;
    if (!Refinement(surface, is_new, inside, tolerance, sparing).run()) break;
  }
  return surface;
}

}  // namespace mesamis::detail::phantom
