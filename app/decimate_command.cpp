// SPDX-License-Identifier: Apache-2.0
// mesamis decimate: any closed surface, with fewer triangles, within a distance.
#include <CLI/CLI.hpp>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "arguments.h"
#include "commands.h"
#include "costs.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/method/printable.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/report.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/surface/self_intersections.h"
#include "outputs.h"
#include "progress.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct DecimateCommand {
  fs::path input, output, report;
  std::string name = "mesamis surface";
  std::optional<double> tolerance;  // mm
  std::optional<std::int64_t> triangles;
  double min_volume = 0;  // mm^3
  std::int64_t keep_largest = 0;
  bool fill_cavities = false;
};

SurfaceFile read_closed(const fs::path& path, const ReadLimits& limits) {
  SurfaceFile file = read_surface_file(path, limits);
  const std::string flaws = flaws_of(check_surface(file.surface));
  if (flaws.empty()) return file;
  throw InputError(path.string() + ": expected a closed 2-manifold surface, found " + flaws);
}

/// What the settings of a run say of the same things holds here as well.
void require_valid_options(const DecimateCommand& command) {
  if (!command.tolerance && !command.triangles) {
    throw CLI::ValidationError("expected --tolerance or --triangles, found neither");
  }
  Settings settings;
  settings.tolerance = command.tolerance;
  settings.triangles = command.triangles;
  settings.min_volume = command.min_volume;
  settings.keep_largest = command.keep_largest;
  as_usage([&] {
    require_valid(settings);
    if (command.tolerance) check_value(find_setting("tolerance"), std::vector{*command.tolerance});
  });
}

void require_all(const DecimateCommand& command) {
  require_utf8(command.name, "--name");
  require_output(command.output, written_surface_formats(), "--output");
  if (!command.report.empty()) require_output(command.report, {".json"}, "--report");
  require_distinct_files({command.output, command.report}, {command.input});
  require_valid_options(command);
}

int run_decimate(const DecimateCommand& command, const CommonOptions& common) {
  require_all(command);
  const double tolerance = command.tolerance.value_or(std::numeric_limits<double>::infinity());
  const SurfaceFile file = read_closed(command.input, common.limits);
  const TriMesh surface = in_lps(file);
  ProgressDisplay display(common.quiet);
  PrintableReport printable;
  const TriMesh result = make_printable(surface,
                                        {.min_volume = command.min_volume,
                                         .keep_largest = command.keep_largest,
                                         .fill_cavities = command.fill_cavities,
                                         .tolerance = tolerance,
                                         .triangles = command.triangles.value_or(0),
                                         .progress = display.callback()},
                                        &printable);
  display.finish();
  if (result.triangles.empty()) {
    throw InputError(command.input.string() +
                     ": expected a part of at least --min-volume, found none");
  }
  const auto frame = file.frame ? std::optional(Frame::kLps) : std::nullopt;
  OutputSet set;
  write_surface(set.file(command.output), result, {.frame = frame, .name = command.name});
  const SurfaceCheck check = check_surface(result);
  if (!command.report.empty()) {
    nlohmann::ordered_json report;
    report["program"] = program_json();
    report["input"] = {{"path", command.input.string()}, {"triangles", surface.triangles.size()}};
    report["surface"] = printable_json(printable, tolerance);
    report["surface"].update(check_json(result, check));
    report["surface"]["self_intersections"] = find_self_intersections(result).size();
    report["files"] = files_json(set);
    add_costs(report);
    write_json(set.file(command.report), report);
  }
  commit(set);
  std::cout << result.triangles.size() << " of " << surface.triangles.size()
            << " triangles, at most " << printable.extracted_to_result << " mm there and "
            << printable.result_to_extracted << " mm back\n";
  if (const std::string flaws = flaws_of(check); !flaws.empty()) {
    log_error("expected a closed 2-manifold surface, found " + flaws);
    return kExitNotClosed;
  }
  if (printable.within(tolerance)) return kExitDone;
  log_error(tolerance_unmet(tolerance, printable));
  return kExitNotConverged;
}

}  // namespace

void add_decimate_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto command = std::make_shared<DecimateCommand>();
  CLI::App* sub =
      app.add_subcommand("decimate", "Reduce the triangles of a closed surface within a distance");
  sub->add_option("input", command->input, listed("Surface:", read_surface_formats()))->required();
  sub->add_option("-o,--output", command->output, listed("Surface:", written_surface_formats()))
      ->required();
  sub->add_option("--tolerance", command->tolerance, "Distance in both directions, mm");
  sub->add_option("--triangles", command->triangles, "Stop at this many triangles");
  sub->add_option("--min-volume", command->min_volume,
                  "Drop islands and fill cavities smaller than this, mm^3 (default 0)");
  sub->add_option("--keep-largest", command->keep_largest, "Islands to keep (default 0: all)");
  sub->add_flag("--fill-cavities", command->fill_cavities, "Fill every cavity");
  sub->add_option("--name", command->name, "Name of the object in the output file");
  sub->add_option("--report", command->report, "Report: .json");
  sub->callback([command, &common, &action] {
    action = [command, &common] { return run_decimate(*command, common); };
  });
}

}  // namespace mesamis
