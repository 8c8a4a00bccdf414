// SPDX-License-Identifier: Apache-2.0
// mesamis study: how well the surface is found from fewer and fewer slices.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "arguments.h"
#include "commands.h"
#include "costs.h"
#include "frames_option.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"
#include "mesamis/files/output_set.h"
#include "mesamis/method/memory.h"
#include "mesamis/report/json_file.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/shape_files/surface_pair.h"
#include "mesamis/study/experiment.h"
#include "mesamis/study/study_diagrams.h"
#include "mesamis/study/study_json.h"
#include "mesamis/study/study_run.h"
#include "mesamis/study/study_tables.h"
#include "mesamis/surface/unused_points.h"
#include "progress.h"
#include "scan.h"
#include "settings_options.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReport = "study.json";

struct StudyCommand {
  fs::path input, reference, folder;
  ReadOptions read;
  std::vector<int> subsample, region_subsample{1, 2, 4};
  std::optional<CropRange> region;
  std::vector<std::string> of_region;  // options given that mean nothing without --region
  FrameRule frames = FrameRule::kAuto;
  Frame frame = Frame::kLps;
  SettingsArguments settings;
};

/// Whole numbers from 1 on, each once: every run has its own files.
std::vector<int> parse_steps(const std::string& text, const std::string& option) {
  const std::vector<int> steps = parse_integers(text, option);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto end = steps.begin() + static_cast<std::ptrdiff_t>(i);
    if (steps[i] < 1 || std::find(steps.begin(), end, steps[i]) != end) {
      throw CLI::ValidationError(
          option, "expected whole numbers from 1 on, each once, found '" + text + "'");
    }
  }
  return steps;
}

/// Checks the folder; make_folder() makes it when there is something to put in.
void require_folder(const fs::path& folder) {
  const fs::path above = fs::absolute(folder).parent_path();
  if (fs::exists(folder) ? !fs::is_directory(folder) : !fs::is_directory(above)) {
    throw InputError(folder.string() + ": expected a folder, or a name in one that exists");
  }
  require_writable(fs::exists(folder) ? folder / kReport : above / folder.filename());
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) throw InputError(folder.string() + ": cannot be made: " + error.message());
}

/// The files in a folder, by name, and when they were written; none where there is no folder.
std::map<std::string, fs::file_time_type> files_in(const fs::path& folder) {
  std::map<std::string, fs::file_time_type> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    if (entry.is_regular_file()) files[entry.path().filename()] = entry.last_write_time();
  }
  return files;
}

/// Names the files that were in the folder before and were not written again: those of an earlier
/// study look like results of this one.
void warn_of_older(const fs::path& folder,
                   const std::map<std::string, fs::file_time_type>& before) {
  std::string names;
  for (const auto& [name, time] : files_in(folder)) {
    const auto earlier = before.find(name);
    if (earlier == before.end() || earlier->second != time) continue;
    names += (names.empty() ? "" : ", ") + name;
  }
  if (!names.empty()) {
    log_warning(folder.string() + ": these files in it are not of this study: " + names);
  }
}

std::vector<Experiment> plan(const StudyCommand& command, const Volume& scan) {
  const Settings settings = settings_of(command.settings);
  std::vector<Experiment> experiments;
  if (!command.subsample.empty()) {
    experiments.push_back(subsampling_experiment(scan, settings, command.subsample));
  }
  if (command.region) {
    experiments.push_back(
        region_experiment(scan, *command.region, settings, command.region_subsample));
  }
  return experiments;
}

/// The reference as its file has it, and in the scan's frame as far as is known.
struct Reference {
  SurfaceFile file;
  TriMesh surface;
};

Reference read_reference(const StudyCommand& command) {
  Reference reference{read_surface_file(command.reference, command.read.limits), {}};
  reference.surface = without_unused_points(reference.file.surface);
  if (must_turn(reference.file.frame, Frame::kLps, command.frames)) {
    reference.surface = turned(std::move(reference.surface));
  }
  return reference;
}

/// A figure of the table, or a dash.
std::string number_text(const std::optional<double>& value, const char* format) {
  if (!value) return "-";
  char number[32];
  std::snprintf(number, sizeof number, format, *value);
  return number;
}

