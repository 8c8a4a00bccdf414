// SPDX-License-Identifier: Apache-2.0
// mesamis decimate: closed surfaces, with fewer triangles, within a distance.
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
#include "mesamis/report/label_surface_files.h"
#include "mesamis/report/report.h"
#include "mesamis/run/decimate_objects.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/surface/self_intersections.h"
#include "outputs.h"
#include "progress.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct DecimateCommand {
  fs::path input, output, report;
  std::string name = "mesamis surface";
  std::optional<double> tolerance;  // mm
  std::optional<std::int64_t> triangles;
  double min_volume = 0;  // mm^3
  std::int64_t keep_largest = 0;
  bool fill_cavities = false;

  double most() const { return tolerance.value_or(std::numeric_limits<double>::infinity()); }
};

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

/// Reduces the triangles of the objects. Those of which nothing is left go.
/// @return what was done to each of the others.
std::vector<PrintableReport> reduce(const DecimateCommand& command,
                                    std::vector<NamedSurface>& objects, bool quiet) {
  ProgressDisplay display(quiet);
  PrintableOptions options;
  options.min_volume = command.min_volume;
  options.keep_largest = command.keep_largest;
  options.fill_cavities = command.fill_cavities;
  options.tolerance = command.most();
  options.triangles = command.triangles.value_or(0);
  options.progress = display.callback();
  const bool several = objects.size() > 1;
  DecimatedObjects done = decimate_objects(std::move(objects), options);
  display.finish();
  for (const std::string& name : done.dropped) {
    if (several) log_warning(name + ": no part of at least --min-volume");
  }
  if (done.objects.empty()) {
    throw InputError(command.input.string() +
                     ": expected a part of at least --min-volume, found none");
  }
  objects = std::move(done.objects);
  if (!done.unmet.empty()) log_warning(done.unmet);
  return std::move(done.reports);
}

/// The files of the objects: one of all where its format can.
Paths files_of(const fs::path& path, const std::vector<NamedSurface>& objects) {
  return holds_all(path) ? Paths{path} : label_paths(path, objects, objects.size() > 1);
}

void write(const DecimateCommand& command, const ObjectFile& file, OutputSet& set) {
  const std::vector<NamedSurface>& objects = file.objects;
  SurfaceWriteOptions options{.name = command.name};
  if (!file.frame) options.frame.reset();
  if (objects.size() > 1 || (file.coloured && holds_all(command.output))) {
    return write_named_surfaces(set.file(command.output), objects, options);
  }
  write_surface(set.file(files_of(command.output, objects)[0]), objects[0].surface, options);
}

/// The entry of one surface in the report.
ordered_json surface_json(const TriMesh& surface, const PrintableReport& printable,
                          double tolerance) {
  ordered_json entry = printable_json(printable, tolerance);
  entry.update(check_json(surface, check_surface(surface)));
  entry["self_intersections"] = find_self_intersections(surface).size();
  return entry;
}

void write_report(const DecimateCommand& command, std::size_t triangles,
                  const std::vector<NamedSurface>& objects,
                  const std::vector<PrintableReport>& reports, OutputSet& set) {
  ordered_json report;
  report["program"] = program_json();
  report["input"] = {{"path", command.input.string()}, {"triangles", triangles}};
  for (std::size_t n = 0; n < objects.size(); ++n) {
    ordered_json entry = surface_json(objects[n].surface, reports[n], command.most());
    if (objects.size() == 1) {
      report["surface"] = std::move(entry);
      break;
    }
    ordered_json named{{"name", objects[n].name}, {"label", objects[n].label}};
    named.update(entry);
    report["surfaces"].push_back(std::move(named));
  }
  report["files"] = files_json(set);
  add_costs(report);
  write_json(set.file(command.report), report);
}

std::size_t triangles_of(const std::vector<NamedSurface>& objects) {
  std::size_t triangles = 0;
  for (const NamedSurface& object : objects) triangles += object.surface.triangles.size();
  return triangles;
}

void print_line(const NamedSurface& object, std::size_t before, const PrintableReport& report) {
  std::cout << object.surface.triangles.size() << " of " << before << " triangles, at most "
            << report.extracted_to_result << " mm there and " << report.result_to_extracted
            << " mm back\n";
}

/// Says what was not kept, first that a surface is not closed.
int judge(const DecimateCommand& command, const std::vector<NamedSurface>& objects,
          const std::vector<PrintableReport>& reports) {
  int status = kExitDone;
  for (std::size_t n = 0; n < objects.size(); ++n) {
    std::string line = objects.size() > 1 ? objects[n].name + ": " : "";
    if (const auto flaws = flaws_of(check_surface(objects[n].surface)); !flaws.empty()) {
      log_error(line.append("expected a closed 2-manifold surface, found ").append(flaws));
      status = kExitNotClosed;
    } else if (!reports[n].within(command.most())) {
      log_error(line.append(tolerance_unmet(command.most(), reports[n])));
      if (status == kExitDone) status = kExitNotConverged;
    }
  }
  return status;
}

int run_decimate(const DecimateCommand& command, const CommonOptions& common) {
  require_all(command);
  std::vector<std::string> warnings;
  ObjectFile file = read_closed_objects(command.input, common.limits, warnings);
  for (const std::string& warning : warnings) log_warning(warning);
  std::vector<NamedSurface>& objects = file.objects;
  Paths outputs = files_of(command.output, objects);
  outputs.push_back(command.report);
  require_distinct_files(outputs, {command.input});
  const std::size_t before = triangles_of(objects);
  const std::vector<PrintableReport> reports = reduce(command, objects, common.quiet);
  OutputSet set;
  write(command, file, set);
  if (!command.report.empty()) write_report(command, before, objects, reports, set);
  commit(set);
  if (objects.size() == 1) {
    print_line(objects[0], before, reports[0]);
  } else {
    for (std::size_t n = 0; n < objects.size(); ++n) {
      std::cout << objects[n].name << ": ";
      print_line(objects[n], static_cast<std::size_t>(reports[n].triangles_extracted), reports[n]);
    }
  }
  return judge(command, objects, reports);
}

}  // namespace

void add_decimate_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto command = std::make_shared<DecimateCommand>();
  CLI::App* sub =
      app.add_subcommand("decimate", "Reduce the triangles of closed surfaces within a distance");
  sub->add_option("input", command->input, listed("Surface:", read_surface_formats()))->required();
  sub->add_option("-o,--output", command->output, listed("Surface:", written_surface_formats()))
      ->required();
  sub->add_option("--tolerance", command->tolerance, "Distance in both directions, mm");
  sub->add_option("--triangles", command->triangles,
                  "Stop at this many triangles; those that two objects share count once");
  sub->add_option("--min-volume", command->min_volume,
                  "Drop islands and fill cavities smaller than this, mm^3 (default 0)");
  sub->add_option("--keep-largest", command->keep_largest,
                  "Islands of each object to keep (default 0: all)");
  sub->add_flag("--fill-cavities", command->fill_cavities, "Fill every cavity");
  sub->add_option("--name", command->name, "Name of the output's surface, or of the whole")
      ->type_name("NAME");
  sub->add_option("--report", command->report, "Report: .json");
  sub->callback([command, &common, &action] {
    action = [command, &common] { return run_decimate(*command, common); };
  });
}

}  // namespace mesamis
