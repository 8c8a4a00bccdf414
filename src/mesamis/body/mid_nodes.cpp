// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/mid_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/finite_elements.h"

namespace mesamis::detail::body {
namespace {

/// A curved element has at least this share of the Jacobian that it has with straight edges.
constexpr double kLeastShare = 0.2;

/// The barycentric coordinates of the ten nodes and of the four integration points of order two.
std::array<std::array<double, 4>, 14> sample_places() {
  constexpr double kNear = 0.58541019662496852, kFar = 0.13819660112501052;
  std::array<std::array<double, 4>, 14> places{};
  for (std::size_t i = 0; i < 4; ++i) {
    places[i][i] = 1;
    places[10 + i].fill(kFar);
    places[10 + i][i] = kNear;
  }
  for (std::size_t e = 0; e < 6; ++e) {
    for (const int corner : kMidNodeEdges[e]) places[4 + e][static_cast<std::size_t>(corner)] = 0.5;
  }
  return places;
}

/// The derivatives of a quadratic element's position by its four barycentric coordinates.
std::array<Vec3, 4> derivatives(const std::array<Vec3, 4>& corners,
                                const std::array<Vec3, 6>& middles,
                                const std::array<double, 4>& at) {
  std::array<Vec3, 4> d;
  for (std::size_t i = 0; i < 4; ++i) d[i] = (4 * at[i] - 1) * corners[i];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto i = static_cast<std::size_t>(kMidNodeEdges[e][0]);
    const auto j = static_cast<std::size_t>(kMidNodeEdges[e][1]);
    d[i] += 4 * at[j] * middles[e];
    d[j] += 4 * at[i] * middles[e];
  }
  return d;
}

/// An edge of a cell: its ends in increasing order, and where it is.
struct CellEdge {
  Index a, b, cell;
  std::int8_t local;
  bool on_skin;
};

bool lies_in_plane(const BodyMesh& body, const Box& box, const Cell& cell, int face) {
  unsigned planes = ~0U;
  for (const int i : kCellFaces[static_cast<std::size_t>(face)]) {
    planes &= planes_of(box, body.mesh.points[cell[static_cast<std::size_t>(i)]]);
  }
  return planes != 0;
}

/// Bits of the local edges that lie on the skin, for each cell.
std::vector<std::uint8_t> skin_edges(const BodyMesh& body, const Box& box) {
  const auto neighbors = cell_neighbors(body.mesh);
  std::vector<std::uint8_t> edges(neighbors.size(), 0);
  for (std::size_t c = 0; c < neighbors.size(); ++c) {
    for (int f = 0; f < 4; ++f) {
      const Index n = neighbors[c][static_cast<std::size_t>(f)];
      if (n != kNoIndex && body.materials[n] == body.materials[c]) continue;
      if (n == kNoIndex && lies_in_plane(body, box, body.mesh.cells[c], f)) continue;
      for (std::size_t e = 0; e < 6; ++e) {
        if (kMidNodeEdges[e][0] == f || kMidNodeEdges[e][1] == f) continue;
        edges[c] = static_cast<std::uint8_t>(edges[c] | 1U << e);
      }
    }
  }
  return edges;
}

std::vector<CellEdge> all_edges(const BodyMesh& body, const Box& box) {
  const auto on_skin = skin_edges(body, box);
  std::vector<CellEdge> edges;
  edges.reserve(6 * body.mesh.cells.size());
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c) {
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [a, b] =
          std::minmax(body.mesh.cells[c][static_cast<std::size_t>(kMidNodeEdges[e][0])],
                      body.mesh.cells[c][static_cast<std::size_t>(kMidNodeEdges[e][1])]);
      edges.push_back(
          {a, b, static_cast<Index>(c), static_cast<std::int8_t>(e), (on_skin[c] >> e & 1) != 0});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const CellEdge& x, const CellEdge& y) {
    return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.cell < y.cell;
  });
  return edges;
}

/// A node on the skin, and where it lies with a straight edge.
struct SkinNode {
  Index node;
  Vec3 straight;
  bool bent = true;
};

class MidNodeMaker {
 public:
  MidNodeMaker(const BodyMesh& body, const BodyShape& shape, const Box& box)
      : body_(body), shape_(shape), box_(box) {}