/// The table for people, on stdout.
void print_table(const std::vector<StudyRun>& runs) {
  std::printf("%-12s %7s %9s %9s %8s %9s %9s %9s %9s\n", "run", "slices", "tets", "triangles",
              "seconds", "ref->surf", "by area", "surf->ref", "by area");
  for (const StudyRun& run : runs) {
    const auto figure = [&run](const char* format, auto value) {
      return number_text(run.summary ? std::optional<double>(value(*run.summary)) : std::nullopt,
                         format);
    };
    const auto mean = [&run](auto value) -> std::string {
      return run.comparison ? significant_text(value(*run.comparison).mean, 4) : "-";
    };
    using Figures = const RunSummary&;
    using Compared = const RunComparison&;
    std::printf("%-12s %7s %9s %9s %8s %9s %9s %9s %9s\n", run.plan.name.c_str(),
                figure("%.0f", [&run](Figures) { return run.grid.size[2]; }).c_str(),
                figure("%.0f", [](Figures r) { return r.tets; }).c_str(),
                figure("%.0f", [](Figures r) { return r.triangles; }).c_str(),
                figure("%.1f", [](Figures r) { return r.seconds.total; }).c_str(),
                mean([](Compared c) { return c.reference_to_surface.vertices; }).c_str(),
                mean([](Compared c) { return c.reference_to_surface.area; }).c_str(),
                mean([](Compared c) { return c.surface_to_reference.vertices; }).c_str(),
                mean([](Compared c) { return c.surface_to_reference.area; }).c_str());
  }
}

/// A study while it runs.
struct Study {
  const StudyCommand& command;
  const CommonOptions& common;
  Reference reference;
  StudyRecord record;
  std::string remarks;  ///< of the runs whose outcome is not kKept
};

/// Segments one volume. A run that fails is marked, and the study continues, but for the first one
/// with an InputError: then it is the input that is refused.
StudyRun segment(const Study& study, const Experiment& experiment, const PlannedRun& plan) {
  ProgressDisplay display(study.common.quiet);
  const Progress show = display.callback();
  const Progress progress = [&](std::string_view stage, double share) {
    return show(plan.name + ": " + std::string(stage), share);
  };
  try {
    return segment_planned(experiment, plan, progress);
  } catch (const InputError& error) {
    if (!study.record.frames) throw InputError(plan.name + ": " + error.what());
    return failed_run(plan, error.what());
  } catch (const NumericalError& error) {
    return failed_run(plan, error.what());
  }
}

/// All runs lie in the scan's frame: one of them tells whether the reference does.
void require_one_frame(Study& study, const StudyRun& run) {
  if (study.record.frames) return;
  SurfacePair pair = pair_up(study.reference.file, {run.surface, Frame::kLps}, study.command.frames,
                             "the surface of " + run.plan.name);
  for (const std::string& warning : pair.warnings) log_warning(warning);
  pair.reference = pair.surface = {};
  study.record.frames = std::move(pair);
}

/// Segments, writes the surface and compares it.
StudyRun complete_run(Study& study, const Experiment& experiment, const PlannedRun& plan) {
  StudyRun run = segment(study, experiment, plan);
  if (!run.surface.triangles.empty()) {
    require_one_frame(study, run);
    make_folder(study.command.folder);
    run.surface_file = plan.name + ".ply";
    write_surface(study.command.folder / run.surface_file, run.surface,
                  {.frame = study.command.frame});
  }
  run = with_comparison(study.reference.surface, experiment, std::move(run));
  run.surface = {};
  if (run.outcome != VerdictKind::kKept) {
    study.remarks += (study.remarks.empty() ? "" : "; ") + run.plan.name + ": " + run.remark;
  }
  return run;
}

/// Writes the tables after every run: an interrupted study keeps those of the finished runs.
void run_experiment(Study& study, const Experiment& experiment) {
  const fs::path& folder = study.command.folder;
  std::vector<StudyRun> runs;
  for (const PlannedRun& plan : experiment.runs) {
    runs.push_back(complete_run(study, experiment, plan));
    runs = with_distance_variations(std::move(runs));
    make_folder(folder);
    write_tables(folder, experiment.prefix, runs);
  }
  for (const std::string& name : draw_diagrams(folder, experiment.prefix, runs)) {
    study.record.pictures.push_back(name);
  }
  print_table(runs);
  study.record.experiments.push_back({experiment.name, experiment.settings, std::move(runs)});
}

