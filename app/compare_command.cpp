// SPDX-License-Identifier: Apache-2.0
// mesamis compare: distances (14)-(16) between two surfaces, both directions.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "arguments.h"
#include "commands.h"
#include "costs.h"
#include "frames_option.h"
#include "log.h"
#include "mesamis/base/written_number.h"
#include "mesamis/files/atomic_file.h"
#include "mesamis/object/places.h"
#include "mesamis/report/comparison_json.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/report.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/shape_files/surface_pair.h"
#include "mesamis/surface/comparison.h"
#include "mesamis/surface/distance.h"
#include "outputs.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct CompareCommand {
  fs::path reference, surface, report, histogram, colored;
  FrameRule frames = FrameRule::kAuto;
  std::optional<Box> part;
};

/// The distances between the surfaces, and between their objects of one name.
struct Measured {
  std::vector<DirectedDistances> directions;
  std::vector<ObjectDistances> objects;
};

void write_report(const CompareCommand& command, const SurfacePair& pair, const Measured& measured,
                  OutputSet& set) {
  nlohmann::ordered_json report;
  report["program"] = program_json();
  report["reference"] = command.reference.string();
  report["surface"] = command.surface.string();
  report["frames"] = frames_json(pair);
  report["unit"] = "mm";
  if (command.part) {
    const auto& [lo, hi] = *command.part;
    report["box"] = {lo.x, lo.y, lo.z, hi.x, hi.y, hi.z};
  }
  for (const DirectedDistances& d : measured.directions) report[d.name] = distances_json(d);
  report["paper"] = paper_distances_json(measured.directions[1]);
  if (!measured.objects.empty()) report["objects"] = objects_json(measured.objects);
  report["files"] = files_json(set);
  add_costs(report);
  write_json(set.file(command.report), report);
}

/// The surface where it was compared, in the frame it has there, with each vertex's distance.
void write_colored(const OutputPath& path, const SurfacePair& pair,
                   const std::vector<double>& distances) {
  SurfaceWriteOptions options{.frame = pair.frame()};
  options.point_arrays = {{"distance", distances}};
  const bool ras = options.frame == Frame::kRas;  // the writer takes LPS
  write_surface(path, ras ? turned(pair.surface) : pair.surface, options);
}

void print_line(const std::string& name, const char* how, const std::vector<double>& distances) {
  const DistanceSummary s = summarize(distances);
  std::printf("%-22s %-8s %9zu", name.c_str(), how, s.count);
  for (const double mm : {s.mean, s.rms, s.p95, s.p99, s.max}) {
    std::printf(" %9s", significant_text(mm, 4).c_str());
  }
  std::printf("\n");
}

void print_lines(const std::vector<DirectedDistances>& directions) {
  for (const DirectedDistances& d : directions) {
    print_line(d.name, "vertices", d.from_vertices);
    print_line(d.name, "area", d.from_area);
  }
}

void print(const Measured& measured) {
  std::printf("%-22s %-8s %9s %9s %9s %9s %9s %9s\n", "distance, mm", "from", "points", "mean",
              "rms", "p95", "p99", "max");
  print_lines(measured.directions);
  for (const ObjectDistances& object : measured.objects) {
    std::printf("%s\n", object.name.c_str());
    print_lines(object.directions);
  }
}

void require_all(const CompareCommand& command) {
  const auto& [reference, surface, report, histogram, colored, frames, part] = command;
  if (!colored.empty()) require_output(colored, {".vtp"}, "--colored");
  if (!report.empty()) require_writable(report);
  if (!histogram.empty()) require_writable(histogram);
  require_distinct_files({report, histogram, colored}, {reference, surface});
}

int run_compare(const CompareCommand& command, const ReadLimits& limits) {
  require_all(command);
  const SurfacePair pair = read_pair(command.reference, command.surface, command.frames, limits);
  for (const std::string& warning : pair.warnings) log_warning(warning);
  const Measured measured{measure_both(pair, command.part), measure_objects(pair, command.part)};
  OutputSet set;
  if (!command.histogram.empty()) {
    write_file(set.file(command.histogram), to_csv(histogram_of(measured.directions)));
  }
  if (!command.colored.empty()) {
    write_colored(set.file(command.colored), pair,
                  command.part ? distances_to_surface(pair.surface.points, pair.reference)
                               : measured.directions[0].from_vertices);
  }
  if (!command.report.empty()) write_report(command, pair, measured, set);
  commit(set);
  print(measured);
  return kExitDone;
}

}  // namespace

void add_compare_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto options = std::make_shared<CompareCommand>();
  CLI::App* command = app.add_subcommand(
      "compare",
      "Measure the distances between two surfaces, and between their objects of one name");
  command->add_option("reference", options->reference, "Reference surface")->required();
  command->add_option("surface", options->surface, "Surface to judge")->required();
  command->add_option("--report", options->report, "Report: .json");
  command->add_option("--histogram", options->histogram, "Histogram of the distances: .csv");
  command->add_option("--colored", options->colored,
                      "The surface with the distance of each vertex (array distance): .vtp");
  add_frames_option(*command, options->frames);
  command
      ->add_option_function<std::string>(
          "--box",
          [options](const std::string& text) {
            options->part = parsed("--box", [&] { return parse_box(text); });
          },
          "X0:X1,Y0:Y1,Z0:Z1, mm in the reference's frame: measure from points inside this box "
          "alone; ends are optional")
      ->type_name("RANGES");
  command->callback([options, &common, &action] {
    action = [options, &common] { return run_compare(*options, common.limits); };
  });
}

}  // namespace mesamis
