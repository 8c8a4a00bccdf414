// SPDX-License-Identifier: Apache-2.0
// mesamis segment: a scan in, a surface, an adapted mesh and a report out.
#include <CLI/CLI.hpp>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "chosen_scan.h"
#include "commands.h"
#include "deliver.h"
#include "log.h"
#include "mesamis/run/segment.h"
#include "mesamis/shape_files/surface_files.h"
#include "outputs.h"
#include "page_options.h"
#include "place_options.h"
#include "process.h"
#include "progress.h"
#include "ranges.h"
#include "run_plan.h"
#include "scan.h"
#include "segment_checks.h"
#include "segment_run.h"
#include "settings_options.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

/// Options of the files alone, as --frame: no setting of the run depends on them.
void add_mesh_options(CLI::App& c, const std::shared_ptr<SegmentOptions>& o) {
  c.add_option("--mesh", o->out.meshes,
               "Adapted mesh: .vtu, Medit .mesh and .sol, Gmsh .msh, Abaqus and CalculiX .inp");
  c.add_option_function<std::string>(
       "--mesh-region",
       [o](const std::string& name) {
         o->out.mesh.region = name == "object" ? MeshRegion::kObject : MeshRegion::kBox;
       },
       "Cells of --mesh: box, all (default); object, those with more than half of their volume "
       "inside the level set of u, whole")
      ->check(CLI::IsMember({"box", "object"}))
      ->each(noted(o->of_mesh, "--mesh-region"));
  c.add_option("--bins", o->out.mesh.bins,
               "Sets of cells of --mesh, by equal ranges of their native value (default 10)")
      ->check(from_to(1, kMostBins))
      ->each(noted(o->of_mesh, "--bins"));
  c.add_option("--band-mesh", o->out.band_meshes, "The band's cells with v: .vtu");
}

/// Options of how the run goes.
void add_run_options(CLI::App& c, const std::shared_ptr<SegmentOptions>& o) {
  c.add_option("--time-limit", o->time_limit,
               "Seconds after which no new mesh is begun; the surface of the last one is "
               "written (exit status 4)")
      ->check(above_zero());
  c.add_flag("--plan", o->plan,
             "Print the memory that the run needs, as JSON, from the headers alone; no outputs "
             "are needed or written");
  add_slab_options(c, o->slabs);
}

/// Enough once the limit has passed.
HasEnough time_limit(const SegmentOptions& options) {
  if (!options.time_limit) return {};
  return [limit = *options.time_limit] { return wall_seconds() >= limit; };
}

/// Reads labels, scan and masks, and says what is wanted of them.
/// @param out  learns what a report says of the files that were read.
Request read_request(const SegmentOptions& options, const Settings& settings,
                     const CommonOptions& common, RunFiles& out) {
  const bool labels = options.scan.labels.given();
  Request request;
  if (labels) {
    require_several(options);
    request.labels =
        read_label_choice(options.scan.labels, grid_of_scan(options.scan), out.facts.warnings);
    require_object_files(options, request.labels->wanted());
  }
  if (!options.scan.input.empty()) {
    std::optional<double> limit;
    if (!labels) limit = common.limits.memory_gb;
    ReadScan scan = read_chosen_scan(options.scan, settings, limit);
    request.scan = std::move(scan.volume);
    request.object = std::move(scan.object);
    out.facts.input = std::move(scan.facts);
    out.facts.warnings.insert(out.facts.warnings.begin(), scan.warnings.begin(),
                              scan.warnings.end());
    out.subject = scan.subject;
  } else if (!labels) {
    throw CLI::ValidationError("input", "expected a scan, found none");
  }
  request.settings = settings;
  request.mesh = options.wants_mesh();
  request.elements = element_request(options.body, options.scan.frame, common.limits.memory_gb);
  request.enough = time_limit(options);
  return request;
}

/// Logs what is said of a run as it is said.
Listener listener_of(ProgressDisplay& display, const SegmentOptions& options) {
  Listener listener;
  listener.progress = display.callback();
  listener.note = [](const std::string& line) { log_info(line); };
  listener.warning = [&display](const std::string& line) {
    display.finish();
    log_warning(line);
  };
  listener.objects = [&options](const std::vector<Segment>& wanted) {
    if (options.scan.labels.given()) return;  // known, and checked, before the scan was read
    if (options.time_limit) {
      throw CLI::ValidationError("--time-limit", "expected a run for one object, found several");
    }
    require_several(options);
    require_object_files(options, wanted);
  };
  return listener;
}

void warn_of_missing_meshes(const SegmentOptions& options, const OutcomeDetails& outcome) {
  if (!outcome.one || !outcome.one->stopped || outcome.mesh() != nullptr) return;
  if (!options.wants_mesh()) return;
  log_warning("--time-limit: expected a mesh within the time, found none; none is written");
}