/// The record of a study before its first run.
StudyRecord begin_record(const StudyCommand& command, const VolumeFile& scan,
                         const Reference& reference) {
  StudyRecord record;
  record.input = facts_of({command.input, scan.format, scan.warnings, scan.files}, scan.volume);
  record.frame = command.frame;
  record.reference = command.reference;
  record.reference_triangles = static_cast<std::int64_t>(reference.surface.triangles.size());
  record.reference_vertices = static_cast<std::int64_t>(reference.surface.points.size());
  record.settings = settings_of(command.settings);
  return record;
}

/// Refuses what can be refused before the first run.
void require_all(const Study& study, const std::vector<Experiment>& experiments) {
  for (const Experiment& experiment : experiments) {
    try {
      require_inside(study.reference.surface, experiment);
    } catch (const InputError& error) {
      throw InputError(study.command.reference.string() + ": " + error.what());
    }
  }
  for (const Experiment& experiment : experiments) {
    require_memory(experiment.volume, experiment.settings, study.common.limits.memory_gb);
  }
}

int run_experiments(Study& study, const std::vector<Experiment>& experiments) {
  const auto before = files_in(study.command.folder);
  for (const Experiment& experiment : experiments) run_experiment(study, experiment);
  nlohmann::ordered_json report = study_json(study.record);
  add_costs(report);
  write_json(study.command.folder / kReport, report);
  warn_of_older(study.command.folder, before);
  if (!study.remarks.empty()) log_error(study.remarks);
  return exit_status(study.record.outcome());
}

int run_study(const StudyCommand& command, const CommonOptions& common) {
  require_beside(command.of_region, command.region.has_value(), "--region beside it, found none");
  if (command.subsample.empty() && !command.region) {
    throw CLI::ValidationError("study", "expected --subsample, --region or both, found neither");
  }
  require_folder(command.folder);
  VolumeFile scan = read_scan(command.input, command.read);
  const std::vector<Experiment> experiments = plan(command, scan.volume);
  Reference reference = read_reference(command);
  StudyRecord record = begin_record(command, scan, reference);
  scan.volume.samples = {};  // the experiments have what they need of it
  Study study{command, common, std::move(reference), std::move(record), {}};
  require_all(study, experiments);
  return run_experiments(study, experiments);
}

void add_study_options(CLI::App& c, const std::shared_ptr<StudyCommand>& o) {
  c.add_option("--reference", o->reference, "Surface that is taken for true")->required();
  c.add_option("-o,--output", o->folder, "Folder of all that is written; made if need be")
      ->required();
  c.add_option_function<std::string>(
       "--subsample", [o](const std::string& t) { o->subsample = parse_steps(t, "--subsample"); },
       "S,S,...: a run for each, on every S-th slice of the scan")
      ->type_name("S,S,...");
  c.add_option_function<std::string>(
       "--region", [o](const std::string& t) { o->region = parse_crop(t, "--region"); },
       "I0:I1,J0:J1,K0:K1, voxels: runs on this part, with all voxels and with every second in "
       "the plane")
      ->type_name("RANGES");
  c.add_option_function<std::string>(
       "--region-subsample",
       [o](const std::string& t) { o->region_subsample = parse_steps(t, "--region-subsample"); },
       "S,S,...: of the latter, one for each, on every S-th slice (default 1,2,4)")
      ->type_name("S,S,...")
      ->each(noted(o->of_region, "--region-subsample"));
  add_read_options(c, o->read);
  add_frames_option(c, o->frames);
  add_frame_option(c, o->frame);
}

}  // namespace

void add_study_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto options = std::make_shared<StudyCommand>();
  CLI::App* command = app.add_subcommand(
      "study", "Measure how the surface depends on the scan's resolution, against a reference");
  command->add_option("input", options->input, "Volume file, DICOM directory or file")->required();
  add_study_options(*command, options);
  add_settings_options(*command, options->settings);
  command->callback([options, &common, &action] {
    action = [options, &common] {
      options->read.limits = common.limits;
      return run_study(*options, common);
    };
  });
}

}  // namespace mesamis
