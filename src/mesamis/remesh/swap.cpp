// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/swap.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "mesamis/mesh/edges.h"
#include "mesamis/remesh/geometry.h"
#include "mesamis/remesh/skin.h"

namespace mesamis::detail::remesh {
namespace {

constexpr double kImpossible = std::numeric_limits<double>::infinity();

double energy_of(const WorkingMesh& mesh, std::span<const Index> cells) {
  double sum = 0;
  for (const Index c : cells) sum += energy(mesh.cells[c].quality3);
  return sum;
}

/// Rings of more points are left alone.
constexpr std::size_t kMostRing = 12;

/// A piece of the ring around an edge, whose cells are of one material.
struct Arc {
  std::array<Index, kMostRing> points;
  std::size_t size = 0;
  std::uint8_t material = 1;

  void add(Index p) { points[size++] = p; }
  /// A single cell between two points of the ring: it vanishes with the edge.
  bool is_one_cell() const { return size == 2; }
};

/// Removal of an edge: its ring is triangulated, and each triangle joined to both ends of the
/// edge. The best triangulation is found by dynamic programming over the ring's arcs.
/// Source: Klincsek, Minimal triangulations of polygonal domains, 1980.
class EdgeRemoval {
 public:
  EdgeRemoval(const WorkingMesh& mesh, const Arc& arc, std::array<Index, 2> edge)
      : mesh_(mesh), ring_(arc.points.data(), arc.size), material_(arc.material), edge_(edge) {}

  /// The least energy of the new cells, or kImpossible if none is below `limit`.
  double solve(double limit) {
    const std::size_t n = ring_.size();
    for (std::size_t i = 0; i + 1 < n; ++i) best_[i][i + 1] = 0;
    for (std::size_t width = 2; width < n; ++width) {
      bool any = false;
      for (std::size_t i = 0; i + width < n; ++i) any |= solve_arc(i, i + width, limit);
      if (!any && width == 2) return kImpossible;  // every triangulation cuts off an ear
    }
    return best_[0][n - 1];
  }

  void propose(Cavity& cavity) const { propose_arc(cavity, 0, ring_.size() - 1); }

 private:
  Cell upper(std::size_t i, std::size_t k, std::size_t j) const {
    return {ring_[i], ring_[k], ring_[j], edge_[1]};
  }
  Cell lower(std::size_t i, std::size_t k, std::size_t j) const {
    return {ring_[k], ring_[i], ring_[j], edge_[0]};
  }

  bool solve_arc(std::size_t i, std::size_t j, double limit) {
    double best = limit;
    bool found = false;
    for (std::size_t k = i + 1; k < j; ++k) {
      double sum = best_[i][k] + best_[k][j];
      if (!add_energy(upper(i, k, j), best, sum) || !add_energy(lower(i, k, j), best, sum))
        continue;
      best = sum;
      apex_[i][j] = static_cast<std::uint8_t>(k);
      found = true;
    }
    best_[i][j] = found ? best : kImpossible;
    return found;
  }

  /// Adds a cell's energy to the sum; false once the sum is no better than the best.
  bool add_energy(const Cell& cell, double best, double& sum) const {
    if (sum >= best) return false;
    const double q = quality3(mesh_, cell);
    if (q <= kTinyQuality3) return false;
    sum += energy(q);
    return sum < best;
  }

  void propose_arc(Cavity& cavity, std::size_t i, std::size_t j) const {
    if (j - i < 2) return;
    const std::size_t k = apex_[i][j];
    propose_arc(cavity, i, k);
    propose_arc(cavity, k, j);
    for (const Cell& cell : {upper(i, k, j), lower(i, k, j)}) {
      cavity.propose(cell, quality3(mesh_, cell), material_);
    }
  }

