// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/estimator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fem/mesh_space.h"

namespace mesamis {
namespace {

struct CellGradients {
  double volume;
  Vec3 u, v, f;
};

void add(PatchSums& sums, double volume, const Vec3& gradient) {
  sums.volume += volume;
  sums.gradient += volume * gradient;
  sums.gradient_outer += volume * outer(gradient);
}

int shared_points(const Cell& a, const Cell& b) {
  int shared = 0;
  for (const Index p : a) {
    for (const Index q : b) shared += p == q;
  }
  return shared;
}

class MeshEstimator {
 public:
  MeshEstimator(const TetMesh& mesh, const AtParameters& parameters, std::span<const double> u,
                std::span<const double> v, std::span<const double> f)
      : mesh_(mesh),
        parameters_(parameters),
        u_(u),
        v_(v),
        f_(f),
        neighbors_(cell_neighbors(mesh)),
        around_(point_cells(mesh)),
        gradients_(mesh.cells.size()) {
    parallel_for(mesh.cells.size(), [&](std::size_t c) {
      const CellGeometry g = cell_geometry(mesh, static_cast<Index>(c));
      const Cell& k = mesh.cells[c];
      gradients_[c] = {g.volume, cell_gradient(g, k, u), cell_gradient(g, k, v),
                       cell_gradient(g, k, f)};
    });
  }

  CellEstimate at(Index c) const {
    PatchSums patch_u, patch_v;
    const Cell& k = mesh_.cells[c];
    for (const Index p : k) {
      for (const Index t : around_.of(p)) {
        // A cell that shares s vertices with K is met s times: each time it counts 1/s.
        const double part = gradients_[t].volume / shared_points(k, mesh_.cells[t]);
        add(patch_u, part, gradients_[t].u);
        add(patch_v, part, gradients_[t].v);
      }
    }
    return estimate_cell(data_of(c), parameters_, recovered_error(patch_u),
                         recovered_error(patch_v));
  }

 private:
  CellData data_of(Index c) const {
    const Cell& k = mesh_.cells[c];
    const std::array<Vec3, 4> p = cell_corners(mesh_, k);
    CellData data;
    data.volume = gradients_[c].volume;
    data.shape = cell_shape(p);
    data.grad_u = gradients_[c].u;
    data.grad_v = gradients_[c].v;
    data.grad_f = gradients_[c].f;
    for (std::size_t i = 0; i < 4; ++i) {
      data.u[i] = u_[k[i]];
      data.v[i] = v_[k[i]];
      data.f[i] = f_[k[i]];
      const auto& [a, b, d] = kCellFaces[i];
      const Vec3 doubled_normal = cross(p[b] - p[a], p[d] - p[a]);
      const double doubled_area = norm(doubled_normal);
      const Vec3 normal = (1 / doubled_area) * doubled_normal;
      data.face_area[i] = doubled_area / 2;
      data.jump_u[i] = jump(c, neighbors_[c][i], normal, &CellGradients::u);
      data.jump_v[i] = jump(c, neighbors_[c][i], normal, &CellGradients::v);
    }
    return data;
  }

  /// On the boundary twice the normal derivative: the face is shared by nobody.
  double jump(Index c, Index neighbor, const Vec3& normal, Vec3 CellGradients::*field) const {
    const Vec3& inside = gradients_[c].*field;
    if (neighbor == kNoIndex) return 2 * std::abs(dot(inside, normal));
    return std::abs(dot(inside - gradients_[neighbor].*field, normal));
  }

  const TetMesh& mesh_;
  const AtParameters& parameters_;
  std::span<const double> u_, v_, f_;
  std::vector<std::array<Index, 4>> neighbors_;
  PointCells around_;
  std::vector<CellGradients> gradients_;
};

void require_size(const char* name, std::size_t found, std::size_t expected) {
  if (found != expected) {
    throw InputError(std::string("estimate: ") + name + " has " + std::to_string(found) +
                     " values for " + std::to_string(expected) + " nodes");
  }
}

}  // namespace

Estimate estimate(const TetMesh& mesh, const AtParameters& parameters, std::span<const double> u,
                  std::span<const double> v, std::span<const double> f) {
  require_size("u", u.size(), mesh.points.size());
  require_size("v", v.size(), mesh.points.size());
  require_size("f", f.size(), mesh.points.size());
  const MeshEstimator estimator(mesh, parameters, u, v, f);
  const std::size_t n = mesh.cells.size();
  Estimate result;
  result.gamma.resize(n);
  result.zeta.resize(n);
  // Sums in blocks, so that the order never depends on threads.
  std::vector<EstimateSums> blocks((n + kBlock - 1) / kBlock);
  parallel_blocks(n, kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const CellEstimate e = estimator.at(static_cast<Index>(c));
      result.gamma[c] = e.gamma;
      result.zeta[c] = e.zeta_a + e.zeta_b;
      blocks[begin / kBlock].add(e);
    }
  });
  for (const EstimateSums& block : blocks) result.sums.add(block);
  return result;
}

}  // namespace mesamis
