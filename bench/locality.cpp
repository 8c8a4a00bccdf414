// SPDX-License-Identifier: Apache-2.0
// How far a changed voxel moves u, v and the surface: bench_locality [SIZE]. What slabs look over
// their borders (docs/scale.md) follows from it.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <vector>

#include "mesamis/fem/amis.h"
#include "mesamis/fem/grid_space.h"
#include "mesamis/phantom/degrade.h"
#include "mesamis/phantom/phantom.h"

namespace {

using namespace mesamis;

constexpr double kLevel = 160;
constexpr float kChange = 50;

AmisResult minimise(const KuhnGrid& grid, const std::vector<float>& grey) {
  AmisOptions options;
  options.parameters.gamma = 4 * options.parameters.epsilon * options.parameters.beta * 49;
  options.max_iterations = 40;
  options.v_tolerance = 1e-10;
  options.solver.tolerance = 1e-13;
  const std::vector<double> f(grey.begin(), grey.end());
  return run_amis(GridSpace(grid), f, {}, options);
}

/// Largest changes at a distance of d to d + 1 voxels from the changed one.
struct Ring {
  double u = 0, v = 0, surface = 0;
};

std::vector<Ring> rings_around(const KuhnGrid& grid, std::size_t changed, const AmisResult& before,
                               const AmisResult& now) {
  const auto centre = grid_place(grid.size, changed);
  std::vector<Ring> rings(static_cast<std::size_t>(grid.size[0]));
  for (std::size_t n = 0; n < before.u.size(); ++n) {
    const auto place = grid_place(grid.size, n);
    double square = 0;
    for (std::size_t a = 0; a < 3; ++a) square += std::pow(place[a] - centre[a], 2);
    const auto at = static_cast<std::size_t>(std::sqrt(square));
    if (at >= rings.size()) continue;
    Ring& ring = rings[at];
    const double du = std::abs(now.u[n] - before.u[n]);
    ring.u = std::max(ring.u, du);
    ring.v = std::max(ring.v, std::abs(now.v[n] - before.v[n]));
    // Along i, where the level is crossed: by as much as u moves over its slope there.
    if (place[0] + 1 == grid.size[0] || (before.u[n] > kLevel) == (before.u[n + 1] > kLevel)) {
      continue;
    }
    ring.surface = std::max(ring.surface, du / std::abs(before.u[n + 1] - before.u[n]));
  }
  return rings;
}

/// A voxel at the level, nearest to the middle.
std::size_t voxel_at_level(const Volume& volume) {
  std::size_t best = 0;
  double best_distance = 1e300;
  for (std::size_t n = 0; n + 1 < volume.samples.size(); ++n) {
    if ((volume.samples[n] > kLevel) == (volume.samples[n + 1] > kLevel)) continue;
    const auto p = volume.voxel(n);
    double square = 0;
    for (std::size_t a = 0; a < 3; ++a) square += std::pow(p[a] - volume.size[a] / 2, 2);
    if (square < best_distance) best_distance = square, best = n;
  }
  return best;
}

}  // namespace

int main(int count, char** arguments) {
  const Index size = count > 1 ? std::atoi(arguments[1]) : 64;
  Volume volume = degrade(sample_phantom(make_phantom("hemipelvis", {size, size, size})),
                          {.blur = 1, .noise = 5});
  const KuhnGrid grid{.size = volume.size, .spacing = {1, 1, 1}};
  const std::size_t changed = voxel_at_level(volume);
  const AmisResult before = minimise(grid, volume.samples);
  volume.samples[changed] += kChange;
  const AmisResult now = minimise(grid, volume.samples);
  std::cout << "voxels   u (grey)    v           surface (voxels)\n"
            << std::scientific << std::setprecision(1);
  const auto rings = rings_around(grid, changed, before, now);
  for (std::size_t d = 0; d < rings.size() / 2; ++d) {
    std::cout << std::setw(6) << d << "   " << rings[d].u << "     " << rings[d].v << "     "
              << rings[d].surface << "\n";
  }
}