/// Of the page: the scan as it is in its file.
std::function<std::optional<Volume>()> shown_scan(const SegmentOptions& options,
                                                  const RunFiles& out) {
  const std::string sum = out.facts.input ? out.facts.input->sha256 : std::string();
  return [&options, sum] { return read_shown_scan({options.scan.input, options.scan.read, sum}); };
}

/// Which stages the progress of the run has.
RunStages stages_of(const SegmentOptions& options, const Settings& settings) {
  const ScanArguments& scan = options.scan;
  RunStages stages;
  stages.labels = scan.labels.given() || scan.places.seeds.size() > 1;
  stages.scan = !scan.input.empty();
  stages.preview = settings.preview;
  stages.mesh = options.wants_mesh();
  stages.elements = options.body.elements();
  return stages;
}

int run_whole(const SegmentOptions& options, const Settings& settings,
              const CommonOptions& common) {
  RunFiles out = outputs_of(options, common);
  ProgressDisplay display(common.quiet, stage_shares(stages_of(options, settings)));
  display.begin("reading");
  Request request = read_request(options, settings, common, out);
  out.shown_scan = shown_scan(options, out);
  const Outcome found = segment(std::move(request), listener_of(display, options));
  const OutcomeDetails& outcome = found.details();
  display.finish();
  warn_of_missing_meshes(options, outcome);
  warn_of_elements(options.body, outcome);
  OutputSet set;
  return deliver(outcome, out, set, display);
}

int print_plan(const SegmentOptions& options, const Settings& settings) {
  const ScanArguments& scan = options.scan;
  if (scan.input.empty() && !scan.labels.given()) {
    throw CLI::ValidationError("input", "expected a scan, found none");
  }
  std::cout << run_plan(scan, settings, options.wants_mesh()).dump(2) << "\n";
  return kExitDone;
}

int run_in_parts(const SegmentOptions& options, const Settings& settings,
                 const CommonOptions& common) {
  require_slabs(options, settings);
  if (options.time_limit) {
    throw CLI::ValidationError("--time-limit", "expected a run without --slabs, found one");
  }
  return run_slabs(options, options.slabs, settings, common);
}

}  // namespace

int run_segment(SegmentOptions options, const CommonOptions& common) {
  forget_warnings();
  ScanArguments& scan = options.scan;
  scan.report = options.out.wants_report();
  scan.read.limits = common.limits;
  scan.places.read = scan.labels.read = read_like(scan.read, !scan.input.empty());
  const Settings settings = settings_of(options.settings);
  require_segment(options, settings);
  if (options.plan) return print_plan(options, settings);
  if (options.slabs.given()) return run_in_parts(options, settings, common);
  if (common.team->size() > 1) {
    throw CLI::ValidationError("--slabs", "expected it for a run of several processes, found none");
  }
  return run_whole(options, settings, common);
}

void add_segment_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto options = std::make_shared<SegmentOptions>();
  CLI::App* command = app.add_subcommand("segment", "Segment a scan: surface, mesh, report");
  command->add_option("input", options->scan.input,
                      "Volume file, DICOM directory or file; optional with --labels");
  const auto group = [command](const char* name) { command->option_defaults()->group(name); };
  group("Files written");
  command->add_option("-o,--output", options->out.surfaces,
                      listed("Surface:", written_surface_formats()));
  command->add_flag("--error", options->out.error,
                    "Write the expected error at each point, mm, into --output .vtp and .ply, as "
                    "expected_error");
  command->add_flag("--patient", options->scan.patient,
                    "Copy patient, study and frame of reference of the DICOM scan into --output "
                    ".dcm; without it a .dcm names no patient");
  add_mesh_options(*command, options);
  command->add_option("--labelmap", options->out.labelmap,
                      "The result as voxels on the scan's grid: .nii .nii.gz .nrrd "
                      ".seg.nrrd");
  command->add_option("--report", options->out.report, "Report: .json");
  add_page_options(*command, options->out.page);
  add_frame_option(*command, options->scan.frame);
  command->add_option("--name", options->out.name, "The object's name in the surfaces written")
      ->type_name("NAME")
      ->each(noted(options->of_surfaces, "--name"));
  group("Which object");
  add_label_options(*command, options->scan.labels);
  add_place_options(*command, options->scan.places);
  group("Scan");
  add_read_options(*command, options->scan.read);
  group("Finite elements");
  add_body_options(*command, options->body);
  group("Run");
  add_run_options(*command, options);
  add_settings_options(*command, options->settings);
  command->callback([options, &common, &action] {
    action = [options, &common] { return run_segment(*options, common); };
  });
}

}  // namespace mesamis
