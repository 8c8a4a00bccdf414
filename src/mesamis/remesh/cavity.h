// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesamis/remesh/working_mesh.h"

namespace mesamis::detail::remesh {

/// The hole an operation works on: it finds the cells around a vertex or an edge, collects the
/// cells that shall take their place, and replaces them. Nothing else changes connectivity.
class Cavity {
 public:
  explicit Cavity(WorkingMesh& mesh);

  static constexpr std::size_t kMostBall = 400;
  static constexpr std::size_t kMostShell = 60;

  /// The cells around a vertex; empty if there are more than kMostBall. Valid until the next call.
  std::span<const Index> ball(Index vertex);

  /// The same into a list of the caller's.
  void collect_ball(Index vertex, std::vector<Index>& cells);

  /// Finds the cells around edge (a, b), one of which is `cell`: shell()[i] holds a, b, ring()[i]
  /// and ring()[i + 1] and is positive in this order. On a closed shell the ring goes round.
  /// @return false if there are more than kMostShell.
  bool find_shell(Index cell, Index a, Index b);
  std::span<const Index> shell() const { return {shell_.data(), shell_size_}; }
  std::span<const Index> ring() const { return {ring_.data(), ring_size_}; }
  bool shell_is_closed() const { return ring_size_ == shell_size_; }

  struct Proposal {
    Cell points;
    double quality3;
    std::uint8_t material;
  };
  /// Starts a new list of proposed cells.
  void clear() { proposed_.clear(); }
  /// @param material  see WorkCell.
  void propose(const Cell& points, double quality3, std::uint8_t material) {
    proposed_.push_back({points, quality3, material});
  }
  std::span<const Proposal> proposed() const { return proposed_; }

  /// Puts the proposed cells in the place of the old ones, which fill the same space.
  void replace(std::span<const Index> old_cells);

 private:
  struct FaceSlot {
    std::array<Index, 3> key{};
    FaceRef face = kNoIndex;
    std::uint32_t epoch = 0;
  };

  /// The shell from `first` to the box or round to it again.
  bool walk_shell(Index first, Index a, Index b);
  std::uint32_t next_mark();
  void reset_faces(std::size_t faces);
  FaceSlot& face_slot(const Cell& cell, int face);
  void collect_outer_faces(std::span<const Index> old_cells);
  void write_cell(Index cell, const Proposal& proposal);

  WorkingMesh& mesh_;
  std::uint32_t mark_ = 0;
  std::vector<Index> ball_;
  std::array<Index, kMostShell> shell_;
  std::array<Index, kMostShell + 1> ring_;
  std::size_t shell_size_ = 0, ring_size_ = 0;
  std::vector<Proposal> proposed_;
  std::vector<FaceSlot> faces_;
  std::uint32_t faces_epoch_ = 0;
};

}  // namespace mesamis::detail::remesh
