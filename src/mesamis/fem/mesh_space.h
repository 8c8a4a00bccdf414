// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "mesamis/fem/p1_space.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {

/// A cell's volume and the constant gradients of its four hat functions.
struct CellGeometry {
  double volume;
  std::array<Vec3, 4> gradients;
};
CellGeometry cell_geometry(const TetMesh& mesh, Index cell);

/// Constant gradient of u on a cell.
Vec3 cell_gradient(const CellGeometry& geometry, const Cell& cell, std::span<const double> u);

/// P1 functions on a tetrahedral mesh. Keeps six stiffness weights per cell, so that each new
/// coefficient costs one pass over them.
class MeshSpace : public P1Space {
 public:
  /// @param mesh  refers to it; it must live on. Cells of positive volume.
  explicit MeshSpace(const TetMesh& mesh);

  const TetMesh& mesh() const { return mesh_; }
  const std::vector<double>& lumped_mass() const override { return lumped_mass_; }
  std::unique_ptr<SpdOperator> diffusion(std::span<const double> w, double scale, double offset,
                                         std::vector<double> diagonal) const override;
  std::vector<double> gradient_squares(std::span<const double> u) const override;

  /// The consistent mass matrix: |K|/20 (1 + delta_ij) summed over the cells.
  MatrixOperator consistent_mass() const;

 private:
  void find_corners();

  /// Sums per-cell edge values (kCellEdges order) into a matrix of the mesh's graph, plus a
  /// diagonal. `edge_value(cell, edge)` is the off-diagonal entry; with `zero_row_sums` the
  /// diagonal gets minus the off-diagonal sum.
  template <class EdgeValue>
  SparseMatrix assemble(EdgeValue&& edge_value, std::vector<double> diagonal,
                        bool zero_row_sums) const;

  /// One corner of a cell: which, and where the others stand in its row, in their order.
  struct Corner {
    Index local;
    std::array<Index, 3> places;
  };

  const TetMesh& mesh_;
  PointCells point_cells_;
  std::vector<std::int64_t> row_start_;
  std::vector<Index> columns_;
  std::vector<Corner> corners_;  // for each entry of point_cells_
  std::vector<double> volumes_;
  std::vector<std::array<double, 6>> edge_weights_;  // |K| grad phi_i . grad phi_j
  std::vector<double> lumped_mass_;
};

}  // namespace mesamis
