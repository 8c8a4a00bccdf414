// SPDX-License-Identifier: Apache-2.0
// mesamis compare: distances (14)-(16) between two surfaces, both directions.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>

#include "commands.h"
#include "json_file.h"
#include "mesamis/io/atomic_file.h"
#include "mesamis/io/surface_files.h"
#include "mesamis/surface/distance.h"
#include "outputs.h"
#include "report.h"
#include "surface_pair.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kAreaSamples = 200000;
constexpr std::size_t kBins = 100;

struct CompareCommand {
  fs::path reference, surface, report, histogram, colored;
  FrameRule frames = FrameRule::kAuto;
};

/// Distances from one surface to another, from its vertices and from points even by area.
struct Direction {
  std::string name;
  std::vector<double> from_vertices, from_area;
};

Direction measure(const std::string& name, const TriMesh& from, const TriMesh& to) {
  return {name, distances_to_surface(from.points, to),
          distances_to_surface(sample_by_area(from, kAreaSamples), to)};
}

nlohmann::ordered_json summary_json(const char* count_name, const std::vector<double>& distances) {
  const DistanceSummary s = summarize(distances);
  return {{count_name, s.count}, {"mean", s.mean}, {"rms", s.rms},
          {"p95", s.p95},        {"p99", s.p99},   {"max", s.max}};
}

/// What the paper calls its distances: its surface of vertices v is the reference.
nlohmann::ordered_json paper_json(const std::vector<double>& local_distances) {
  const DistanceSummary s = summarize(local_distances);
  return {{"hausdorff", s.max},
          {"average_hausdorff", s.mean},
          {"least_local", *std::min_element(local_distances.begin(), local_distances.end())}};
}

void write_report(const CompareCommand& command, const SurfacePair& pair,
                  const Direction& surface_to_reference, const Direction& reference_to_surface) {
  nlohmann::ordered_json report;
  report["program"] = program_json();
  report["reference"] = command.reference.string();
  report["surface"] = command.surface.string();
  report["frames"] = frames_json(pair);
  report["unit"] = "mm";
  for (const Direction* d : {&surface_to_reference, &reference_to_surface}) {
    report[d->name] = summary_json("vertices", d->from_vertices);
    report[d->name]["by_area"] = summary_json("samples", d->from_area);
  }
  report["paper"] = paper_json(reference_to_surface.from_vertices);
  add_costs(report);
  write_json(command.report, report);
}

std::vector<std::size_t> count_in_bins(const std::vector<double>& distances, double width) {
  std::vector<std::size_t> counts(kBins, 0);
  for (const double d : distances) {
    ++counts[std::min(static_cast<std::size_t>(d / width), kBins - 1)];
  }
  return counts;
}

/// Columns: the bin's bounds in mm, then the number of vertices and of area samples in it for
/// each direction.
void write_histogram(const fs::path& path, const std::vector<Direction>& directions) {
  double longest = 0;
  for (const Direction& d : directions) {
    for (const auto* values : {&d.from_vertices, &d.from_area}) {
      for (const double value : *values) longest = std::max(longest, value);
    }
  }
  const double width = longest > 0 ? longest / kBins : 1;
  std::ostringstream text;
  std::vector<std::vector<std::size_t>> columns;
  text << "from_mm,to_mm";
  for (const Direction& d : directions) {
    text << "," << d.name << "_vertices," << d.name << "_area";
    columns.push_back(count_in_bins(d.from_vertices, width));
    columns.push_back(count_in_bins(d.from_area, width));
  }
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    text << "\n" << static_cast<double>(bin) * width << "," << static_cast<double>(bin + 1) * width;
    for (const auto& column : columns) text << "," << column[bin];
  }
  text << "\n";
  write_file(path, text.str());
}

/// The surface where it was compared, in the frame it has there, with each vertex's distance.
void write_colored(const fs::path& path, const SurfacePair& pair,
                   const std::vector<double>& distances) {
  SurfaceWriteOptions options{.frame = pair.frame()};
  options.point_arrays = {{"distance", distances}};
  const bool ras = options.frame == Frame::kRas;  // the writer takes LPS
  write_surface(path, ras ? turned(pair.surface) : pair.surface, options);
}

void print_line(const std::string& name, const char* how, const std::vector<double>& distances) {
  const DistanceSummary s = summarize(distances);
  std::printf("%-22s %-8s %9zu %9.4f %9.4f %9.4f %9.4f %9.4f\n", name.c_str(), how, s.count, s.mean,
              s.rms, s.p95, s.p99, s.max);
}

int run_compare(const CompareCommand& command) {
  if (!command.colored.empty()) require_output(command.colored, {".vtp"}, "--colored");
  const SurfacePair pair = read_pair(command.reference, command.surface, command.frames);
  const std::vector<Direction> directions{
      measure("surface_to_reference", pair.surface, pair.reference),
      measure("reference_to_surface", pair.reference, pair.surface)};
  if (!command.report.empty()) write_report(command, pair, directions[0], directions[1]);
  if (!command.histogram.empty()) write_histogram(command.histogram, directions);
  if (!command.colored.empty()) {
    write_colored(command.colored, pair, directions[0].from_vertices);
  }
  std::printf("%-22s %-8s %9s %9s %9s %9s %9s %9s\n", "distance, mm", "from", "points", "mean",
              "rms", "p95", "p99", "max");
  for (const Direction& d : directions) {
    print_line(d.name, "vertices", d.from_vertices);
    print_line(d.name, "area", d.from_area);
  }
  return kExitDone;
}

}  // namespace

void add_compare_command(CLI::App& app, CommonOptions&, Action& action) {
  auto options = std::make_shared<CompareCommand>();
  CLI::App* command = app.add_subcommand("compare", "Measure the distances between two surfaces");
  command->add_option("reference", options->reference, "Reference surface")->required();
  command->add_option("surface", options->surface, "Surface to judge")->required();
  command->add_option("--report", options->report, "Report: .json");
  command->add_option("--histogram", options->histogram, "Histogram of the distances: .csv");
  command->add_option("--colored", options->colored,
                      "The surface with the distance of each vertex (array distance): .vtp");
  const std::map<std::string, FrameRule> rules{
      {"auto", FrameRule::kAuto}, {"as-is", FrameRule::kAsIs}, {"turned", FrameRule::kTurned}};
  command
      ->add_option("--frames", options->frames,
                   "auto: as the files state, refused if they fit only after a flip; as-is: "
                   "coordinates as they are; turned: the surface's x and y negated")
      ->transform(CLI::CheckedTransformer(rules));
  command->callback([options, &action] { action = [options] { return run_compare(*options); }; });
}

}  // namespace mesamis
