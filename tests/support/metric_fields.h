// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/base/sym3.h"
#include "mesamis/mesh/metric_field.h"
#include "mesamis/mesh/tet_mesh.h"

/// Metric fields given by formulas, for tests and benchmarks.
namespace mesamis {

/// Any function of space as a metric field.
class FormulaMetric : public MetricField {
 public:
  explicit FormulaMetric(std::function<Sym3(const Vec3&)> formula) : formula_(std::move(formula)) {}
  Sym3 at(const Vec3& p, Index&) const override { return formula_(p); }

 private:
  std::function<Sym3(const Vec3&)> formula_;
};

inline FormulaMetric uniform_metric(double size) {
  return FormulaMetric([size](const Vec3&) { return 1 / (size * size) * kIdentity3; });
}

/// The cubes of the UGAWG adaptation benchmarks on [0, 1]^3: a flat layer, a curved one, and a
/// curved one that is finer along the arc too.
enum class Ugawg { kLinear, kPolar1, kPolar2 };

/// Size across the layer, `distance` from its middle.
inline double ugawg_layer_size(double distance) { return 1e-3 + 2 * (0.1 - 1e-3) * distance; }

inline Sym3 ugawg_polar(const Vec3& p, bool finer_arc, double scale) {
  const double r = std::hypot(p.x, p.y);
  const Vec3 radial = r > 1e-14 ? Vec3{p.x / r, p.y / r, 0} : Vec3{1, 0, 0};
  const Vec3 tangent{-radial.y, radial.x, 0};
  const double h_radial = ugawg_layer_size(std::abs(r - 0.5));
  const double blend = std::min(10 * std::abs(r - 0.5), 1.0);
  const double h_tangent = finer_arc ? 0.1 * blend + 0.025 * (1 - blend) : 0.1;
  const double s2 = scale * scale;
  return (s2 / (h_radial * h_radial)) * outer(radial) +
         (s2 / (h_tangent * h_tangent)) * outer(tangent) + (100 * s2) * outer(Vec3{0, 0, 1});
}

/// @param scale  sizes are divided by it.
inline FormulaMetric ugawg_metric(Ugawg which, double scale) {
  if (which == Ugawg::kLinear) {
    return FormulaMetric([scale](const Vec3& p) {
      const double hz = ugawg_layer_size(std::abs(p.z - 0.5)) / scale;
      const double hx = 0.1 / scale;
      return Sym3{1 / (hx * hx), 0, 0, 1 / (hx * hx), 0, 1 / (hz * hz)};
    });
  }
  const bool finer_arc = which == Ugawg::kPolar2;
  return FormulaMetric([=](const Vec3& p) { return ugawg_polar(p, finer_arc, scale); });
}

/// The scale that makes about this many cells.
inline double ugawg_scale(Ugawg which, double cells) {
  // Where the metric turns within an edge, more cells are needed.
  const double polar1 = cells < 500'000 ? 12 : 10;
  const double complexity[]{4668, 3837, 7620}, cells_per_unit[]{8.5, polar1, 8.9};
  const auto i = static_cast<std::size_t>(which);
  return std::cbrt(cells / (complexity[i] * cells_per_unit[i]));
}

inline const Box kUnitBox{{0, 0, 0}, {1, 1, 1}};

/// Integral of sqrt(det M) over a box by the midpoint rule, n[axis] points along each axis.
inline double integrated_complexity(const MetricField& field, const Box& box,
                                    const std::array<Index, 3>& n) {
  const Vec3 extent = box.extent();
  const auto rows = static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]);
  const double sum = parallel_sum(rows, [&](std::size_t begin, std::size_t end) {
    double roots = 0;
    Index hint = 0;
    for (std::size_t row = begin; row < end; ++row) {
      const auto j = static_cast<double>(row % static_cast<std::size_t>(n[1]));
      const auto k = static_cast<double>(row / static_cast<std::size_t>(n[1]));
      for (Index i = 0; i < n[0]; ++i) {
        const Vec3 p{box.lo.x + extent.x * (i + 0.5) / n[0], box.lo.y + extent.y * (j + 0.5) / n[1],
                     box.lo.z + extent.z * (k + 0.5) / n[2]};
        roots += std::sqrt(determinant(field.at(p, hint)));
      }
    }
    return roots;
  });
  return sum * box.volume() / (static_cast<double>(n[0]) * static_cast<double>(rows));
}

inline std::vector<Sym3> metrics_at_nodes(const TetMesh& mesh, const MetricField& field) {
  std::vector<Sym3> metrics;
  metrics.reserve(mesh.points.size());
  Index hint = 0;
  for (const Vec3& p : mesh.points) metrics.push_back(field.at(p, hint));
  return metrics;
}

/// FNV-1a over the mesh's bytes.
inline std::uint64_t mesh_hash(const TetMesh& mesh) {
  std::uint64_t hash = 14695981039346656037u;
  auto add = [&hash](const void* data, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      hash = (hash ^ static_cast<const unsigned char*>(data)[i]) * 1099511628211u;
    }
  };
  add(mesh.points.data(), mesh.points.size() * sizeof(Vec3));
  add(mesh.cells.data(), mesh.cells.size() * sizeof(Cell));
  return hash;
}

}  // namespace mesamis
