// SPDX-License-Identifier: Apache-2.0
// How fast and how well the remesher fits a mesh to known metrics.
//
//   bench_remesh [--cells N] [--threads N] [--part-cells N] [--case NAME] [--again] [--passes N]
//                [--json] [--write PREFIX]
//
// Cases: linear, polar1, polar2 (UGAWG cubes), voxel (thin layers on a 102 x 122 x 304 grid).
// Complexity captured: that of the mesh over that of the metric itself, integrated finely. Below
// a row of one thread stands what the parts took, and what more cores would make of it: parts are
// given to cores as they come, all else is taken to be serial.
// --again adapts once more to the metric given at the nodes of the first result.
// --passes N knows the metric at nodes only: of a uniform mesh first, then of each result.
// --write leaves each mesh as PREFIX-NAME.mesh (Medit).
#include "mesamis/remesh/remesh.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/metric.h"
#include "support/metric_fields.h"

namespace {

using namespace mesamis;

struct Arguments {
  double cells = 100'000;
  int threads = 1;
  Index part_cells = RemeshOptions{}.part_cells;
  int passes = 0;
  bool json = false, again = false;
  std::string only, write;
};

struct Case {
  std::string name;
  std::unique_ptr<MetricField> metric;
  TetMesh start;
  double scale = 1;
  double complexity = 0;  ///< of the metric itself
};

struct Seconds {
  double user = 0, wall = 0;
};

Seconds seconds_so_far() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto wall = std::chrono::steady_clock::now().time_since_epoch();
  return {static_cast<double>(usage.ru_utime.tv_sec) +
              1e-6 * static_cast<double>(usage.ru_utime.tv_usec),
          std::chrono::duration<double>(wall).count()};
}

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// Thin layers around a wavy surface, 1.5 x 1.5 x 1 mm voxels, with noise, smoothed as the
/// caller of the remesher should.
class VoxelMetric {
 public:
  static constexpr std::array<Index, 3> kSize{102, 122, 304};
  static constexpr Vec3 kSpacing{1.5, 1.5, 1};

  explicit VoxelMetric(double cells) {
    for (Index k = 0; k < kSize[2]; ++k) {
      for (Index j = 0; j < kSize[1]; ++j) {
        for (Index i = 0; i < kSize[0]; ++i)
          logs_.push_back(log_metric({i * 1.5, j * 1.5, 1.0 * k}));
      }
    }
    for (int sweep = 0; sweep < 3; ++sweep) smooth();
    constexpr double kCellsPerUnit = 9.6;
    const double shift = 2.0 / 3 * std::log(cells / kCellsPerUnit / complexity());
    for (auto& l : logs_) {
      for (const std::size_t entry : {0, 3, 5}) l[entry] += static_cast<float>(shift);
    }
  }

  static Box box() { return {{0, 0, 0}, extent()}; }
  GridMetricField field() const { return {box(), kSize, logs_}; }

 private:
  static Vec3 extent() {
    return {1.5 * (kSize[0] - 1), 1.5 * (kSize[1] - 1), 1.0 * (kSize[2] - 1)};
  }

  static double level(const Vec3& p) {
    const Vec3 d = extent();
    const double x = p.x / d.x * 6.28, y = p.y / d.y * 6.28, z = p.z / d.z * 12.56;
    const double gyroid =
        std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
    const double s = std::hypot(p.x / d.x - 0.5, p.y / d.y - 0.5, p.z / d.z - 0.5);
    return 20 * std::max(0.35 - 0.35 * std::abs(gyroid), -1.0) - 80 * std::max(0.0, s - 0.38);
  }

  static Vec3 gradient(const Vec3& p) {
    constexpr double e = 0.3;
    return 1 / (2 * e) *
           Vec3{level(p + Vec3{e, 0, 0}) - level(p - Vec3{e, 0, 0}),
                level(p + Vec3{0, e, 0}) - level(p - Vec3{0, e, 0}),
                level(p + Vec3{0, 0, e}) - level(p - Vec3{0, 0, e})};
  }

  std::array<float, 6> log_metric(const Vec3& p) {
    Vec3 g = gradient(p);
    const double slope = norm(g);
    g = slope > 1e-12 ? 1 / slope * g : Vec3{1, 0, 0};
    const double distance = std::min(std::abs(level(p)) / std::max(slope, 0.2), 40.0);
    const double along = std::min(4 + 0.25 * distance, 14.0);
    const double across = std::min(0.35 + 0.3 * distance, along);
    const Sym3 l =
        -2 * std::log(along) * kIdentity3 + 2 * (std::log(along) - std::log(across)) * outer(g);
    std::array<float, 6> result{};
    const std::array<double, 6> entries{l.xx, l.xy, l.xz, l.yy, l.yz, l.zz};
    for (std::size_t c = 0; c < 6; ++c) result[c] = static_cast<float>(entries[c] + 0.2 * noise());
    return result;
  }

  double noise() {
    random_ = random_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(random_ >> 33) / static_cast<double>(1u << 31) - 0.5;
  }

