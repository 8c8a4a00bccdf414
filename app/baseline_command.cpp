// SPDX-License-Identifier: Apache-2.0
// mesamis baseline: what is used today, to compare with.
#include <iostream>
#include <memory>
#include <optional>

#include "commands.h"
#include "json_file.h"
#include "mesamis/image/edge_sides.h"
#include "mesamis/io/isosurface.h"
#include "mesamis/io/surface_files.h"
#include "outputs.h"
#include "report.h"
#include "scan.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct BaselineCommand {
  fs::path input, output, report;
  std::string method = "isosurface", series;
  std::optional<double> level;
  IsosurfaceOptions options;
};

int run_baseline(const BaselineCommand& command) {
  require_output(command.output, written_surface_formats(), "--output");
  const VolumeFile file = read_scan(command.input, command.series);
  const double level = command.level ? *command.level : find_object(file.volume).level;
  const TriMesh surface = isosurface(file.volume, level, command.options);
  write_surface(command.output, surface);
  const SurfaceCheck check = check_surface(surface);
  if (!command.report.empty()) {
    nlohmann::ordered_json report;
    report["program"] = program_json();
    report["input"] = {{"path", command.input.string()}};
    report["settings"] = {{"method", command.method},
                          {"level", level},
                          {"smooth", command.options.smooth_voxels},
                          {"triangles", command.options.triangles},
                          {"close", command.options.close_at_box}};
    report["surface"] = check_json(surface, check);
    add_costs(report);
    write_json(command.report, report);
  }
  std::cout << surface.triangles.size() << " triangles at level " << level << "\n";
  return kExitDone;
}

}  // namespace

void add_baseline_command(CLI::App& app, CommonOptions&, Action& action) {
  auto command = std::make_shared<BaselineCommand>();
  CLI::App* sub = app.add_subcommand("baseline", "What is used today: an isosurface of the voxels");
  sub->add_option("input", command->input, "Volume file, DICOM directory or file")->required();
  sub->add_option("-o,--output", command->output, listed("Surface:", written_surface_formats()))
      ->required();
  sub->add_option("--method", command->method, "isosurface")
      ->check(CLI::IsMember({"isosurface"}))
      ->capture_default_str();
  sub->add_option("--level", command->level, "Native value (default: midway, as for segment)");
  sub->add_option("--smooth", command->options.smooth_voxels, "Gaussian first, sigma in voxels");
  sub->add_option("--triangles", command->options.triangles, "Decimate to this many triangles");
  sub->add_flag("--close", command->options.close_at_box,
                "Caps where the object leaves the volume");
  sub->add_option("--series", command->series, "DICOM series UID");
  sub->add_option("--report", command->report, "Report: .json");
  sub->callback([command, &action] { action = [command] { return run_baseline(*command); }; });
}

}  // namespace mesamis
