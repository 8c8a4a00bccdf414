// SPDX-License-Identifier: Apache-2.0
// mesamis decimate: any closed surface, with fewer triangles, within a distance.
#include <iostream>
#include <memory>
#include <optional>

#include "arguments.h"
#include "commands.h"
#include "json_file.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/io/surface_files.h"
#include "mesamis/printable.h"
#include "mesamis/surface/self_intersections.h"
#include "outputs.h"
#include "progress.h"
#include "report.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct DecimateCommand {
  fs::path input, output, report;
  std::string name = "mesamis surface";
  Settings settings;  // only what make_printable() heeds
};

SurfaceFile read_closed(const fs::path& path) {
  SurfaceFile file = read_surface_file(path);
  const std::string flaws = flaws_of(check_surface(file.surface));
  if (flaws.empty()) return file;
  throw InputError(path.string() + ": expected a closed 2-manifold surface, found " + flaws);
}

int run_decimate(const DecimateCommand& command, const CommonOptions& common) {
  require_output(command.output, written_surface_formats(), "--output");
  if (!command.report.empty()) require_output(command.report, {".json"}, "--report");
  if (!command.settings.tolerance && !command.settings.triangles) {
    throw CLI::ValidationError("expected --tolerance or --triangles, found neither");
  }
  as_usage([&command] { require_valid(command.settings); });
  const SurfaceFile file = read_closed(command.input);
  const TriMesh surface = in_lps(file);
  ProgressDisplay display(common.quiet);
  PrintableReport printable;
  const TriMesh result = make_printable(surface, command.settings, display.callback(), printable);
  display.finish();
  if (result.triangles.empty()) {
    throw InputError(command.input.string() + ": every part is smaller than --min-volume");
  }
  const auto frame = file.frame ? std::optional(Frame::kLps) : std::nullopt;
  write_surface(command.output, result, {.frame = frame, .name = command.name});
  const SurfaceCheck check = check_surface(result);
  if (!command.report.empty()) {
    nlohmann::ordered_json report;
    report["program"] = program_json();
    report["input"] = {{"path", command.input.string()}, {"triangles", surface.triangles.size()}};
    report["surface"] = printable_json(printable, command.settings);
    report["surface"].update(check_json(result, check));
    report["surface"]["self_intersections"] = find_self_intersections(result).size();
    add_costs(report);
    write_json(command.report, report);
  }
  std::cout << result.triangles.size() << " of " << surface.triangles.size()
            << " triangles, at most " << printable.extracted_to_result << " mm there and "
            << printable.result_to_extracted << " mm back\n";
  if (const std::string flaws = flaws_of(check); !flaws.empty()) {
    log_error("expected a closed 2-manifold surface, found " + flaws);
    return kExitNotClosed;
  }
  const auto& tolerance = command.settings.tolerance;
  if (!tolerance || printable.within(*tolerance)) return kExitDone;
  log_error(tolerance_unmet(*tolerance, printable));
  return kExitNotConverged;
}

}  // namespace

void add_decimate_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto command = std::make_shared<DecimateCommand>();
  Settings& settings = command->settings;
  CLI::App* sub =
      app.add_subcommand("decimate", "Fewer triangles for any closed surface, within a distance");
  sub->add_option("input", command->input, listed("Surface:", written_surface_formats()))
      ->required();
  sub->add_option("-o,--output", command->output, listed("Surface:", written_surface_formats()))
      ->required();
  sub->add_option("--tolerance", settings.tolerance, "Distance in both directions, mm");
  sub->add_option("--triangles", settings.triangles, "Stop at this many triangles");
  sub->add_option("--min-volume", settings.min_volume,
                  "Drop islands and fill cavities below so many mm^3 (default 0)");
  sub->add_option("--keep-largest", settings.keep_largest, "Islands to keep (default 0: all)");
  sub->add_flag("--fill-cavities", settings.fill_cavities, "Fill every cavity");
  sub->add_option("--name", command->name, "The object's name in the file written");
  sub->add_option("--report", command->report, "Report: .json");
  sub->callback([command, &common, &action] {
    action = [command, &common] { return run_decimate(*command, common); };
  });
}

}  // namespace mesamis
