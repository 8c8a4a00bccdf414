// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesamis/mesh/predicates.h"
#include "mesamis/remesh/working_mesh.h"

/// Lengths and qualities in the metric, as every operation measures them.
namespace mesamis::detail::remesh {

/// A metric's factor in double precision, converted once for many uses.
struct Factor {
  double xx, yx, zx, yy, zy, zz;
};
inline Factor widen(const MetricFactor& l) { return {l.xx, l.yx, l.zx, l.yy, l.zy, l.zz}; }

/// L^T v: the vector as the metric sees it.
template <class AnyFactor>
Vec3 in_metric(const AnyFactor& l, const Vec3& v) {
  return {l.xx * v.x + l.yx * v.y + l.zx * v.z, l.yy * v.y + l.zy * v.z, l.zz * v.z};
}

/// L v: with in_metric(L, u) for v it is M u.
inline Vec3 from_metric(const MetricFactor& l, const Vec3& v) {
  return {l.xx * v.x, l.yx * v.x + l.yy * v.y, l.zx * v.x + l.zy * v.y + l.zz * v.z};
}

/// L^-T v: the way back from in_metric.
inline Vec3 out_of_metric(const MetricFactor& l, const Vec3& v) {
  const double z = v.z / l.zz;
  const double y = (v.y - l.zy * z) / l.yy;
  return {(v.x - l.yx * y - l.zx * z) / l.xx, y, z};
}

/// M^-1 v
inline Vec3 solve_metric(const MetricFactor& l, const Vec3& v) {
  const double x = v.x / l.xx;
  const double y = (v.y - l.yx * x) / l.yy;
  return out_of_metric(l, {x, y, (v.z - l.zx * x - l.zy * y) / l.zz});
}

inline double squared_length(const MetricFactor& l, const Vec3& e) {
  const Vec3 v = in_metric(l, e);
  return dot(v, v);
}

/// Length of the edge between two vertices: the logarithmic mean of its lengths in both
/// metrics, taken as (2 G + A) / 3 of their geometric and arithmetic means.
inline double length(const Vertex& a, const Vertex& b) {
  const Vec3 e = b.position - a.position;
  const double la2 = squared_length(a.metric, e), lb2 = squared_length(b.metric, e);
  const double arithmetic = 0.5 * (std::sqrt(la2) + std::sqrt(lb2));
  return (2 * std::sqrt(std::sqrt(la2 * lb2)) + arithmetic) / 3;
}

/// Cube of the mean ratio of a cell in the metric with factor L: 432 d^2 det M / S^3 with d six
/// times the volume and S the sum of the squared edge lengths; no roots are needed. 1 for a regular
/// cell.
/// @param edges  the three from one corner.
inline double quality3(const Factor& l, const std::array<Vec3, 3>& edges, double six_volume) {
  const Vec3 mp = in_metric(l, edges[0]), mq = in_metric(l, edges[1]), mr = in_metric(l, edges[2]);
  const Vec3 sum = mp + mq + mr;
  const double squares = 4 * (dot(mp, mp) + dot(mq, mq) + dot(mr, mr)) - dot(sum, sum);
  const double metric_volume = six_volume * (l.xx * l.yy * l.zz);
  return 432 * metric_volume * metric_volume / (squares * squares * squares);
}

/// The cube in the metric of the finest corner; 0 for a cell that is not certified positive.
inline double quality3(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) {
  const double six_volume = certified_six_volume(a.position, b.position, c.position, d.position);
  if (six_volume <= 0) return 0;
  const Vertex* finest = &a;
  for (const Vertex* other : {&b, &c, &d}) {
    if (other->density > finest->density) finest = other;
  }
  return quality3(widen(finest->metric),
                  {b.position - a.position, c.position - a.position, d.position - a.position},
                  six_volume);
}

inline double quality3(const WorkingMesh& mesh, const Cell& cell) {
  return quality3(mesh.vertices[cell[0]], mesh.vertices[cell[1]], mesh.vertices[cell[2]],
                  mesh.vertices[cell[3]]);
}

/// Sets the metric of a vertex at its position; the look-up starts from the hint.
inline void measure(Vertex& vertex, const MetricSampler& sampler, Index hint) {
  vertex.hint = hint;
  vertex.metric = sampler.at(vertex.position, vertex.hint);
  vertex.density = static_cast<float>(
      std::min(density(vertex.metric), double{std::numeric_limits<float>::max()}));
}

/// Cells below this are not made by swaps and moves: their energy would drown all others.
inline constexpr double kTinyQuality3 = 1e-30;

/// The energy of a cell, whose sum swaps and moves lower: 0 for a regular cell.
inline double energy(double quality3) { return 1 / std::max(quality3, kTinyQuality3) - 1; }

}  // namespace mesamis::detail::remesh
