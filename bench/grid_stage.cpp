// SPDX-License-Identifier: Apache-2.0
// The voxel grid stage alone: minimise and estimate on a grid of the size given.
//
//   bench_grid_stage [NX NY NZ [BETA]]     default: the paper's case, 102 122 304, beta 2
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "mesamis/adapt/grid_estimator.h"
#include "mesamis/adapt/size_control.h"
#include "mesamis/base/parallel.h"
#include "mesamis/fem/grid_amis.h"
#include "mesamis/fem/grid_space.h"

namespace {

using namespace mesamis;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Curved shells of bone with noise, grey values.
std::vector<float> image(const KuhnGrid& grid) {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0, 6);
  std::vector<float> f;
  f.reserve(grid.node_count());
  for (Index k = 0; k < grid.size[2]; ++k) {
    for (Index j = 0; j < grid.size[1]; ++j) {
      for (Index i = 0; i < grid.size[0]; ++i) {
        const double wave = std::sin(i * 0.06) * std::cos(j * 0.05) +
                            std::sin(j * 0.05) * std::cos(k * 0.04) +
                            std::sin(k * 0.04) * std::cos(i * 0.06);
        const double bone = 0.5 * (1 + std::erf((0.3 - std::abs(wave)) * 12));
        f.push_back(static_cast<float>(120 + 110 * bone + noise(generator)));
      }
    }
  }
  return f;
}

}  // namespace

int main(int argc, char** argv) {
  std::array<Index, 3> size{102, 122, 304};
  for (std::size_t a = 0; a < 3 && argc > 3; ++a) size[a] = std::atoi(argv[a + 1]);
  const KuhnGrid grid{size, {1.5, 1.5, 1}};
  AmisOptions options;
  options.solver.tolerance = 1e-3;
  if (argc > 4) options.parameters.beta = std::atof(argv[4]);
  const std::vector<float> f = image(grid);
  std::printf("nodes %zu  cells %lld  threads %d\n", grid.node_count(),
              static_cast<long long>(grid.cell_count()), thread_count());

  const double start = seconds();
  const GridMinimum fields = run_amis_on_grid(grid, f, options);
  const AmisReport& report = fields.report;
  const double solved = seconds();
  std::printf("minimise  %6.2f s  %d half-step pairs, %d solver steps, residual %.1e\n",
              solved - start, report.iterations, report.solver_iterations, report.solver_residual);

  GridEstimate estimate = estimate_on_grid(grid, options.parameters, {fields.u, fields.v, f}, {});
  const double estimated = seconds();
  std::printf("estimate  %6.2f s  predicted cells %.3g\n", estimated - solved,
              estimate.predicted_cells);
  control_sizes_to_log(grid, estimate.node_metrics, {0.1, 76, 140000});
  smooth_log_metrics(grid, estimate.node_metrics, 3);
  std::printf("sizes     %6.2f s\npeak memory %.0f MB\n", seconds() - estimated, peak_mb());
}
