// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/fit/surface_moves.h"

namespace mesamis::detail::fit {

/// Which neighbours smooth each point: an entry for each of Neighbors::points, 0 if it does not.
/// Where a point is smoothed in two ways, as where two boundaries go on smoothly through it, the
/// neighbours of the first have the bit 1, those of the other the bit 2.
using Links = std::vector<char>;
inline constexpr char kLinked = 1, kLinkedOther = 2;

/// Points on curves, 1 each, are smoothed by those on curves alone, all others by all.
Links links_along_curves(const Neighbors& neighbors, const std::vector<char>& on_curve);

/// What smooths a surface: the umbrella operator L, the difference of a point from the mean of the
/// points that it is linked to; a point with fewer than two links has none. It has one row for each
/// point, and then one for each point that is smoothed in two ways.
class Umbrella {
 public:
  /// @param neighbors  must live as long.
  Umbrella(const Neighbors& neighbors, Links links);

  /// At least as many as there are points.
  std::size_t row_count() const { return share_.size(); }
  /// L x: row_count() entries.
  std::vector<Vec3> bent(const std::vector<Vec3>& x) const;
  /// The same, into a vector of so many.
  void bend(const std::vector<Vec3>& x, std::vector<Vec3>& y) const;
  /// L^T y at a point.
  Vec3 transposed(std::size_t point, const std::vector<Vec3>& y) const;
  /// Whether a point is smoothed in the first way.
  bool smooths(std::size_t point) const { return share_[point] > 0; }
  /// Whether it is smoothed in another way, too.
  bool smooths_twice(std::size_t point) const { return other_row_[point] != kNoIndex; }

 private:
  Vec3 row(const std::vector<Vec3>& x, std::size_t point, std::size_t row, char bit) const;

  const Neighbors& neighbors_;
  Links links_, back_;            // of a point to its neighbours, and of these to the point
  std::vector<double> share_;     // of a row: of each linked neighbour in their mean; 0: none
  std::vector<char> alike_;       // 1: all links of a point hold both ways
  std::vector<Index> other_row_;  // of each point, or kNoIndex
  std::vector<Index> two_ways_;   // the points of the rows after those of all points
};

/// Where points shall be, and how much that counts.
struct Springs {
  std::vector<double> weight;  ///< >= 0 each
  std::vector<Vec3> goal;
  std::vector<char> held;  ///< 1: the point stays where it is
  double accuracy = 1e-3;  ///< of relax(): what is left of the residual, > 0
  double least_step = 0;   ///< surface's unit; relax() ends, too, when a step on is shorter, >= 0
};

/// Springs of one weight that hold points where they are; those on the grid's box stay. Steps of a
/// ten-thousandth of a voxel are short.
Springs springs_at(const SurfaceSpace& space, const std::vector<Vec3>& points, double weight);

/// Finds the points that minimise
///   sum of weight |x - goal|^2 + bending |L x|^2
/// by conjugate gradients, until the springs' accuracy is reached, or Jacobi's step from there,
/// which moves each point to the least as if the others stayed, would be short in the mean.
/// @param x  where they are; the first guess.
/// @return the same for any number of threads.
///
/// O(n) per step, at most 120 steps.
std::vector<Vec3> relax(const Umbrella& umbrella, const Springs& springs, double bending,
                        std::vector<Vec3> x);

}  // namespace mesamis::detail::fit
