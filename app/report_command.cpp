// SPDX-License-Identifier: Apache-2.0
// mesamis report: the page and the pictures of a run that is done.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "commands.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/files/sha256.h"
#include "mesamis/page/run_page.h"
#include "mesamis/report/json_file.h"
#include "mesamis/shape_files/file_kind.h"
#include "mesamis/shape_files/object_files.h"
#include "outputs.h"
#include "page_options.h"
#include "scan.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct ReportCommand {
  fs::path report, scan, mesh;
  std::vector<fs::path> surfaces;
  ReadOptions read;
  PageFiles page;
};

/// The string at a JSON pointer; empty where there is none.
std::string text_at(const json& report, const char* pointer) {
  const json::json_pointer at(pointer);
  return report.contains(at) && report.at(at).is_string() ? report.at(at).get<std::string>() : "";
}

/// The list at a JSON pointer; empty where there is none.
json entries(const json& report, const char* pointer) {
  const json::json_pointer at(pointer);
  return report.contains(at) && report.at(at).is_array() ? report.at(at) : json::array();
}

/// An entry of a report that a page reads the inside of.
struct ShapedEntry {
  const char* pointer;
  bool is_list;  ///< of objects; else an object
};

/// @throws InputError  naming the entry, where one of a report is of another kind than `segment`
///                     writes.
void require_shape(const json& report, const fs::path& path) {
  constexpr std::array<ShapedEntry, 13> kShaped{{{"/program", false},
                                                 {"/input", false},
                                                 {"/output", false},
                                                 {"/object", false},
                                                 {"/object/surfaces", true},
                                                 {"/surface", false},
                                                 {"/body", false},
                                                 {"/mesh", false},
                                                 {"/settings", false},
                                                 {"/chosen", false},
                                                 {"/verdict", false},
                                                 {"/iterations", true},
                                                 {"/files", true}}};
  for (const ShapedEntry& entry : kShaped) {
    const json::json_pointer at(entry.pointer);
    if (!report.contains(at) || report.at(at).is_null()) continue;
    const json& found = report.at(at);
    const auto is_object = [](const json& one) { return one.is_object(); };
    const bool shaped = entry.is_list
                            ? found.is_array() && std::all_of(found.begin(), found.end(), is_object)
                            : found.is_object();
    if (shaped) continue;
    throw InputError(path.string() + ": " + entry.pointer + ": expected " +
                     (entry.is_list ? "a list of objects" : "an object") +
                     ", found something else");
  }
}

json read_report(const fs::path& path) {
  json report = read_json(path);
  const bool of_run = report.is_object() && text_at(report, "/program/name") == "mesamis" &&
                      (report.contains("surface") || report.contains("object"));
  if (!of_run) {
    throw InputError(path.string() +
                     ": expected the report of a run of segment, found something else");
  }
  require_shape(report, path);
  return report;
}

/// Where a file of a report is now: where the report says, or by the same name beside the report.
fs::path found_file(const ReportCommand& command, const std::string& named) {
  if (named.empty() || fs::exists(named)) return named;
  const fs::path beside = command.report.parent_path() / fs::path(named).filename();
  if (fs::exists(beside)) return beside;
  log_warning(named + ": not found; the page is made without it");
  return {};
}

/// A file that the report lists must be the one that the run wrote.
void require_written_by_run(const fs::path& path, const std::string& sum) {
  if (sum.empty() || sha256(path) == sum) return;
  throw InputError(path.string() +
                   ": expected the file of the run, found another one: its sha256 differs");
}

/// The files of a kind that the report lists and that are there; all with the extension of the
/// first.
Paths listed_files(const ReportCommand& command, const json& report, FileKind kind) {
  Paths found;
  std::string extension;
  for (const json& file : entries(report, "/files")) {
    const std::string named = text_at(file, "/path"), of_file = lower_extension(named);
    if (named.empty() || kind_of(named) != kind || of_file == ".mtl") continue;
    if (!extension.empty() && of_file != extension) continue;
    const fs::path path = found_file(command, named);
    if (path.empty()) continue;
    require_written_by_run(path, text_at(file, "/sha256"));
    extension = of_file;
    found.push_back(path);
  }
  return found;
}

/// Files that the user names must be some of those that the run wrote.
void require_listed(const Paths& paths, const json& report) {
  std::set<std::string> sums;
  for (const json& file : entries(report, "/files")) sums.insert(text_at(file, "/sha256"));
  for (const fs::path& path : paths) {
    if (sums.count(sha256(path)) > 0) continue;
    throw InputError(path.string() +
                     ": expected a file of the run, found another one: the report lists no file "
                     "of its sha256");
  }
}

/// A surface of the run, with the error expected at its points where its file has it.
struct ReadSurface {
  NamedSurface named;
  std::vector<double> error;
};