  const WorkingMesh& mesh_;
  std::span<const Index> ring_;
  std::uint8_t material_;
  std::array<Index, 2> edge_;
  std::array<std::array<double, kMostRing>, kMostRing> best_;
  std::array<std::array<std::uint8_t, kMostRing>, kMostRing> apex_;
};

/// How an edge can be removed: the ring in one piece; of an edge on the skin between two materials,
/// in two. None: it cannot.
struct Removal {
  std::array<Arc, 2> both{};
  std::size_t count = 0;
  std::span<const Arc> arcs() const { return {both.data(), count}; }
  std::array<Index, 2> skin_edge{kNoIndex, kNoIndex};  ///< that takes the edge's place on the skin
};

/// Positions i of the ring where the cell before and the cell after differ in material.
std::vector<std::size_t> material_changes(const WorkingMesh& mesh, const Cavity& cavity) {
  const auto shell = cavity.shell();
  std::vector<std::size_t> changes;
  if (mesh.shape == nullptr) return changes;
  for (std::size_t i = cavity.shell_is_closed() ? 0 : 1; i < shell.size(); ++i) {
    const Index before = shell[i == 0 ? shell.size() - 1 : i - 1];
    if (mesh.cells[before].material != mesh.cells[shell[i]].material) changes.push_back(i);
  }
  return changes;
}

/// The points of a closed ring from one position round to another.
Arc arc_between(const WorkingMesh& mesh, const Cavity& cavity, std::size_t from, std::size_t to) {
  const auto ring = cavity.ring();
  Arc arc;
  arc.material = mesh.cells[cavity.shell()[from]].material;
  arc.add(ring[from]);
  for (std::size_t i = from; i != to;) {
    i = (i + 1) % ring.size();
    arc.add(ring[i]);
  }
  return arc;
}

Removal whole_ring(const WorkingMesh& mesh, const Cavity& cavity) {
  Removal removal{.count = 1};
  removal.both[0].material = mesh.cells[cavity.shell()[0]].material;
  for (const Index p : cavity.ring()) removal.both[0].add(p);
  return removal;
}

/// An edge on one box plane can go, the face edges of its ring's ends meet in that plane; an edge
/// of the box cannot, nor one where the skin meets a plane or a third material.
Removal find_removal(const WorkingMesh& mesh, const Cavity& cavity) {
  const auto ring = cavity.ring();
  if (ring.size() < 3 || ring.size() > kMostRing) return {};
  const auto changes = material_changes(mesh, cavity);
  if (changes.empty()) return whole_ring(mesh, cavity);
  if (changes.size() != 2 || !cavity.shell_is_closed()) return {};
  return {{arc_between(mesh, cavity, changes[0], changes[1]),
           arc_between(mesh, cavity, changes[1], changes[0])},
          2,
          {ring[changes[0]], ring[changes[1]]}};
}

/// Whether one of the arcs is a single cell, which vanishes: the skin then passes over it.
bool peels_a_cell(const Removal& removal) {
  return std::ranges::any_of(removal.arcs(), &Arc::is_one_cell);
}

/// Whether the skin may turn its edge (a, b) into the removal's: the new triangles are as near to
/// the border as they must be, and the new edge is not on the skin yet.
bool may_turn_skin(Workbench& bench, const Edge& edge, const Removal& removal) {
  const WorkingMesh& mesh = bench.mesh;
  const Index p = removal.skin_edge[0], q = removal.skin_edge[1];
  auto at = [&mesh](Index v) { return mesh.vertices[v].position; };
  const std::array<Corners3, 2> before{Corners3{at(edge[0]), at(edge[1]), at(p)},
                                       Corners3{at(edge[1]), at(edge[0]), at(q)}};
  const std::array<Corners3, 2> after{Corners3{at(edge[1]), at(p), at(q)},
                                      Corners3{at(edge[0]), at(q), at(p)}};
  if (!may_replace_skin(mesh, before, after)) return false;
  if (!peels_a_cell(removal)) return true;  // cells fill the box: the edge is nowhere else
  if (mesh.vertices[p].mask & mesh.vertices[q].mask & kFrozen) return false;
  const auto shell = bench.cavity.shell();
  const Index cell = *std::ranges::find_if(shell, [&](Index c) {
    return local_index(mesh.cells[c].points, p) >= 0 && local_index(mesh.cells[c].points, q) >= 0;
  });
  const bool is_inside =
      bench.cavity.find_shell(cell, p, q) && !edge_features(mesh, bench.cavity, {p, q}).on_skin();
  bench.cavity.find_shell(cell, edge[0], edge[1]);
  return is_inside;
}

struct BestSwap {
  double gain;
  int edge = -1, face = -1;
};

bool is_tried(const WorkCell& cell, int bit) { return cell.tried >> bit & 1; }

void set_tried(WorkCell& cell, int bit) {
  cell.tried = static_cast<std::uint16_t>(cell.tried | 1 << bit);
}

int local_edge(const Cell& cell, const std::array<Index, 2>& edge) {
  constexpr std::array<std::array<std::int8_t, 4>, 4> kEdge{
      {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}}};
  return kEdge[local_index(cell, edge[0])][local_index(cell, edge[1])];
}

/// Cells around an edge with no more energy than this have hardly ever been seen to gain by
/// removing it: the longer the ring, the flatter the cells that take their place.
double hopeless_energy(std::size_t cells) {
  constexpr std::array<double, 4> kPerCell{0, 0.75, 1.25, 2};  // 4 cells or fewer, 5, 6, more
  return kPerCell[std::clamp<std::size_t>(cells, 4, 7) - 4] * static_cast<double>(cells);
}

/// A cell of no more energy is not peeled off the skin.
constexpr double kPeelEnergy = 20;

/// The energy after an edge was removed, or kImpossible if it is not below `limit`.
double energy_without(const WorkingMesh& mesh, const Edge& edge, const Removal& removal,
                      double limit) {
  double sum = 0;
  for (const Arc& arc : removal.arcs()) {
    if (arc.is_one_cell()) continue;
    sum += EdgeRemoval(mesh, arc, edge).solve(limit - sum);
    if (!(sum < limit)) return kImpossible;
  }
  return sum;
}

/// The energy that removing the edge of the present shell saves, or 0 if no more than `gain`.
double edge_removal_gain(Workbench& bench, const Edge& edge, double gain) {
  const double before = energy_of(bench.mesh, bench.cavity.shell());
  if (before <= std::max(gain, hopeless_energy(bench.cavity.shell().size()))) return 0;
  const Removal removal = find_removal(bench.mesh, bench.cavity);
  if (removal.count == 0 || (peels_a_cell(removal) && before < kPeelEnergy)) return 0;
  const double after = energy_without(bench.mesh, edge, removal, before - gain);
  if (after == kImpossible) return 0;
  const bool turns_skin = removal.skin_edge[0] != kNoIndex;
  return turns_skin && !may_turn_skin(bench, edge, removal) ? 0 : before - after;
}

void try_edge_removals(Workbench& bench, Index cell, BestSwap& best) {
  WorkingMesh& mesh = bench.mesh;
  const Cell points = mesh.cells[cell].points;
  for (int e = 0; e < 6; ++e) {
    if (is_tried(mesh.cells[cell], e)) continue;
    const std::array<Index, 2> edge{points[kCellEdges[e][0]], points[kCellEdges[e][1]]};
    const unsigned shared = mesh.vertices[edge[0]].mask & mesh.vertices[edge[1]].mask;
    if ((shared & kFrozen) || std::popcount(shared & kPlanes) > 1) continue;
    if (!bench.cavity.find_shell(cell, edge[0], edge[1])) continue;
    const double gain = edge_removal_gain(bench, edge, best.gain);
    if (gain > best.gain) {
      best = {gain, e, -1};
    } else if (best.edge < 0) {
      for (const Index c : bench.cavity.shell()) {
        set_tried(mesh.cells[c], local_edge(mesh.cells[c].points, edge));
      }
    }
  }
}

/// The three cells around the edge between the corners opposite a face.
std::array<Cell, 3> cells_through_face(const WorkingMesh& mesh, Index cell, int face) {
  const WorkCell& k = mesh.cells[cell];
  const FaceRef n = k.neighbors[face];
  const Index d = k.points[face], e = mesh.cells[cell_of(n)].points[face_of(n)];
  const auto& f = kCellFaces[face];
  const Index p = k.points[f[0]], q = k.points[f[1]], r = k.points[f[2]];
  return {Cell{d, e, p, q}, Cell{d, e, q, r}, Cell{d, e, r, p}};
}

/// The energy that turning a face into an edge saves, or no more than `gain`.
double face_removal_gain(const WorkingMesh& mesh, Index cell, int face, double gain) {
  const WorkCell& k = mesh.cells[cell];
  double left = energy(k.quality3) + energy(mesh.cells[cell_of(k.neighbors[face])].quality3);
  for (const Cell& candidate : cells_through_face(mesh, cell, face)) {
    if (left <= gain) break;
    const double q = quality3(mesh, candidate);
    left = q > kTinyQuality3 ? left - energy(q) : 0;
  }
  return left;
}

void try_face_removals(WorkingMesh& mesh, Index cell, BestSwap& best) {
  for (int f = 0; f < 4; ++f) {
    const FaceRef across = mesh.cells[cell].neighbors[f];
    if (across == kNoIndex || is_tried(mesh.cells[cell], 6 + f)) continue;
    if (mesh.cells[cell_of(across)].material != mesh.cells[cell].material) continue;
    const double gain = face_removal_gain(mesh, cell, f, best.gain);
    if (gain > best.gain) {
      best = {gain, -1, f};
    } else if (best.edge < 0 && best.face < 0) {
      set_tried(mesh.cells[cell], 6 + f);
      set_tried(mesh.cells[cell_of(across)], 6 + face_of(across));
    }
  }
}

/// Proposes the best triangulation of the arcs; what it may cost at most must be known.
bool propose_removal(Workbench& bench, const Edge& edge, const Removal& removal, double limit) {
  bench.cavity.clear();
  for (const Arc& arc : removal.arcs()) {
    if (arc.is_one_cell()) continue;
    EdgeRemoval triangulation(bench.mesh, arc, edge);
    const double energy = triangulation.solve(limit);
    if (energy == kImpossible) return false;
    limit -= energy;
    triangulation.propose(bench.cavity);
  }
  return true;
}

bool remove_edge(Workbench& bench, Index cell, int local_edge) {
  const Cell points = bench.mesh.cells[cell].points;
  const Edge edge{points[kCellEdges[local_edge][0]], points[kCellEdges[local_edge][1]]};
  bench.cavity.find_shell(cell, edge[0], edge[1]);
  const Removal removal = find_removal(bench.mesh, bench.cavity);
  const double before = energy_of(bench.mesh, bench.cavity.shell());
  if (!propose_removal(bench, edge, removal, before)) return false;
  bench.cavity.replace(bench.cavity.shell());
  return true;
}

bool remove_face(Workbench& bench, Index cell, int face) {
  const std::array<Index, 2> old_cells{cell, cell_of(bench.mesh.cells[cell].neighbors[face])};
  if (!propose_without_face(bench, cell, face)) return false;
  bench.cavity.replace(old_cells);
  return true;
}

}  // namespace

