// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/decimate/collapse.h"
#include "mesamis/decimate/triangle_planes.h"

namespace mesamis::detail::decimate {

/// A surface to walk on: one as it will be after a collapse, or some triangles of one.
struct WalkedSurface {
  const EditableSurface& surface;
  const std::vector<TrianglePlanes>& triangles;  ///< side i of each lies at half-edge 3 t + i
  const Collapse* collapse = nullptr;            ///< that has not been made; nullptr: none
  /// Of each point; triangles without a corner that has the mark are not there. Empty: all are.
  std::span<const Index> marks{};
  Index mark = 0;

  /// The half-edge on the other side of that of a triangle which is there; kNoIndex at a rim.
  Index opposite(Index h) const;
  /// Where a half-edge starts.
  Index from(Index h) const {
    const Index p = surface.from(h);
    return collapse != nullptr && p == collapse->removed ? collapse->kept : p;
  }
};

/// Proves that a triangle lies near a surface as a whole, by a walk along its rim.
///
/// The walk stays with a triangle of the surface as long as the next corner is near that; else it
/// crosses to the one beside it, where the rim passes their common side. So the rim is a chain of
/// segments, each near one triangle, for the distance to a triangle is convex. Where the chain turns
/// back across the side that it came by, the ends of what it cuts off are near one triangle, and the
/// chain is shortened. If nothing is left of it, all is near. Else it goes round some points of the
/// surface: their feet on the plane, joined as the points are, and the rim bound cells, one for each
/// triangle of the surface that has such a point. The corners of a cell are near its triangle, so
/// all of it is; and the cells cover what the rim encloses, for together they have no other rim.
class RimWalk {
 public:
  /// @param tolerance  mm.
  explicit RimWalk(double tolerance) : most_(tolerance * tolerance) {}

  /// Walks towards a point.
  /// @return a triangle above or below which it lies, or one not far from there.
  static Index triangle_at(const WalkedSurface& on, const Vec3& p, Index start);

  /// @param start  a triangle of the surface, not far.
  /// @return a distance, mm, from which no point of the triangle is farther from the surface;
  ///         infinity where none up to the tolerance could be proved, which may be in vain.
  double bound(const TrianglePlanes& triangle, const WalkedSurface& on, Index start);

  /// The triangles of the surface to which parts of the last one were found near, each once: those of
  /// the chain, and all around the points that it goes round.
  /// @param on  as bound() had it.
  const std::vector<Index>& used(const WalkedSurface& on);
  /// After a walk in vain a point of the triangle, mostly one that is too far.
  const Vec3& stop() const { return stop_; }

 private:
  static constexpr std::size_t kMost = 128;

  bool goes_round(const TrianglePlanes& triangle, const WalkedSurface& on, Index start);
  bool goes_on(const Vec3& from, const Vec3& to, const WalkedSurface& on);
  bool goes_back(const Vec3& at, Index first, const WalkedSurface& on);
  bool is_near(const Vec3& p, const TrianglePlanes& other);
  bool cross(Index exit, Index entry);
  void close_chain(const WalkedSurface& on);
  bool is_filled(const TrianglePlanes& triangle, const WalkedSurface& on);

  double most_;       // squared
  double found_ = 0;  // squared
  Vec3 stop_{0, 0, 0};
  Index now_ = 0;                     // the triangle that the rim is near
  std::vector<Index> used_;           // those of the chain, each once
  std::vector<Index> enclosed_;       // half-edges that leave the points inside the chain
  std::array<Index, kMost> exits_{};  // the half-edges across which the chain leaves triangles
  std::size_t exit_count_ = 0;
};

}  // namespace mesamis::detail::decimate