  void smooth() {
    const auto old = logs_;
    const std::array<std::ptrdiff_t, 3> stride{1, kSize[0], std::ptrdiff_t{kSize[0]} * kSize[1]};
    for (std::ptrdiff_t n = 0; n < std::ssize(logs_); ++n) {
      std::array<float, 6> sum{};
      float weights = 0;
      auto add = [&](std::ptrdiff_t m, float w) {
        for (std::size_t c = 0; c < 6; ++c) sum[c] += w * old[static_cast<std::size_t>(m)][c];
        weights += w;
      };
      add(n, 2);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::ptrdiff_t i = n / stride[axis] % kSize[axis];
        if (i > 0) add(n - stride[axis], 1);
        if (i + 1 < kSize[axis]) add(n + stride[axis], 1);
      }
      for (std::size_t c = 0; c < 6; ++c) logs_[static_cast<std::size_t>(n)][c] = sum[c] / weights;
    }
  }

  double complexity() const {
    double sum = 0;
    for (const auto& l : logs_) sum += std::exp(0.5 * (l[0] + l[3] + l[5]));
    return sum * kSpacing.x * kSpacing.y * kSpacing.z;
  }

  std::vector<std::array<float, 6>> logs_;
  std::uint64_t random_ = 12345;
};

Case make_case(const std::string& name, double cells) {
  Case c{name, nullptr, {}};
  std::array<Index, 3> lattice{203, 243, 607};  // points that integrate the complexity well
  if (name == "voxel") {
    c.metric = std::make_unique<GridMetricField>(VoxelMetric(cells).field());
    c.start = box_mesh(VoxelMetric::box(), {4, 5, 8});
  } else {
    const Ugawg which = name == "linear"   ? Ugawg::kLinear
                        : name == "polar1" ? Ugawg::kPolar1
                                           : Ugawg::kPolar2;
    c.scale = ugawg_scale(which, cells);
    c.metric = std::make_unique<FormulaMetric>(ugawg_metric(which, c.scale));
    c.start = box_mesh(kUnitBox, {3, 3, 3});
    lattice = {3000, 3000, 1};
    if (which == Ugawg::kLinear) lattice = {1, 1, 100'000};
  }
  c.complexity = integrated_complexity(*c.metric, bounding_box(c.start.points), lattice);
  return c;
}

/// How long the rounds' parts take on so many cores, each part going to the core that is free
/// first, and the serial rest.
double scheduled_seconds(const RemeshReport& report, std::size_t cores) {
  double total = report.seconds;
  for (const auto& parts : report.part_seconds) {
    std::vector<double> busy(cores, 0);
    for (const double seconds : parts) {
      *std::min_element(busy.begin(), busy.end()) += seconds;
      total -= seconds;
    }
    total += *std::max_element(busy.begin(), busy.end());
  }
  return total;
}

void write_medit(const TetMesh& mesh, const std::string& path) {
  FILE* out = std::fopen(path.c_str(), "w");
  if (out == nullptr) throw std::runtime_error("cannot write " + path);
  std::fprintf(out, "MeshVersionFormatted 2\nDimension 3\nVertices\n%zu\n", mesh.points.size());
  for (const Vec3& p : mesh.points) std::fprintf(out, "%.17g %.17g %.17g 0\n", p.x, p.y, p.z);
  std::fprintf(out, "Tetrahedra\n%zu\n", mesh.cells.size());
  for (const Cell& c : mesh.cells) {
    std::fprintf(out, "%d %d %d %d 0\n", c[0] + 1, c[1] + 1, c[2] + 1, c[3] + 1);
  }
  std::fprintf(out, "End\n");
  std::fclose(out);
}

struct Row {
  const Case& c;
  const TetMesh& mesh;
  const RemeshReport& report;
  Seconds spent;
  MeshFit fit;
  double captured;
};

double part_seconds(const RemeshReport& report) {
  double sum = 0;
  for (const auto& parts : report.part_seconds) sum += std::reduce(parts.begin(), parts.end());
  return sum;
}

void print_json(const Row& row, const Arguments& arguments) {
  const auto cells = static_cast<double>(row.mesh.cells.size());
  // Seconds of parts that ran at once do not add up to what one thread would take.
  const std::string speed_up =
      arguments.threads > 1
          ? "null"
          : std::to_string(row.report.seconds / scheduled_seconds(row.report, 16));
  std::printf(
      "{\"case\": \"%s\", \"scale\": %.6f, \"tets\": %.0f, \"unit_edge_percent\": %.2f, "
      "\"quality_min\": %.3f, \"quality_mean\": %.4f, \"complexity_captured_percent\": %.2f, "
      "\"user_seconds\": %.2f, \"wall_seconds\": %.2f, \"tets_per_second\": %.0f, "
      "\"peak_bytes_per_tet\": %.0f, \"rounds\": %d, \"threads\": %d, \"part_seconds\": %.2f, "
      "\"speed_up_on_16\": %s, \"hash\": \"%016" PRIx64 "\"}\n",
      row.c.name.c_str(), row.c.scale, cells, 100 * row.fit.unit_edge_fraction, row.fit.quality_min,
      row.fit.quality_mean, 100 * row.captured, row.spent.user, row.spent.wall,
      cells / row.spent.user, peak_bytes() / cells, row.report.rounds, arguments.threads,
      part_seconds(row.report), speed_up.c_str(), mesh_hash(row.mesh));
}

void print_text(const Row& row, const Arguments& arguments) {
  const auto cells = static_cast<double>(row.mesh.cells.size());
  std::printf("%-12s %9.0f %7.2f %6.3f %6.4f %8.2f %8.2f %8.2f %7.0f %6.0f %6d %4d  %016" PRIx64
              "\n",
              row.c.name.c_str(), cells, 100 * row.fit.unit_edge_fraction, row.fit.quality_min,
              row.fit.quality_mean, 100 * row.captured, row.spent.user, row.spent.wall,
              cells / row.spent.user, peak_bytes() / cells, row.report.rounds, arguments.threads,
              mesh_hash(row.mesh));
  if (row.report.part_seconds.empty() || arguments.threads > 1) return;
  std::printf("    parts %.2f s in %zu rounds, the rest %.2f s;", part_seconds(row.report),
              row.report.part_seconds.size(), row.report.seconds - part_seconds(row.report));
  for (const std::size_t cores : {2, 4, 8, 16}) {
    std::printf(" %zu cores: x %.1f", cores,
                row.report.seconds / scheduled_seconds(row.report, cores));
  }
  std::printf("\n");
}

TetMesh run(const Case& c, const MetricField& metric, const Arguments& arguments) {
  RemeshReport report;
  const Seconds before = seconds_so_far();
  RemeshOptions options;
  options.part_cells = arguments.part_cells;
  TetMesh mesh = remesh(c.start, metric, options, &report);
  const Seconds after = seconds_so_far();
  const std::vector<Sym3> metrics = metrics_at_nodes(mesh, *c.metric);
  const Row row{c,
                mesh,
                report,
                {after.user - before.user, after.wall - before.wall},
                measure_fit(mesh, metrics),
                complexity(mesh, metrics) / c.complexity};
  arguments.json ? print_json(row, arguments) : print_text(row, arguments);
  std::fflush(stdout);
  validate(mesh, bounding_box(c.start.points));
  return mesh;
}

/// Adapts a mesh once more to the metric at its own nodes.
TetMesh run_again(Case& c, const TetMesh& mesh, const Arguments& arguments) {
  const MeshMetricField background(mesh, metrics_at_nodes(mesh, *c.metric));
  c.name += "+";
  c.start = mesh;
  return run(c, background, arguments);
}

/// What those do who know the metric at the nodes of a mesh only: a uniform mesh gives the first
/// metric, each result the next.
void run_passes(Case& c, const Arguments& arguments) {
  constexpr int kUniform = 30;
  const Box box = bounding_box(c.start.points);
  const TetMesh uniform = box_mesh(box, {kUniform, kUniform, kUniform});
  const MeshMetricField background(uniform, metrics_at_nodes(uniform, *c.metric));
  c.start = coarse_box_mesh(box);
  TetMesh mesh = run(c, background, arguments);
  for (int pass = 1; pass < arguments.passes; ++pass) mesh = run_again(c, mesh, arguments);
}

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  auto value = [&](int& i) {
    if (i + 1 == argc) throw std::runtime_error(std::string(argv[i]) + " needs a value");
    return argv[++i];
  };
  for (int i = 1; i < argc; ++i) {
    const std::string_view option = argv[i];
    if (option == "--cells") {
      arguments.cells = std::atof(value(i));
    } else if (option == "--threads") {
      arguments.threads = std::atoi(value(i));
    } else if (option == "--part-cells") {
      arguments.part_cells = std::atoi(value(i));
    } else if (option == "--case") {
      arguments.only = value(i);
    } else if (option == "--write") {
      arguments.write = value(i);
    } else if (option == "--passes") {
      arguments.passes = std::atoi(value(i));
    } else if (option == "--json") {
      arguments.json = true;
    } else if (option == "--again") {
      arguments.again = true;
    } else {
      throw std::runtime_error("unknown option " + std::string(option));
    }
  }
  return arguments;
}

void run_cases(const Arguments& arguments) {
  if (!arguments.json) {
    std::printf("%-12s %9s %7s %6s %6s %8s %8s %8s %7s %6s %6s %4s  %s\n", "case", "tets", "unit %",
                "q min", "q mean", "captured", "user s", "wall s", "tets/s", "B/tet", "rounds",
                "thr", "hash");
  }
  for (const std::string name : {"linear", "polar1", "polar2", "voxel"}) {
    if (!arguments.only.empty() && arguments.only != name) continue;
    Case c = make_case(name, arguments.cells);
    if (arguments.passes > 0) {
      run_passes(c, arguments);
      continue;
    }
    const TetMesh mesh = run(c, *c.metric, arguments);
    if (!arguments.write.empty()) write_medit(mesh, arguments.write + "-" + name + ".mesh");
    if (arguments.again) run_again(c, mesh, arguments);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments arguments = parse(argc, argv);
  with_threads(arguments.threads, [&] { run_cases(arguments); });
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_remesh: %s\n", error.what());
  return 1;
}
