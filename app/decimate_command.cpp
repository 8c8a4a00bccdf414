// SPDX-License-Identifier: Apache-2.0
// mesamis decimate: closed surfaces, with fewer triangles, within a distance.
#include <CLI/CLI.hpp>
#include <algorithm>
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
#include "mesamis/decimate/simplify_objects.h"
#include "mesamis/method/printable.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/label_surface_files.h"
#include "mesamis/report/report.h"
#include "mesamis/run/outcome_details.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/surface/select_parts.h"
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

bool is_closed(const NamedSurface& object) {
  return flaws_of(check_surface(object.surface)).empty();
}

/// The objects of a file, in LPS where it states a frame. Parts of one surface that are open, such
/// as groups of an .obj, are one object.
ObjectFile read_closed(const fs::path& path, const ReadLimits& limits) {
  ObjectFile file = read_object_file(path, limits);
  if (!std::all_of(file.objects.begin(), file.objects.end(), is_closed)) {
    SurfaceFile whole = read_surface_file(path, limits);
    const std::string flaws = flaws_of(check_surface(whole.surface));
    if (!flaws.empty()) {
      throw InputError(path.string() + ": expected a closed 2-manifold surface, found " + flaws);
    }
    log_warning(path.string() + ": parts that are not closed, taken as one surface without names");
    file = {{NamedSurface{}}, whole.frame};
    file.objects[0].surface = std::move(whole.surface);
  }
  const auto frame = file.frame;
  const bool coloured = file.coloured;
  return {in_lps(std::move(file)), frame, coloured};
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

/// The parts that the options leave. An object of which nothing is left goes.
std::vector<SelectionReport> select(const DecimateCommand& command,
                                    std::vector<NamedSurface>& objects) {
  const PartSelection wanted{command.min_volume, command.keep_largest, command.fill_cavities};
  std::vector<SelectionReport> reports;
  std::vector<NamedSurface> left;
  for (NamedSurface& object : objects) {
    SelectionReport report;
    object.surface = select_parts(object.surface, wanted, &report);
    if (object.surface.triangles.empty()) {
      if (objects.size() > 1) log_warning(object.name + ": no part of at least --min-volume");
      continue;
    }
    left.push_back(std::move(object));
    reports.push_back(report);
  }
  if (left.empty()) {
    throw InputError(command.input.string() +
                     ": expected a part of at least --min-volume, found none");
  }
  objects = std::move(left);
  return reports;
}

/// Reduces the triangles of the objects.
/// @return what was done to each.
std::vector<PrintableReport> reduce(const DecimateCommand& command,
                                    std::vector<NamedSurface>& objects, bool quiet) {
  const std::vector<SelectionReport> parts = select(command, objects);
  ProgressDisplay display(quiet);
  const double tolerance = command.most();
  const std::int64_t triangles = command.triangles.value_or(0);
  std::vector<PrintableReport> reports(objects.size());
  if (objects.size() == 1) {
    objects[0].surface = make_printable(
        objects[0].surface,
        {.tolerance = tolerance, .triangles = triangles, .progress = display.callback()},
        &reports[0]);
  } else {
    std::vector<TriMesh> surfaces;
    surfaces.reserve(objects.size());
    for (NamedSurface& object : objects) surfaces.push_back(std::move(object.surface));
    std::vector<DecimateReport> done;
    surfaces = simplify_objects(surfaces, {tolerance, triangles, display.callback()}, &done);
    for (std::size_t n = 0; n < objects.size(); ++n) {
      objects[n].surface = std::move(surfaces[n]);
      reports[n] = {
          {}, done[n].triangles_before, done[n].original_to_result, done[n].result_to_original};
    }
  }
  display.finish();
  for (std::size_t n = 0; n < objects.size(); ++n) reports[n].parts = parts[n];
  return reports;
}

/// The files of the objects: one of all where its format can.
Paths files_of(const fs::path& path, const std::vector<NamedSurface>& objects) {
  return holds_all(path) ? Paths{path} : label_paths(path, objects, objects.size() > 1);
}

void write(const DecimateCommand& command, const ObjectFile& file, OutputSet& set) {
  const std::vector<NamedSurface>& objects = file.objects;
  SurfaceWriteOptions options{.name = command.name};
  if (!file.frame) options.frame.reset();
  if (holds_all(command.output) && (objects.size() > 1 || file.coloured)) {
    return write_objects(set.file(command.output), objects, options);
  }
  const Paths files = files_of(command.output, objects);
  for (std::size_t n = 0; n < objects.size(); ++n) {
    if (objects.size() > 1) options.name = objects[n].name;
    write_surface(set.file(files[n]), objects[n].surface, options);
  }
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

/// Warns where there are more triangles than were asked for.
void warn_of_triangles(const DecimateCommand& command, const std::vector<NamedSurface>& objects) {
  if (!command.triangles) return;
  std::vector<FoundObject> found;
  found.reserve(objects.size());
  for (const NamedSurface& object : objects) found.push_back({object.surface, {}});
  const auto triangles = static_cast<std::int64_t>(triangles_of(objects)) - shared_triangles(found);
  const std::string line = triangles_unmet(*command.triangles, triangles, command.most());
  if (!line.empty()) log_warning(line);
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
  ObjectFile file = read_closed(command.input, common.limits);
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
  warn_of_triangles(command, objects);
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
  sub->add_option("--name", command->name, "Name of the output's surface, or of the whole");
  sub->add_option("--report", command->report, "Report: .json");
  sub->callback([command, &common, &action] {
    action = [command, &common] { return run_decimate(*command, common); };
  });
}

}  // namespace mesamis
