// SPDX-License-Identifier: Apache-2.0
// Example 1: adapt a mesh of a box to a metric of our own and look at it.
//
//   ex1_remesh [OUT.vtu]
//
// The metric asks for cells that are thin across a sphere and long along it. The headers of the
// remesher are not installed: this program is built in the source tree.
#include <cmath>
#include <cstdio>
#include <exception>

#include "mesamis/mesh/metric.h"
#include "mesamis/remesh/remesh.h"
#include "mesamis/shape_files/mesh_files.h"

using namespace mesamis;

// 1. A metric field answers for any point: here edges of 1 mm across the sphere of radius 30 mm
//    and of 8 mm along it, larger in proportion to the distance from it.
class SphereMetric : public MetricField {
 public:
  Sym3 at(const Vec3& p, Index&) const override {
    const double r = norm(p);
    const double away = std::abs(r - 30) / 4;
    const double across = 1 + away, along = 8 + away;
    const Vec3 n = r > 0 ? (1 / r) * p : Vec3{1, 0, 0};
    const Sym3 radial = outer(n);
    return 1 / (across * across) * radial + 1 / (along * along) * (kIdentity3 - radial);
  }
};

int main(int count, char** arguments) try {
  // 2. Start from a coarse mesh of the box.
  const TetMesh start = box_mesh({{-50, -50, -50}, {50, 50, 50}}, {4, 4, 4});

  // 3. Remesh: edges get length one in the metric.
  const SphereMetric metric;
  RemeshReport report;
  const TetMesh mesh = remesh(start, metric, {}, &report);

  // 4. Measure how well the mesh fits.
  std::vector<Sym3> metrics;
  MeshArray radius{"radius", 1, {}};
  Index hint = 0;
  for (const Vec3& p : mesh.points) {
    metrics.push_back(metric.at(p, hint));
    radius.values.push_back(norm(p));
  }
  const MeshFit fit = measure_fit(mesh, metrics);
  std::printf("%zu cells after %d rounds, %.1f %% unit edges, quality at least %.2f\n",
              mesh.cells.size(), report.rounds, 100 * fit.unit_edge_fraction, fit.quality_min);

  // 5. Write it, for ParaView or mesamis picture.
  write_vtu(count > 1 ? arguments[1] : "sphere.vtu", mesh, {.point_arrays = std::vector{radius}});
} catch (const std::exception& error) {
  std::fprintf(stderr, "ex1_remesh: %s\n", error.what());
  return 1;
}
