// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/multigrid.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "mesamis/base/parallel.h"

namespace mesamis::detail::fem {
namespace {

constexpr std::size_t kDirectSize = 400;  // small enough for a direct solve
constexpr std::size_t kMaxLevels = 20;
constexpr int kSweeps = 2;
constexpr double kStalled = 0.8;  // groups per unknown above which coarsening is given up
/// Piecewise constant groups are too stiff by about this factor: corrections are lengthened.
constexpr double kOvercorrection = 1.5;

using DirectSolver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

std::unique_ptr<DirectSolver> factorize(const SparseMatrix& a) {
  std::vector<Eigen::Triplet<double>> triplets;
  for (std::size_t i = 0; i < a.rows(); ++i) {
    for (std::int64_t e = a.row_start[i]; e < a.row_start[i + 1]; ++e) {
      const auto entry = static_cast<std::size_t>(e);
      triplets.emplace_back(static_cast<int>(i), a.columns[entry], a.values[entry]);
    }
  }
  const auto n = static_cast<Eigen::Index>(a.rows());
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return std::make_unique<DirectSolver>(matrix);
}

}  // namespace

struct Multigrid::Level {
  const SpdOperator* a = nullptr;
  std::unique_ptr<MatrixOperator> owned;  // what a points to, below the first level
  std::vector<double> inverse_l1;
  std::vector<Index> aggregate;
  std::unique_ptr<DirectSolver> direct;  // the last level only
  mutable std::vector<double> residual, coarse_r, coarse_z;
};

Multigrid::Multigrid(const SpdOperator& a) {
  levels_.push_back(std::make_unique<Level>());
  levels_.back()->a = &a;
  for (;;) {
    Level& fine = *levels_.back();
    const bool last = fine.a->size() <= kDirectSize || levels_.size() == kMaxLevels;
    if (last && fine.owned) {
      fine.direct = factorize(fine.owned->matrix());
      return;
    }
    fine.inverse_l1 = fine.a->absolute_row_sums();
    for (double& value : fine.inverse_l1) value = 1 / value;
    fine.aggregate = fine.a->aggregates();
    fine.residual.resize(fine.a->size());
    const Index count = 1 + *std::max_element(fine.aggregate.begin(), fine.aggregate.end());
    if (static_cast<double>(count) > kStalled * static_cast<double>(fine.a->size())) {
      fine.aggregate.clear();  // hardly coupled: the smoother alone solves this level
      return;
    }
    fine.coarse_r.resize(static_cast<std::size_t>(count));
    fine.coarse_z.resize(static_cast<std::size_t>(count));
    auto coarse = std::make_unique<Level>();
    coarse->owned = std::make_unique<MatrixOperator>(fine.a->coarsen(fine.aggregate, count));
    coarse->a = coarse->owned.get();
    levels_.push_back(std::move(coarse));
  }
}

Multigrid::~Multigrid() = default;

void Multigrid::apply(std::span<const double> r, std::span<double> z) const {
  std::fill(z.begin(), z.end(), 0.0);
  cycle(0, r, z);
}

void Multigrid::cycle(std::size_t level, std::span<const double> r, std::span<double> z) const {
  const Level& here = *levels_[level];
  if (here.direct) {
    const auto n = static_cast<Eigen::Index>(r.size());
    Eigen::Map<Eigen::VectorXd>(z.data(), n) =
        here.direct->solve(Eigen::Map<const Eigen::VectorXd>(r.data(), n));
    return;
  }
  auto smooth = [&] {
    here.a->apply(z, here.residual);
    parallel_for(z.size(),
                 [&](std::size_t i) { z[i] += here.inverse_l1[i] * (r[i] - here.residual[i]); });
  };
  auto correct = [&] {
    if (here.aggregate.empty()) return;
    here.a->apply(z, here.residual);
    std::fill(here.coarse_r.begin(), here.coarse_r.end(), 0.0);
    for (std::size_t i = 0; i < z.size(); ++i) {
      here.coarse_r[static_cast<std::size_t>(here.aggregate[i])] += r[i] - here.residual[i];
    }
    std::fill(here.coarse_z.begin(), here.coarse_z.end(), 0.0);
    cycle(level + 1, here.coarse_r, here.coarse_z);
    parallel_for(z.size(), [&](std::size_t i) {
      z[i] += kOvercorrection * here.coarse_z[static_cast<std::size_t>(here.aggregate[i])];
    });
  };
  for (int s = 0; s < kSweeps; ++s) smooth();
  correct();
  for (int s = 0; s < kSweeps; ++s) smooth();
  // The W of the cycle: cheap below the first level, where each is an eighth of the one above.
  if (level > 0) {
    correct();
    for (int s = 0; s < kSweeps; ++s) smooth();
  }
}

}  // namespace mesamis::detail::fem