/// Of the one surface of a file; empty where the file has none.
std::vector<double> read_error(const fs::path& path, const ReadLimits& limits) {
  if (!carries_arrays(path)) return {};
  try {
    return read_point_array(path, "expected_error", limits);
  } catch (const InputError&) {
    return {};  // written without --error
  }
}

std::vector<ReadSurface> read_surfaces(const ReportCommand& command, const json& report) {
  const Paths paths = command.surfaces.empty() ? listed_files(command, report, FileKind::kSurface)
                                               : command.surfaces;
  const bool several = entries(report, "/object/surfaces").size() > 1;
  std::vector<ReadSurface> surfaces;
  for (const fs::path& path : paths) {
    if (!several) {
      ReadSurface& one = surfaces.emplace_back();
      one.named.surface = in_lps(read_surface_file(path, command.read.limits));
      one.error = read_error(path, command.read.limits);
      break;
    }
    std::vector<NamedSurface> objects = in_lps(read_object_file(path, command.read.limits));
    const bool alone = objects.size() == 1;
    for (NamedSurface& s : objects) surfaces.push_back({std::move(s), {}});
    if (alone) surfaces.back().error = read_error(path, command.read.limits);
  }
  return surfaces;
}

/// Names and colours are those of the report where there is one entry per surface.
std::vector<PageSurface> named(const std::vector<ReadSurface>& surfaces, const json& report) {
  const json objects = entries(report, "/object/surfaces");
  const bool known = objects.size() == surfaces.size();
  std::vector<PageSurface> shown;
  for (std::size_t n = 0; n < surfaces.size(); ++n) {
    const NamedSurface& named = surfaces[n].named;
    PageSurface s{&named.surface, named.name, named.colour, surfaces[n].error};
    if (known) {
      s.name = text_at(objects[n], "/name");
      const json colour = objects[n].value("colour", json());
      for (std::size_t c = 0; colour.is_array() && colour.size() == 3 && c < 3; ++c) {
        if (colour[c].is_number_unsigned()) s.colour[c] = colour[c].get<std::uint8_t>();
      }
    }
    shown.push_back(std::move(s));
  }
  return shown;
}

/// A mesh with the denoised image; bands of cells have none.
std::optional<MeshWithArrays> read_shown_mesh(const ReportCommand& command, const json& report,
                                              std::vector<double>& grey) {
  const Paths paths =
      command.mesh.empty() ? listed_files(command, report, FileKind::kMesh) : Paths{command.mesh};
  for (const fs::path& path : paths) {
    MeshWithArrays mesh = read_mesh(path, command.read.limits);
    for (MeshArray& array : mesh.point_arrays) {
      if (array.name != "u" || array.components != 1) continue;
      grey = std::move(array.values);
      return mesh;
    }
    if (!command.mesh.empty()) {
      throw InputError(path.string() + ": expected a .vtu with the point array u, found none");
    }
  }
  return {};
}

int run_report(const ReportCommand& command) {
  require_page(command.page);
  if (!command.page.given()) {
    throw CLI::ValidationError("report", "expected --html or --pictures, found neither");
  }
  Paths inputs{command.report, command.scan, command.mesh};
  inputs.insert(inputs.end(), command.surfaces.begin(), command.surfaces.end());
  require_distinct_files(page_outputs(command.page), inputs);
  const json report = read_report(command.report);
  require_listed(command.surfaces, report);
  if (!command.mesh.empty()) require_listed({command.mesh}, report);
  const fs::path scan_file =
      command.scan.empty() ? found_file(command, text_at(report, "/input/path")) : command.scan;
  const auto scan = read_shown_scan({scan_file, command.read, text_at(report, "/input/sha256")});
  const std::vector<ReadSurface> surfaces = read_surfaces(command, report);
  std::vector<double> grey;
  const auto mesh = read_shown_mesh(command, report, grey);
  RunPage page{report};
  page.scan = scan ? &*scan : nullptr;
  page.surfaces = named(surfaces, report);
  page.mesh = mesh ? &mesh->mesh : nullptr;
  page.grey = grey;
  page.names = command.page.names;
  OutputSet set;
  write_page(command.page, page, set);
  commit(set);
  return kExitDone;
}

}  // namespace

void add_report_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto options = std::make_shared<ReportCommand>();
  CLI::App* command = app.add_subcommand("report", "Make a page and pictures of a finished run");
  command->add_option("report", options->report, "Report of segment: .json")->required();
  add_page_options(*command, options->page);
  command->add_option("--scan", options->scan,
                      "Scan of the run (default: the one that the report names)");
  command->add_option("--surface", options->surfaces,
                      "Surface, or one per object (default: those that the report names)");
  command->add_option("--mesh", options->mesh,
                      "Mesh of the run: .vtu (default: the one that the report names)");
  add_read_options(*command, options->read);
  command->callback([options, &common, &action] {
    action = [options, &common] {
      options->read.limits = common.limits;
      return run_report(*options);
    };
  });
}

}  // namespace mesamis
