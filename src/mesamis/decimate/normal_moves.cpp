// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/normal_moves.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::decimate {
namespace {

/// Of the mean weight of a point.
constexpr double kPull = 0.02;

/// The normal equations: a block of the matrix for each triangle.
struct Equations {
  std::vector<std::array<double, 9>> blocks;
  Eigen::VectorXd right;
};

Equations equations(const MovableSurface& movable, std::span<const HeightSample> samples) {
  const auto& [surface, normals, stays] = movable;
  Equations all{std::vector<std::array<double, 9>>(surface.triangles.size()),
                Eigen::VectorXd::Zero(static_cast<Eigen::Index>(surface.points.size()))};
  for (const HeightSample& s : samples) {
    if (s.triangle == kNoIndex) continue;
    const Triangle& k = surface.triangles[s.triangle];
    const Vec3 up = unit_normal(corners_of(surface, k));
    auto& block = all.blocks[static_cast<std::size_t>(s.triangle)];
    std::array<double, 3> row{};
    for (std::size_t a = 0; a < 3; ++a) row[a] = s.place[a] * dot(normals[k[a]], up);
    for (std::size_t a = 0; a < 3; ++a) {
      if (stays[k[a]] == 0) all.right[k[a]] += s.weight * row[a] * s.height;
      for (std::size_t b = 0; b < 3; ++b) block[3 * a + b] += s.weight * row[a] * row[b];
    }
  }
  return all;
}

/// The matrix, in which points that stay have an equation of their own.
Eigen::SparseMatrix<double> matrix_of(const MovableSurface& movable, const Equations& all) {
  const auto& [surface, normals, stays] = movable;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * all.blocks.size() + surface.points.size());
  double sum = 0;
  for (std::size_t t = 0; t < all.blocks.size(); ++t) {
    const Triangle& k = surface.triangles[t];
    for (std::size_t a = 0; a < 3; ++a) {
      sum += all.blocks[t][4 * a];
      for (std::size_t b = 0; b < 3; ++b) {
        if (stays[k[a]] != 0 || stays[k[b]] != 0) continue;
        entries.emplace_back(k[a], k[b], all.blocks[t][3 * a + b]);
      }
    }
  }
  const auto n = all.right.size();
  const double pull = kPull * sum / static_cast<double>(n);
  for (Eigen::Index p = 0; p < n; ++p) {
    entries.emplace_back(p, p, stays[static_cast<std::size_t>(p)] != 0 ? 1 : pull);
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

std::vector<double> normal_moves(const MovableSurface& movable,
                                 std::span<const HeightSample> samples) {
  const Equations all = equations(movable, samples);
  const Eigen::SparseMatrix<double> matrix = matrix_of(movable, all);
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setMaxIterations(60);
  solver.setTolerance(1e-3);
  solver.compute(matrix);
  const Eigen::VectorXd moves = solver.solve(all.right);
  return {moves.begin(), moves.end()};
}

}  // namespace mesamis::detail::decimate
