// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/locate.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <unordered_set>
#include <vector>

namespace mesamis::detail::mesh {
namespace {

/// A point this far outside a face, relative to the cell, still counts as inside: round-off.
constexpr double kTolerance = 1e-12;

std::array<double, 4> barycentric(const TetMesh& mesh, Index cell, const Vec3& p) {
  const std::array<Vec3, 4> x = cell_corners(mesh, mesh.cells[static_cast<std::size_t>(cell)]);
  std::array<double, 4> w{six_volume(p, x[1], x[2], x[3]), six_volume(x[0], p, x[2], x[3]),
                          six_volume(x[0], x[1], p, x[3]), six_volume(x[0], x[1], x[2], p)};
  const double sum = w[0] + w[1] + w[2] + w[3];
  for (double& value : w) value /= sum;
  return w;
}

Location clamped(Index cell, std::array<double, 4> w) {
  double sum = 0;
  for (double& value : w) {
    value = std::max(value, 0.0);
    sum += value;
  }
  for (double& value : w) value /= sum;
  return {cell, w};
}

/// Tries cells; the one whose worst barycentric coordinate is largest wins.
class Trial {
 public:
  Trial(const TetMesh& mesh, const Vec3& p) : mesh_(mesh), p_(p) {}
  void cell(Index c) {
    const auto w = barycentric(mesh_, c, p_);
    const double worst = *std::min_element(w.begin(), w.end());
    if (worst <= worst_) return;
    best_ = c;
    weights_ = w;
    worst_ = worst;
  }
  bool is_inside() const { return worst_ >= -kTolerance; }
  Location best() const { return clamped(best_, weights_); }

 private:
  const TetMesh& mesh_;
  const Vec3& p_;
  Index best_ = 0;
  std::array<double, 4> weights_{};
  double worst_ = -std::numeric_limits<double>::infinity();
};

Location locate_exhaustively(const TetMesh& mesh, const Vec3& p) {
  Trial trial(mesh, p);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) trial.cell(static_cast<Index>(c));
  return trial.best();
}

/// Tries the cells around one, ring by ring, until one holds the point or enough were tried.
Trial try_around(const TetMesh& mesh, std::span<const std::array<Index, 4>> neighbors,
                 const Vec3& p, Index from) {
  constexpr std::size_t kMost = 1000;
  Trial trial(mesh, p);
  std::vector<Index> cells{from};
  std::unordered_set<Index> known{from};
  for (std::size_t i = 0; i < cells.size() && !trial.is_inside(); ++i) {
    trial.cell(cells[i]);
    for (const Index n : neighbors[cells[i]]) {
      if (n == kNoIndex || cells.size() == kMost || !known.insert(n).second) continue;
      cells.push_back(n);
    }
  }
  return trial;
}

/// Where a walk has ended: in the cell that holds the point, or not.
struct Walk {
  Index cell = kNoIndex;
  std::optional<Location> found{};
};

Walk walk(const TetMesh& mesh, std::span<const std::array<Index, 4>> neighbors, const Vec3& p,
          Index start) {
  // A walk through the worst face can circle on a mesh that is not Delaunay. After a while the
  // face is picked by a small generator instead, which leaves every circle sooner or later.
  constexpr int kSteadySteps = 200, kMaxSteps = 4000;
  Index cell = start;
  unsigned random = 12345;
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto w = barycentric(mesh, cell, p);
    int exit = -1;
    int candidates = 0;
    bool outside = false;
    for (int f = 0; f < 4; ++f) {
      if (w[f] >= -kTolerance) continue;
      outside = true;
      if (neighbors[cell][f] == kNoIndex) continue;
      ++candidates;
      random = random * 1664525u + 1013904223u;
      const bool steady = step < kSteadySteps;
      const bool take =
          exit < 0 ||
          (steady ? w[f] < w[exit] : (random >> 16) % static_cast<unsigned>(candidates) == 0);
      if (take) exit = f;
    }
    if (!outside) return {cell, clamped(cell, w)};
    if (exit < 0) break;  // behind the boundary only: outside the box, or a blind corner
    cell = neighbors[cell][exit];
  }
  return {cell};
}

}  // namespace

Location locate(const TetMesh& mesh, std::span<const std::array<Index, 4>> neighbors, const Vec3& p,
                Index start) {
  const Walk walked = walk(mesh, neighbors, p, start);
  if (walked.found) return *walked.found;
  const Trial around = try_around(mesh, neighbors, p, walked.cell);
  return around.is_inside() ? around.best() : locate_exhaustively(mesh, p);
}

Location locate_in_piece(const TetMesh& mesh, std::span<const std::array<Index, 4>> neighbors,
                         const Vec3& p, Index start) {
  const Walk walked = walk(mesh, neighbors, p, start);
  return walked.found ? *walked.found : try_around(mesh, neighbors, p, walked.cell).best();
}

}  // namespace mesamis::detail::mesh
