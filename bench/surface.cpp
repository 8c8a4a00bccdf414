// SPDX-License-Identifier: Apache-2.0
// What the surface room takes on one thread: a wavy solid on a box mesh, about a million triangles;
// and on all threads, what `mesamis compare` does with two surfaces of a million points or
// triangles.
//
//   bench_surface [N]     N^3 bricks of six cells; default 60, 1.3 million cells
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/axis_flip.h"
#include "mesamis/surface/components.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/extract.h"
#include "mesamis/surface/sampling.h"
#include "timed.h"

namespace {

using namespace mesamis;

double wave(const Vec3& p, double frequency) {
  return std::sin(frequency * p.x) * std::cos(frequency * p.y) +
         std::sin(frequency * p.y) * std::cos(frequency * p.z) +
         std::sin(frequency * p.z) * std::cos(frequency * p.x);
}

/// A bumpy ball of n by 2n quadrilaterals: 2 n (n + 1) points, 4 n^2 triangles. Those at the poles
/// have no area.
TriMesh bumpy_ball(Index n, double radius) {
  const double step = std::acos(-1.0) / n;
  TriMesh ball;
  for (Index i = 0; i <= n; ++i) {
    for (Index j = 0; j < 2 * n; ++j) {
      const double a = step * i, b = step * j;
      const Vec3 out{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
      ball.points.push_back((radius + wave(out, 20)) * out);
      if (i == n) continue;
      const Index p = 2 * n * i + j, q = 2 * n * i + (j + 1) % (2 * n);
      ball.triangles.push_back({p, p + 2 * n, q});
      ball.triangles.push_back({q, p + 2 * n, q + 2 * n});
    }
  }
  return ball;
}

/// A million points of one surface against a million triangles of another, both a human head's
/// size.
void compare_surfaces() {
  const TriMesh reference = bumpy_ball(500, 100), surface = bumpy_ball(707, 100.5);
  std::printf("%zu vertices against %zu triangles, all threads\n", surface.points.size(),
              reference.triangles.size());
  timed("distances of vertices", [&] { return distances_to_surface(surface.points, reference); });
  timed("and of those in the other direction",
        [&] { return distances_to_surface(reference.points, surface); });
  timed("is there a flip that fits?", [&] { return find_axis_flip(reference, surface); });
}

/// Extraction, checks and distances on level sets of a mesh of n^3 boxes.
void time_level_sets(Index n) {
  const TetMesh mesh = box_mesh({{0, 0, 0}, {100, 100, 100}}, {n, n, n});
  std::vector<double> u, v;
  for (const Vec3& p : mesh.points) u.push_back(wave(p, 0.3));
  for (const double value : u) v.push_back(std::min(1.0, std::abs(value)));
  std::printf("%zu cells\n", mesh.cells.size());

  const TriMesh solid = timed("solid", [&] { return extract_solid(mesh, u, 0); });
  const TriMesh band = timed("band", [&] { return extract_band(mesh, v, 0.5); });
  for (const TriMesh* surface : {&solid, &band}) {
    const SurfaceCheck check = timed("check", [&] { return check_surface(*surface); });
    std::printf("  %zu triangles, %zu points, %s, %s, %lld components\n", surface->triangles.size(),
                surface->points.size(), check.closed() ? "closed" : "open",
                check.manifold() ? "manifold" : "not manifold",
                static_cast<long long>(check.components));
  }
  timed("split into components", [&] { return split_components(solid); });

  // A million points against two million triangles: as near as two surfaces of one object, and far.
  const Index fine = n * 2;
  const TetMesh fine_mesh = box_mesh({{0, 0, 0}, {100, 100, 100}}, {fine, fine, fine});
  std::vector<double> w;
  for (const Vec3& p : fine_mesh.points) w.push_back(wave(p, 0.3));
  const TriMesh surface = extract_solid(fine_mesh, w, 0);
  const auto samples = timed("a million samples", [&] { return sample_by_area(solid, 1'000'000); });
  std::printf("  against %zu triangles\n", surface.triangles.size());
  const auto distances = timed("distances", [&] { return distances_to_surface(samples, surface); });
  const auto summary = timed("summary", [&] { return summarize(distances); });
  std::printf("  mean %.4f, rms %.4f, p95 %.4f, p99 %.4f, max %.4f mm\n", summary.mean, summary.rms,
              summary.p95, summary.p99, summary.max);
  std::vector<Vec3> scattered(1'000'000);
  for (std::size_t i = 0; i < scattered.size(); ++i) {
    const Vec3 ratios{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    const double k = static_cast<double>(i);
    for (int axis = 0; axis < 3; ++axis) {
      scattered[i][axis] = 200 * (k * ratios[axis] - std::floor(k * ratios[axis])) - 50;
    }
  }
  timed("distances of points anywhere", [&] { return distances_to_surface(scattered, surface); });
}

}  // namespace

int main(int argc, char** argv) {
  const Index n = argc > 1 ? std::atoi(argv[1]) : 60;
  with_threads(1, [&] { time_level_sets(n); });
  compare_surfaces();
}
