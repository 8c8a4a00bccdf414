// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/mesh/locate.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis::detail::mesh {

/// A metric at every point of a box, as the remesher needs it. Implementations are immutable: any
/// number of threads may call at() at once.
class MetricField {
 public:
  virtual ~MetricField() = default;

  /// The metric at a point.
  /// @param p     mm; a point outside the box counts as its nearest point inside.
  /// @param hint  where the last look-up ended; start with 0, pass the same variable again for
  ///              nearby points. It speeds the search up and never changes the answer beyond
  ///              round-off: callers that need equal bits must pass equal hints.
  /// @return positive definite, 1/mm^2.
  virtual Sym3 at(const Vec3& p, Index& hint) const = 0;
};

/// Metrics at the nodes of a regular grid, interpolated log-Euclidean and trilinear.
class GridMetricField : public MetricField {
 public:
  /// Takes the logarithms of nodal metrics. O(n) to check them.
  /// @param box          the grid's box, mm.
  /// @param size         nodes per direction, each at least 2.
  /// @param log_metrics  logarithms of n metrics in 1/mm^2, xx xy xz yy yz zz, x fastest.
  /// @throws InputError  if the sizes differ or an entry is not finite; the node is named.
  GridMetricField(const Box& box, const std::array<Index, 3>& size,
                  std::vector<std::array<float, 6>> log_metrics);
  Sym3 at(const Vec3& p, Index& hint) const override;

 private:
  Box box_;
  std::array<Index, 3> size_;
  std::vector<std::array<float, 6>> log_metrics_;
};

/// Metrics at the nodes of a mesh, interpolated log-Euclidean and linear on its cells.
class MeshMetricField : public MetricField {
 public:
  /// Finds the neighbours of the cells and takes the logarithms of the metrics.
  /// @param mesh          the background mesh, n nodes, m cells, mm.
  /// @param node_metrics  n symmetric positive definite matrices, 1/mm^2.
  /// @throws InputError   if the sizes differ, or a metric is not finite or not positive definite;
  ///                      the message names the node. As cell_neighbors().
  /// @param extent        whether the mesh fills its bounding box.
  MeshMetricField(TetMesh mesh, std::span<const Sym3> node_metrics,
                  MeshExtent extent = MeshExtent::kBox);
  Sym3 at(const Vec3& p, Index& hint) const override;

 private:
  TetMesh mesh_;
  MeshExtent extent_;
  Box box_;
  std::vector<std::array<Index, 4>> neighbors_;
  std::vector<Sym3> log_metrics_;
};

/// A field with all sizes multiplied by a factor.
class ScaledMetricField : public MetricField {
 public:
  /// @param field        is referred to: it must outlive this object.
  /// @param size_factor  no unit, > 0.
  ScaledMetricField(const MetricField& field, double size_factor) noexcept
      : field_(field), factor_(1 / (size_factor * size_factor)) {}
  Sym3 at(const Vec3& p, Index& hint) const override { return factor_ * field_.at(p, hint); }

 private:
  const MetricField& field_;
  double factor_;
};

/// Evaluates the field at each point, in parallel.
/// @param points  n points, mm.
/// @return n matrices, 1/mm^2.
/// @throws what field.at() throws
///
/// O(n) look-ups, cheap where neighbours in the list are near each other. The same bits for any
/// number of threads.
std::vector<Sym3> sample(const MetricField& field, std::span<const Vec3> points);

}  // namespace mesamis::detail::mesh