  MidNodes make() {
    number(all_edges(body_, box_));
    parallel_for(skin_.size(), [this](std::size_t i) { bend(skin_[i]); });
    skin_of_node_.assign(nodes_.points.size(), kNoIndex);
    for (std::size_t i = 0; i < skin_.size(); ++i) {
      skin_of_node_[skin_[i].node] = static_cast<Index>(i);
    }
    while (straighten_bad_cells()) {
    }
    return std::move(nodes_);
  }

 private:
  void number(const std::vector<CellEdge>& edges) {
    nodes_.of_cell.resize(body_.mesh.cells.size());
    for (std::size_t begin = 0; begin < edges.size();) {
      const CellEdge& edge = edges[begin];
      const auto node = static_cast<Index>(nodes_.points.size());
      const Vec3 middle = 0.5 * (body_.mesh.points[edge.a] + body_.mesh.points[edge.b]);
      bool on_skin = false;
      std::size_t end = begin;
      for (; end < edges.size() && edges[end].a == edge.a && edges[end].b == edge.b; ++end) {
        nodes_.of_cell[edges[end].cell][edges[end].local] = node;
        on_skin = on_skin || edges[end].on_skin;
      }
      nodes_.points.push_back(middle);
      planes_.push_back(planes_of(box_, body_.mesh.points[edge.a]) &
                        planes_of(box_, body_.mesh.points[edge.b]));
      if (on_skin) skin_.push_back({node, middle});
      begin = end;
    }
  }

  void bend(const SkinNode& skin) {
    Vec3& p = nodes_.points[skin.node];
    p = shape_.nearest_border(p).point;
    for (int axis = 0; axis < 3; ++axis) {
      if (planes_[skin.node] >> (2 * axis) & 3) p[axis] = skin.straight[axis];
    }
  }

  bool is_bad(std::size_t c) const {
    const std::array<Vec3, 4> corners = cell_corners(body_.mesh, body_.mesh.cells[c]);
    std::array<Vec3, 6> middles;
    for (std::size_t e = 0; e < 6; ++e) middles[e] = nodes_.points[nodes_.of_cell[c][e]];
    const double straight = six_volume(corners[0], corners[1], corners[2], corners[3]);
    return !(least_jacobian(corners, middles) > kLeastShare * straight);
  }

  /// @return whether an edge was made straight: its other cells must be looked at again.
  bool straighten_bad_cells() {
    const auto bad = parallel_collect<Index>(nodes_.of_cell.size(), kBlock,
                                             [&](std::size_t begin, std::size_t end, auto& found) {
                                               for (std::size_t c = begin; c < end; ++c) {
                                                 if (is_bad(c))
                                                   found.push_back(static_cast<Index>(c));
                                               }
                                             });
    bool any = false;
    for (const Index c : bad) {
      for (const Index node : nodes_.of_cell[c]) {
        if (skin_of_node_[node] == kNoIndex || !skin_[skin_of_node_[node]].bent) continue;
        SkinNode& skin = skin_[skin_of_node_[node]];
        skin.bent = false;
        nodes_.points[node] = skin.straight;
        ++nodes_.straight;
        any = true;
      }
    }
    return any;
  }

  const BodyMesh& body_;
  const BodyShape& shape_;
  Box box_;
  MidNodes nodes_;
  std::vector<unsigned> planes_;  // of the box that hold a node
  std::vector<SkinNode> skin_;
  std::vector<Index> skin_of_node_;
};

}  // namespace

double least_jacobian(const std::array<Vec3, 4>& corners, const std::array<Vec3, 6>& middles) {
  static const auto places = sample_places();
  double least = std::numeric_limits<double>::infinity();
  for (const auto& place : places) {
    const auto d = derivatives(corners, middles, place);
    least = std::min(least, dot(cross(d[1] - d[0], d[2] - d[0]), d[3] - d[0]));
  }
  return least;
}

MidNodes mid_nodes(const BodyMesh& body, const BodyShape& shape, const Box& box) {
  return MidNodeMaker(body, shape, box).make();
}

}  // namespace mesamis::detail::body
