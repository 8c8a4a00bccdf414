// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/decimate/triangle_planes.h"

namespace mesamis::detail::decimate {

/// Proves that a triangle lies near some others as a whole.
///
/// A piece of it all of whose corners are near one triangle is near it, for the distance to a
/// triangle is convex. Other pieces are cut along the sides of the triangle nearest to their centre,
/// or halved.
class Covering {
 public:
  /// @param tolerance  mm.
  explicit Covering(double tolerance) : tolerance_(tolerance), most_(tolerance * tolerance) {}

  /// @return a distance, mm, from which no point of the triangle is farther from all others;
  ///         infinity where none up to the tolerance could be proved, which may be in vain.
  double bound(const Corners& triangle, std::span<const TrianglePlanes* const> others);

  /// The others to which pieces of the last triangle were found near, each once or more.
  const std::vector<Index>& used() const { return used_; }

 private:
  static constexpr int kMostCorners = 12;
  /// A convex and flat polygon.
  class Piece {
   public:
    void add(const Vec3& p) {
      if (count_ < kMostCorners) corners_[static_cast<std::size_t>(count_)] = {p.x, p.y, p.z};
      ++count_;
    }
    int count() const { return count_; }
    Vec3 at(int i) const {
      const auto& p = corners_[static_cast<std::size_t>(i)];
      return {p[0], p[1], p[2]};
    }

   private:
    std::array<std::array<double, 3>, kMostCorners>
        corners_;  // left as they are until they are added
    int count_ = 0;
  };

  bool is_covered(const Piece& piece, std::size_t begin, int halvings);
  bool is_covered_by(const Piece& piece, std::size_t begin, std::size_t end, int halvings);
  bool is_near(const Piece& piece, const TrianglePlanes& other);
  static Piece cut_off(Piece& piece, const Vec3& p, const Vec3& n);
  bool halves_are_covered(const Piece& piece, std::size_t begin, int halvings);

  double tolerance_, most_;  // and squared
  double found_ = 0;         // squared
  int pieces_ = 0;           // looked at
  struct Candidate {
    const TrianglePlanes* triangle;
    Index number;
  };
  std::vector<Candidate> near_;  // a stack: those near each piece that encloses the present one
  std::vector<Index> used_;
};

}  // namespace mesamis::detail::decimate
