// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/remesh/working_mesh.h"

namespace mesamis::detail::remesh {

/// The cells around a vertex, laid side by side so that several are computed at a time: smoothing
/// asks for all their qualities at one trial position after another.
class BallShape {
 public:
  /// @param ball  the cells around `vertex`, with their qualities.
  void gather(const WorkingMesh& mesh, std::span<const Index> ball, Index vertex);

  struct Directions {
    Vec3 to_ideal;  ///< to the mean of the places where the cells would be regular, bad cells
                    ///< weighing more
    Vec3 gradient;  ///< of the sum of the cells' energies by the vertex's position
  };
  /// @param vertex  the one gathered around.
  Directions directions(const Vertex& vertex) const;

  /// Cubes of the cells' qualities with the vertex as it is now, in the order of the ball; 0 for a
  /// cell that is not positive beyond doubt in any order of its points. Valid until the next call.
  std::span<const double> qualities(const Vertex& vertex);

 private:
  static constexpr std::size_t kLanes = 8;
  using Lanes = std::array<double, kLanes>;
  struct LaneVec3 {
    Lanes x, y, z;
    void set(std::size_t lane, const Vec3& p) {
      x[lane] = p.x;
      y[lane] = p.y;
      z[lane] = p.z;
    }
    Vec3 operator[](std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
  };
  /// (vertex, a, b, c) is positive; the metric is that of the finest of a, b and c. Where the
  /// vertex is as fine, its own metric counts: on such a tie quality3() takes the cell's first
  /// corner.
  struct alignas(64) Block {
    LaneVec3 a, b, c;
    Lanes xx, yx, zx, yy, zy, zz, density;
    Lanes quality3;
    Lanes used;  ///< 1, or 0 for a lane that only fills the block up
  };

  void set_lane(std::size_t cell, const WorkingMesh& mesh, Index cell_index, Index vertex);

  std::vector<Block> blocks_;
  std::vector<double> qualities_;
  std::size_t size_ = 0;
};

}  // namespace mesamis::detail::remesh
