// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "mesamis/fem/p1_space.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis::detail::fem {

/// A cell's volume and the constant gradients of its four hat functions.
struct CellGeometry {
  double volume;
  std::array<Vec3, 4> gradients;
};

/// Computes the geometry of one cell.
/// @param cell  the index of a cell of positive volume.
/// @return volume in u^3, gradients in 1 / u for the unit of length u of the mesh.
CellGeometry cell_geometry(const TetMesh& mesh, Index cell);

/// Computes the constant gradient of u on a cell.
/// @param geometry  of that cell.
/// @param u         one value per node of the mesh, any unit.
/// @return in the unit of u per unit of length of the mesh.
Vec3 cell_gradient(const CellGeometry& geometry, const Cell& cell, std::span<const double> u);

/// P1 functions on a tetrahedral mesh. Keeps six stiffness weights per cell, so that each new
/// coefficient costs one pass over them.
class MeshSpace : public P1Space {
 public:
  /// Computes the matrices' graph, the stiffness weights and the lumped mass.
  /// @param mesh  n nodes, m cells of positive volume. The space refers to it: the mesh must live
  ///              longer.
  ///
  /// O(m), in parallel.
  explicit MeshSpace(const TetMesh& mesh);

  /// The mesh referred to.
  const TetMesh& mesh() const noexcept { return mesh_; }
  const std::vector<double>& lumped_mass() const override { return lumped_mass_; }
  std::unique_ptr<SpdOperator> diffusion(std::span<const double> w, double scale, double offset,
                                         std::vector<double> diagonal) const override;
  std::vector<double> gradient_squares(std::span<const double> u) const override;

  /// Assembles the consistent mass matrix: |K|/20 (1 + delta_ij) summed over the cells, in the cube
  /// of the unit of length of the mesh.
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

}  // namespace mesamis::detail::fem
