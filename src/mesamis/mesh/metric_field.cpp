// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/metric_field.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/sym3.h"
#include "mesamis/mesh/metric.h"

namespace mesamis::detail::mesh {
namespace {

void require_count(std::size_t nodes, std::size_t metrics) {
  if (nodes != metrics) {
    throw InputError("metric: expected one per node (" + std::to_string(nodes) + "), found " +
                     std::to_string(metrics));
  }
}

}  // namespace

GridMetricField::GridMetricField(const Box& box, const std::array<Index, 3>& size,
                                 std::vector<std::array<float, 6>> log_metrics)
    : box_(box), size_(size), log_metrics_(std::move(log_metrics)) {
  if (*std::min_element(size.begin(), size.end()) < 2) {
    throw InputError("metric grid: at least 2 nodes per direction are needed");
  }
  require_count(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
                    static_cast<std::size_t>(size[2]),
                log_metrics_.size());
  for (std::size_t n = 0; n < log_metrics_.size(); ++n) {
    for (const float entry : log_metrics_[n]) {
      if (std::isfinite(entry)) continue;
      throw InputError("metric: node " + std::to_string(n) + " (the first is 0) is not finite");
    }
  }
}

Sym3 GridMetricField::at(const Vec3& p, Index&) const {
  std::array<std::size_t, 3> base{};
  std::array<double, 3> t{};
  for (int axis = 0; axis < 3; ++axis) {
    const double u =
        (p[axis] - box_.lo[axis]) / (box_.hi[axis] - box_.lo[axis]) * (size_[axis] - 1);
    const double cell = std::clamp(std::floor(u), 0.0, static_cast<double>(size_[axis] - 2));
    base[axis] = static_cast<std::size_t>(cell);
    t[axis] = std::clamp(u - cell, 0.0, 1.0);
  }
  std::array<double, 6> sum{};
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t dx = corner & 1, dy = (corner >> 1) & 1, dz = corner >> 2;
    const double w = (dx ? t[0] : 1 - t[0]) * (dy ? t[1] : 1 - t[1]) * (dz ? t[2] : 1 - t[2]);
    const std::size_t node = ((base[2] + dz) * static_cast<std::size_t>(size_[1]) + base[1] + dy) *
                                 static_cast<std::size_t>(size_[0]) +
                             base[0] + dx;
    for (std::size_t c = 0; c < 6; ++c) sum[c] += w * log_metrics_[node][c];
  }
  return exp_sym({sum[0], sum[1], sum[2], sum[3], sum[4], sum[5]});
}

MeshMetricField::MeshMetricField(TetMesh mesh, std::span<const Sym3> node_metrics,
                                 MeshExtent extent)
    : mesh_(std::move(mesh)),
      extent_(extent),
      box_(bounding_box(mesh_.points)),
      neighbors_(cell_neighbors(mesh_)) {
  require_count(mesh_.points.size(), node_metrics.size());
  require_positive_definite(node_metrics);
  log_metrics_.resize(node_metrics.size());
  parallel_for(node_metrics.size(),
               [&](std::size_t n) { log_metrics_[n] = log_spd(node_metrics[n]); });
}

Sym3 MeshMetricField::at(const Vec3& p, Index& hint) const {
  Vec3 inside;
  for (int axis = 0; axis < 3; ++axis) {
    inside[axis] = std::clamp(p[axis], box_.lo[axis], box_.hi[axis]);
  }
  const Location where =
      (extent_ == MeshExtent::kBox ? locate : locate_in_piece)(mesh_, neighbors_, inside, hint);
  hint = where.cell;
  Sym3 sum;
  const Cell& cell = mesh_.cells[static_cast<std::size_t>(where.cell)];
  for (int i = 0; i < 4; ++i) sum += where.weights[i] * log_metrics_[cell[i]];
  return exp_sym(sum);
}

std::vector<Sym3> sample(const MetricField& field, std::span<const Vec3> points) {
  std::vector<Sym3> metrics(points.size());
  parallel_blocks(points.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    Index hint = 0;
    for (std::size_t n = begin; n < end; ++n) metrics[n] = field.at(points[n], hint);
  });
  return metrics;
}

}  // namespace mesamis::detail::mesh
