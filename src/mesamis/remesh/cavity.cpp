// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/cavity.h"

#include <algorithm>

namespace mesamis::detail::remesh {
namespace {

/// Local indices c, d that make (a, b, c, d) positive for each pair of local indices a, b.
constexpr std::array<std::array<std::array<std::int8_t, 2>, 4>, 4> kOpposite{
    {{{{-1, -1}, {2, 3}, {3, 1}, {1, 2}}},
     {{{3, 2}, {-1, -1}, {0, 3}, {2, 0}}},
     {{{1, 3}, {3, 0}, {-1, -1}, {0, 1}}},
     {{{2, 1}, {0, 2}, {1, 0}, {-1, -1}}}}};

std::array<std::int8_t, 2> opposite_edge(const Cell& cell, Index a, Index b) {
  return kOpposite[static_cast<std::size_t>(local_index(cell, a))]
                  [static_cast<std::size_t>(local_index(cell, b))];
}

bool is_same(const std::array<Index, 3>& a, const std::array<Index, 3>& b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

std::size_t hash(const std::array<Index, 3>& key) {
  const std::uint64_t h = static_cast<std::uint64_t>(key[0]) * 0x9e3779b97f4a7c15 +
                          static_cast<std::uint64_t>(key[1]) * 0xc2b2ae3d27d4eb4f +
                          static_cast<std::uint64_t>(key[2]) * 0x165667b19e3779f9;
  return static_cast<std::size_t>(h >> 32);
}

}  // namespace

Cavity::Cavity(WorkingMesh& mesh) : mesh_(mesh), faces_(4096) {
  for (WorkCell& cell : mesh.cells) cell.mark = 0;
}

std::span<const Index> Cavity::ball(Index vertex) {
  collect_ball(vertex, ball_);
  return ball_;
}

void Cavity::collect_ball(Index vertex, std::vector<Index>& cells) {
  const std::uint32_t mark = next_mark();
  cells.assign(1, mesh_.vertices[vertex].cell);
  mesh_.cells[cells[0]].mark = mark;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const WorkCell& cell = mesh_.cells[cells[i]];
    for (int f = 0; f < 4; ++f) {
      const FaceRef n = cell.neighbors[f];
      if (n == kNoIndex || cell.points[f] == vertex) continue;
      WorkCell& other = mesh_.cells[cell_of(n)];
      if (other.mark == mark) continue;
      other.mark = mark;
      cells.push_back(cell_of(n));
    }
    if (cells.size() > kMostBall) {
      cells.clear();
      return;
    }
  }
}

bool Cavity::find_shell(Index cell, Index a, Index b) {
  if (!walk_shell(cell, a, b)) return false;
  if (shell_is_closed()) return true;
  // An open shell starts at the box.
  Index first = cell;
  for (std::size_t steps = 0; steps <= kMostShell; ++steps) {
    const WorkCell& k = mesh_.cells[first];
    const FaceRef back = k.neighbors[opposite_edge(k.points, a, b)[1]];
    if (back == kNoIndex) return walk_shell(first, a, b);
    first = cell_of(back);
  }
  return false;
}

bool Cavity::walk_shell(Index first, Index a, Index b) {
  auto [c, d] = opposite_edge(mesh_.cells[first].points, a, b);
  Index ring_point = mesh_.cells[first].points[c];
  shell_size_ = ring_size_ = 0;
  for (Index current = first;;) {
    if (shell_size_ == kMostShell) return false;
    const WorkCell& k = mesh_.cells[current];
    shell_[shell_size_++] = current;
    ring_[ring_size_++] = ring_point;
    const FaceRef onward = k.neighbors[c];
    ring_point = k.points[d];
    if (onward == kNoIndex) {
      ring_[ring_size_++] = ring_point;
      return true;
    }
    current = cell_of(onward);
    if (current == first) return true;
    // The corner opposite the face that was crossed is the ring's next point.
    c = static_cast<std::int8_t>(local_index(mesh_.cells[current].points, ring_point));
    d = static_cast<std::int8_t>(face_of(onward));
  }
}

void Cavity::replace(std::span<const Index> old_cells) {
  reset_faces(4 * (old_cells.size() + proposed_.size()));
  collect_outer_faces(old_cells);
  for (std::size_t i = 0; i < proposed_.size(); ++i) {
    write_cell(i < old_cells.size() ? old_cells[i] : mesh_.new_cell(), proposed_[i]);
  }
  for (std::size_t i = proposed_.size(); i < old_cells.size(); ++i) mesh_.free_cell(old_cells[i]);
}

std::uint32_t Cavity::next_mark() {
  if (++mark_ == 0) {
    for (WorkCell& cell : mesh_.cells) cell.mark = 0;
    mark_ = 1;
  }
  return mark_;
}

void Cavity::reset_faces(std::size_t faces) {
  if (2 * faces > faces_.size()) {
    std::size_t size = faces_.size();
    while (size < 2 * faces) size *= 2;
    faces_.assign(size, {});
    faces_epoch_ = 0;
  }
  if (++faces_epoch_ == 0) {
    std::fill(faces_.begin(), faces_.end(), FaceSlot{});
    faces_epoch_ = 1;
  }
}

Cavity::FaceSlot& Cavity::face_slot(const Cell& cell, int face) {
  const auto& local = kCellFaces[static_cast<std::size_t>(face)];
  std::array<Index, 3> key{cell[local[0]], cell[local[1]], cell[local[2]]};
  if (key[0] > key[1]) std::swap(key[0], key[1]);
  if (key[1] > key[2]) std::swap(key[1], key[2]);
  if (key[0] > key[1]) std::swap(key[0], key[1]);
  const std::size_t last = faces_.size() - 1;
  std::size_t i = hash(key) & last;
  while (faces_[i].epoch == faces_epoch_ && !is_same(faces_[i].key, key)) i = (i + 1) & last;
  if (faces_[i].epoch != faces_epoch_) faces_[i] = {key, kNoIndex, faces_epoch_};
  return faces_[i];
}

void Cavity::collect_outer_faces(std::span<const Index> old_cells) {
  const std::uint32_t mark = next_mark();
  for (const Index c : old_cells) mesh_.cells[c].mark = mark;
  for (const Index c : old_cells) {
    const WorkCell& cell = mesh_.cells[c];
    for (int f = 0; f < 4; ++f) {
      const FaceRef n = cell.neighbors[f];
      if (n == kNoIndex || mesh_.cells[cell_of(n)].mark == mark) continue;
      face_slot(cell.points, f).face = n;
    }
  }
}

void Cavity::write_cell(Index id, const Proposal& proposal) {
  WorkCell& cell = mesh_.cells[id];
  cell.points = proposal.points;
  cell.quality3 = static_cast<float>(proposal.quality3);
  cell.material = proposal.material;
  cell.pending = kToAll;
  cell.tried = 0;
  for (int f = 0; f < 4; ++f) {
    FaceSlot& slot = face_slot(proposal.points, f);
    cell.neighbors[f] = slot.face;
    if (slot.face == kNoIndex) {
      slot.face = face_ref(id, f);
    } else {
      mesh_.cells[cell_of(slot.face)].neighbors[face_of(slot.face)] = face_ref(id, f);
    }
    Vertex& vertex = mesh_.vertices[proposal.points[f]];
    vertex.cell = id;
    vertex.failures = vertex.rest = 0;
  }
}

}  // namespace mesamis::detail::remesh
