// SPDX-License-Identifier: Apache-2.0
// What surfaces of labels alone take, on all threads: 105 labels on ten million voxels.
//
//   bench_labels [N [LABELS]]     N^3 voxels; default 215, 105 labels
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/smooth_memberships.h"
#include "timed.h"

namespace {

using namespace mesamis;

/// The label of the nearest of random points; 0 beyond a ball.
std::vector<std::uint16_t> blobs(Index n, int count) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(0, n - 1);
  std::vector<Vec3> centers(static_cast<std::size_t>(count));
  for (Vec3& c : centers) c = {uniform(generator), uniform(generator), uniform(generator)};
  const Vec3 middle{0.5 * (n - 1), 0.5 * (n - 1), 0.5 * (n - 1)};
  std::vector<std::uint16_t> labels(static_cast<std::size_t>(n) * static_cast<std::size_t>(n) *
                                    static_cast<std::size_t>(n));
  parallel_for(labels.size(), [&](std::size_t i) {
    const auto node = static_cast<Index>(i);
    const Vec3 p{double(node % n), double(node / n % n), double(node / n / n)};
    if (norm(p - middle) > 0.6 * n) return;
    double least = 1e300;
    for (std::size_t c = 0; c < centers.size(); ++c) {
      const double d = dot(p - centers[c], p - centers[c]);
      if (d >= least) continue;
      least = d;
      labels[i] = static_cast<std::uint16_t>(c + 1);
    }
  });
  return labels;
}

}  // namespace

int main(int argc, char** argv) {
  const Index n = argc > 1 ? std::atoi(argv[1]) : 215;
  const int count = argc > 2 ? std::atoi(argv[2]) : 105;
  const auto labels = timed("labels", [&] { return blobs(n, count); });
  SmoothReport report;
  const auto memberships = timed("memberships", [&] {
    return smooth_memberships({{n, n, n}, {1, 1, 1}, labels}, {}, &report);
  });
  std::printf("  %d parts, %d rounds, volumes to %.2g %%\n", report.parts, report.rounds,
              100 * report.volume_error);
  const auto partition =
      timed("boundaries", [&] { return extract_partition_on_grid(memberships); });
  std::printf("  %zu triangles\n", partition.triangles.size());
  const auto objects =
      timed("objects", [&] { return object_surfaces(partition, materials_of(partition)); });
  std::printf("  %zu objects\n", objects.size());
}
