// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "mesamis/fem/grid_space.h"
#include "mesamis/image/slice_source.h"
#include "mesamis/mesh/metric.h"
#include "mesamis/mesh/metric_field.h"
#include "mesamis/slabs/piece.h"

namespace mesamis::detail::slabs {

/// What a mesh is made for: the metric, and the fields that are carried over, around a piece.
class Background : public MetricField {
 public:
  /// u and v at points; f is 0, and the metric that of at().
  virtual std::vector<NodeValues> values(std::span<const Vec3> points) const = 0;
};

/// Values at the nodes of a mesh.
class MeshBackground : public Background {
 public:
  /// @param piece  its metrics are positive definite.
  explicit MeshBackground(Piece piece);
  Sym3 at(const Vec3& p, Index& hint) const override { return metric_.at(p, hint); }
  std::vector<NodeValues> values(std::span<const Vec3> points) const override;

 private:
  Piece piece_;
  MeshMetricField metric_;
};

/// Another background whose metric asks for edges that are not too long along z.
class LowBackground : public Background {
 public:
  /// @param inner    is kept as a reference.
  /// @param h_max    the largest size of its metric, length units.
  /// @param highest  of an edge along z, length units, > 0.
  LowBackground(const Background& inner, double h_max, double highest);
  Sym3 at(const Vec3& p, Index& hint) const override { return intersect(inner_.at(p, hint), low_); }
  std::vector<NodeValues> values(std::span<const Vec3> points) const override;

 private:
  const Background& inner_;
  Sym3 low_;  // the coarsest metric that is low enough
};

/// Values at the nodes of some slices of a Kuhn grid.
struct GridWindow {
  Box box;                                        ///< of its nodes, length units
  std::array<Index, 3> size{};                    ///< nodes
  std::vector<float> u, v;                        ///< per node
  std::vector<std::array<float, 6>> log_metrics;  ///< per node
};

/// The grid of a window, whose first node is the window's low corner.
KuhnGrid grid_of(const GridWindow& window);

/// The slices of a window that lie between two heights, and one beyond each where there is one; at
/// least two.
SliceRange slice_range(const GridWindow& window, double low, double high);
/// A window of some slices, still without values.
GridWindow frame_of(const GridWindow& window, const SliceRange& range);
/// The slices of slice_range(), with their values.
GridWindow slices_between(const GridWindow& window, double low, double high);

/// Values at the nodes of a window.
class GridBackground : public Background {
 public:
  explicit GridBackground(GridWindow window);
  Sym3 at(const Vec3& p, Index& hint) const override { return metric_.at(p, hint); }
  std::vector<NodeValues> values(std::span<const Vec3> points) const override;

 private:
  GridWindow window_;
  GridMetricField metric_;
};

/// Backgrounds one above the other.
class StackedBackground : public Background {
 public:
  /// @param parts  at least one, the lowest first.
  /// @param tops   where each ends and the next one begins; none for the last.
  StackedBackground(std::vector<std::unique_ptr<Background>> parts, std::vector<double> tops)
      : parts_(std::move(parts)), tops_(std::move(tops)) {}
  Sym3 at(const Vec3& p, Index& hint) const override;
  std::vector<NodeValues> values(std::span<const Vec3> points) const override;

 private:
  /// The number of the part at a height.
  Index part_at(double height) const;
  std::vector<std::unique_ptr<Background>> parts_;
  std::vector<double> tops_;
};

/// Windows one above the other, each with a slice of the next one.
std::unique_ptr<Background> stack(std::vector<GridWindow> windows);

}  // namespace mesamis::detail::slabs