bool swap_around_cell(Workbench& bench, Index cell, double gain) {
  BestSwap best{gain};
  try_edge_removals(bench, cell, best);
  try_face_removals(bench.mesh, cell, best);
  if (best.edge >= 0) return remove_edge(bench, cell, best.edge);
  return best.face >= 0 && remove_face(bench, cell, best.face);
}

std::int64_t swap_bad_cells(Workbench& bench, const SwapRule& rule) {
  std::int64_t swaps = 0;
  const auto cells = static_cast<Index>(bench.mesh.cells.size());  // new ones wait for next time
  for (Index c = 0; c < cells; ++c) {
    if (bench.mesh.cells[c].quality3 > rule.quality3_max) continue;
    if (take_pending(bench.mesh, c, kToSwap)) swaps += swap_around_cell(bench, c, rule.gain);
  }
  return swaps;
}

bool propose_without_edge(Workbench& bench, Index cell, std::array<Index, 2> edge) {
  const auto& vertices = bench.mesh.vertices;
  const unsigned shared = vertices[edge[0]].mask & vertices[edge[1]].mask;
  if ((shared & kFrozen) || std::popcount(shared & kPlanes) > 1) return false;
  if (!bench.cavity.find_shell(cell, edge[0], edge[1])) return false;
  const Removal removal = find_removal(bench.mesh, bench.cavity);
  if (removal.count == 0 || !propose_removal(bench, edge, removal, 1 / kTinyQuality3)) return false;
  return removal.skin_edge[0] == kNoIndex || may_turn_skin(bench, edge, removal);
}

bool propose_without_face(Workbench& bench, Index cell, int face) {
  const WorkCell& k = bench.mesh.cells[cell];
  const FaceRef across = k.neighbors[face];
  if (across == kNoIndex || bench.mesh.cells[cell_of(across)].material != k.material) return false;
  bench.cavity.clear();
  for (const Cell& c : cells_through_face(bench.mesh, cell, face)) {
    bench.cavity.propose(c, quality3(bench.mesh, c), k.material);
  }
  return true;
}

}  // namespace mesamis::detail::remesh
