// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/estimator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesamis/adapt/paired_gradients.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fem/mesh_space.h"

namespace mesamis {
namespace {

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
        volumes_(mesh.cells.size()),
        gradients_(mesh.cells.size()) {
    parallel_for(mesh.cells.size(), [&](std::size_t c) {
      const CellGeometry g = cell_geometry(mesh, static_cast<Index>(c));
      const Cell& k = mesh.cells[c];
      volumes_[c] = g.volume;
      gradients_[c] = {cell_gradient(g, k, u), cell_gradient(g, k, v)};
    });
  }

  CellEstimate at(Index c) const {
    PairedSums patch;
    const Cell& k = mesh_.cells[c];
    for (const Index p : k) {
      for (const Index t : around_.of(p)) {
        // A cell that shares s vertices with K is met s times: each time it counts 1/s.
        patch.add(gradients_[t], volumes_[t] / shared_points(k, mesh_.cells[t]));
      }
    }
    return estimate_cell(data_of(c), parameters_, recovered_error(patch.of_u()),
                         recovered_error(patch.of_v()));
  }

 private:
  CellData data_of(Index c) const {
    const Cell& k = mesh_.cells[c];
    const std::array<Vec3, 4> p = cell_corners(mesh_, k);
    CellData data;
    data.volume = volumes_[c];
    data.shape = cell_shape(p);
    data.grad_u = gradients_[c].u();
    data.grad_v = gradients_[c].v();
    data.grad_f = cell_gradient(cell_geometry(mesh_, c), k, f_);
    for (std::size_t i = 0; i < 4; ++i) {
      data.u[i] = u_[k[i]];
      data.v[i] = v_[k[i]];
      data.f[i] = f_[k[i]];
      const auto& [a, b, d] = kCellFaces[i];
      const Vec3 doubled_normal = cross(p[b] - p[a], p[d] - p[a]);
      const double doubled_area = norm(doubled_normal);
      const Vec3 normal = (1 / doubled_area) * doubled_normal;
      data.face_area[i] = doubled_area / 2;
      // On the boundary twice the normal derivative: the face is shared by nobody.
      const Index beyond = neighbors_[c][i];
      const Vec3 other_u = beyond == kNoIndex ? -data.grad_u : gradients_[beyond].u();
      const Vec3 other_v = beyond == kNoIndex ? -data.grad_v : gradients_[beyond].v();
      data.jump_u[i] = std::abs(dot(data.grad_u - other_u, normal));
      data.jump_v[i] = std::abs(dot(data.grad_v - other_v, normal));
    }
    return data;
  }

  const TetMesh& mesh_;
  const AtParameters& parameters_;
  std::span<const double> u_, v_, f_;
  std::vector<std::array<Index, 4>> neighbors_;
  PointCells around_;
  std::vector<double> volumes_;
  std::vector<PairedGradients> gradients_;
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
