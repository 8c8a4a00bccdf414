// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mesamis/fem/grid_space.h"
#include "mesamis/mesh/metric_field.h"
#include "mesamis/slabs/piece.h"

namespace mesamis::detail {

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

/// Values at the nodes of some slices of a Kuhn grid.
struct GridWindow {
  Box box;                                        ///< of its nodes, length units
  std::array<Index, 3> size{};                    ///< nodes
  std::vector<float> u, v;                        ///< per node
  std::vector<std::array<float, 6>> log_metrics;  ///< per node
};

/// The grid of a window, whose first node is the window's low corner. O(1).
KuhnGrid grid_of(const GridWindow& window);

/// The slices of a window that lie between two heights, and one beyond each where there is one.
GridWindow slices_between(const GridWindow& window, double low, double high);
void add_window(ArchiveWriter& archive, const GridWindow& window);
/// @throws InputError  as ArchiveReader::next().
GridWindow next_window(ArchiveReader& archive);

class GridBackground : public Background {
 public:
  explicit GridBackground(GridWindow window);
  Sym3 at(const Vec3& p, Index& hint) const override { return metric_.at(p, hint); }
  std::vector<NodeValues> values(std::span<const Vec3> points) const override;

 private:
  GridWindow window_;
  GridMetricField metric_;
};

/// One background below a height, another one from there on.
class TwoBackgrounds : public Background {
 public:
  TwoBackgrounds(std::unique_ptr<Background> below, std::unique_ptr<Background> above,
                 double height)
      : below_(std::move(below)), above_(std::move(above)), height_(height) {}
  Sym3 at(const Vec3& p, Index& hint) const override;
  std::vector<NodeValues> values(std::span<const Vec3> points) const override;

 private:
  std::unique_ptr<Background> below_, above_;
  double height_;
};

}  // namespace mesamis::detail
