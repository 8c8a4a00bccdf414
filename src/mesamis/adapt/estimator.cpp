// SPDX-License-Identifier: Apache-2.0
#include "mesamis/adapt/estimator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesamis/adapt/paired_gradients.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fem/mesh_space.h"

namespace mesamis::detail::adapt {
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
  MeshEstimator(const TetMesh& mesh, const AtParameters& parameters, const AtFields& fields)
      : mesh_(mesh),
        parameters_(parameters),
        fields_(fields),
        neighbors_(cell_neighbors(mesh)),
        around_(point_cells(mesh)),
        volumes_(mesh.cells.size()),
        gradients_(mesh.cells.size()),
        gradients_f_(mesh.cells.size()) {
    parallel_for(mesh.cells.size(), [&](std::size_t c) {
      const CellGeometry g = cell_geometry(mesh, static_cast<Index>(c));
      const Cell& k = mesh.cells[c];
      volumes_[c] = g.volume;
      gradients_[c] = {cell_gradient(g, k, fields_.u), cell_gradient(g, k, fields_.v)};
      gradients_f_[c] = cell_gradient(g, k, fields_.f);
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
    data.grad_f = gradients_f_[c];
    for (std::size_t i = 0; i < 4; ++i) {
      data.u[i] = fields_.u[k[i]];
      data.v[i] = fields_.v[k[i]];
      data.f[i] = fields_.f[k[i]];
      const auto& [a, b, d] = kCellFaces[i];
      const Vec3 doubled_normal = cross(p[b] - p[a], p[d] - p[a]);
      const double doubled_area = norm(doubled_normal);
      const Vec3 normal = (1 / doubled_area) * doubled_normal;
      data.face_area[i] = doubled_area / 2;
      const Index beyond = neighbors_[c][i];
      set_jumps(i, normal, beyond == kNoIndex ? nullptr : &gradients_[beyond], data);
    }
    return data;
  }

  const TetMesh& mesh_;
  const AtParameters& parameters_;
  AtFields fields_;
  std::vector<std::array<Index, 4>> neighbors_;
  PointCells around_;
  std::vector<double> volumes_;
  std::vector<PairedGradients> gradients_;
  std::vector<Vec3> gradients_f_;
};

void require_size(const char* name, std::size_t found, std::size_t expected) {
  if (found != expected) {
    throw InputError(std::string("estimate: ") + name + " has " + std::to_string(found) +
                     " values for " + std::to_string(expected) + " nodes");
  }
}

}  // namespace

Estimate estimate(const TetMesh& mesh, const AtParameters& parameters, const AtFields& fields) {
  require_size("u", fields.u.size(), mesh.points.size());
  require_size("v", fields.v.size(), mesh.points.size());
  require_size("f", fields.f.size(), mesh.points.size());
  const MeshEstimator estimator(mesh, parameters, fields);
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

}  // namespace mesamis::detail::adapt
