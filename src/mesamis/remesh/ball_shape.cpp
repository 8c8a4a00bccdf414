// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/ball_shape.h"

#include <algorithm>
#include <cmath>

#include "mesamis/remesh/geometry.h"

namespace mesamis::detail::remesh {
namespace {

/// Sums over the cells of one lane.
template <class Lanes>
struct LaneSums {
  Lanes ideal_x{}, ideal_y{}, ideal_z{}, weight{}, gradient_x{}, gradient_y{}, gradient_z{};
};

double total(const auto& lanes) {
  double sum = 0;
  for (const double value : lanes) sum += value;
  return sum;
}

}  // namespace

void BallShape::set_lane(std::size_t cell, const WorkingMesh& mesh, Index cell_index,
                         Index vertex) {
  Block& block = blocks_[cell / kLanes];
  const std::size_t lane = cell % kLanes;
  const WorkCell& k = mesh.cells[cell_index];
  const auto& face = kCellFaces[local_index(k.points, vertex)];
  const Vertex &a = mesh.vertices[k.points[face[0]]], &b = mesh.vertices[k.points[face[1]]],
               &c = mesh.vertices[k.points[face[2]]];
  block.a.set(lane, a.position);
  block.b.set(lane, b.position);
  block.c.set(lane, c.position);
  const Vertex& finer = a.density >= b.density ? a : b;
  const Vertex& finest = finer.density >= c.density ? finer : c;
  const MetricFactor& l = finest.metric;
  block.xx[lane] = l.xx;
  block.yx[lane] = l.yx;
  block.zx[lane] = l.zx;
  block.yy[lane] = l.yy;
  block.zy[lane] = l.zy;
  block.zz[lane] = l.zz;
  block.density[lane] = finest.density;
  block.quality3[lane] = k.quality3;
  block.used[lane] = 1;
}

void BallShape::gather(const WorkingMesh& mesh, std::span<const Index> ball, Index vertex) {
  size_ = ball.size();
  const std::size_t padded = (size_ + kLanes - 1) / kLanes * kLanes;
  if (blocks_.size() * kLanes < padded) blocks_.resize(padded / kLanes);
  if (qualities_.size() < padded) qualities_.resize(padded);
  for (std::size_t i = 0; i < size_; ++i) set_lane(i, mesh, ball[i], vertex);
  for (std::size_t i = size_; i < padded; ++i) {
    set_lane(i, mesh, ball[size_ - 1], vertex);
    blocks_[i / kLanes].used[i % kLanes] = 0;
  }
}

// All in coordinates in which the vertex's metric is the identity. With the height of a unit
// regular cell, kHeight, a cell is regular if the vertex lies above the middle of the opposite
// face.
BallShape::Directions BallShape::directions(const Vertex& vertex) const {
  constexpr double kHeight = 0.81649658092772603;  // sqrt(2 / 3)
  const Factor l = widen(vertex.metric);
  LaneSums<Lanes> sums;
  for (std::size_t n = 0; n * kLanes < size_; ++n) {
    const Block& k = blocks_[n];
    for (std::size_t i = 0; i < kLanes; ++i) {
      const Vec3 a = in_metric(l, k.a[i] - vertex.position);
      const Vec3 b = in_metric(l, k.b[i] - vertex.position);
      const Vec3 c = in_metric(l, k.c[i] - vertex.position);
      const Vec3 sum = a + b + c, normal = cross(c - a, b - a);
      const double squares = 4 * (dot(a, a) + dot(b, b) + dot(c, c)) - dot(sum, sum);
      const double weight = k.used[i] / std::max(std::sqrt(k.quality3[i]), 1e-4);
      const Vec3 ideal = weight * ((1.0 / 3) * sum + kHeight / norm(normal) * normal);
      sums.weight[i] += weight;
      sums.ideal_x[i] += ideal.x;
      sums.ideal_y[i] += ideal.y;
      sums.ideal_z[i] += ideal.z;
      // The energy is const * squares^3 / volume^2: its logarithmic derivative.
      const double value = k.used[i] / std::max(k.quality3[i], kTinyQuality3);
      const Vec3 gradient = value * (-6 / squares * sum + 2 / dot(normal, a) * normal);
      sums.gradient_x[i] += gradient.x;
      sums.gradient_y[i] += gradient.y;
      sums.gradient_z[i] += gradient.z;
    }
  }
  const Vec3 ideal{total(sums.ideal_x), total(sums.ideal_y), total(sums.ideal_z)};
  const Vec3 gradient{total(sums.gradient_x), total(sums.gradient_y), total(sums.gradient_z)};
  return {out_of_metric(vertex.metric, 1 / total(sums.weight) * ideal),
          from_metric(vertex.metric, gradient)};
}

std::span<const double> BallShape::qualities(const Vertex& vertex) {
  const Factor m = widen(vertex.metric);
  const double own_density = vertex.density;
  for (std::size_t n = 0; n * kLanes < size_; ++n) {
    const Block& k = blocks_[n];
    Lanes result;
    for (std::size_t i = 0; i < kLanes; ++i) {
      // Chosen by weights: with a branch the compiler would not compute lanes together.
      const double own = own_density >= k.density[i] ? 1 : 0, other = 1 - own;
      const Factor l{own * m.xx + other * k.xx[i], own * m.yx + other * k.yx[i],
                     own * m.zx + other * k.zx[i], own * m.yy + other * k.yy[i],
                     own * m.zy + other * k.zy[i], own * m.zz + other * k.zz[i]};
      const Vec3 p = k.a[i] - vertex.position, q = k.b[i] - vertex.position,
                 r = k.c[i] - vertex.position;
      result[i] = quality3(l, {p, q, r}, certified_in_any_order(p, q, r));
    }
    std::copy(result.begin(), result.end(),
              qualities_.begin() + static_cast<std::ptrdiff_t>(n * kLanes));
  }
  return {qualities_.data(), size_};
}

}  // namespace mesamis::detail::remesh
