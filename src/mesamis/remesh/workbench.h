// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mesamis/remesh/ball_shape.h"
#include "mesamis/remesh/cavity.h"
#include "mesamis/remesh/metric_sampler.h"
#include "mesamis/remesh/working_mesh.h"

namespace mesamis::detail::remesh {

/// A set of vertices that is cleared in
class VertexSet {
 public:
  void clear() { ++epoch_; }
  /// @return false if v is in the set already.
  bool insert(Index v) {
    const auto i = static_cast<std::size_t>(v);
    if (i >= epochs_.size()) epochs_.resize(i + i / 2 + 64, 0);
    if (epochs_[i] == epoch_) return false;
    epochs_[i] = epoch_;
    return true;
  }

 private:
  std::vector<std::uint64_t> epochs_;
  std::uint64_t epoch_ = 1;
};

/// The mesh, the metric and the scratch memory that all operations share.
struct Workbench {
  Workbench(WorkingMesh& m, const MetricSampler& s) : mesh(m), sampler(s), cavity(m) {}
  WorkingMesh& mesh;
  const MetricSampler& sampler;
  Cavity cavity;
  VertexSet seen, met;
  std::vector<Index> other_ball;
  BallShape shape;
};

}  // namespace mesamis::detail::remesh
