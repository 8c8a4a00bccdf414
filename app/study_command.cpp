// SPDX-License-Identifier: Apache-2.0
// mesamis study: how well the surface is found from fewer and fewer slices.
#include <algorithm>
#include <memory>
#include <optional>

#include "arguments.h"
#include "commands.h"
#include "json_file.h"
#include "log.h"
#include "memory_check.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/io/surface_files.h"
#include "mesamis/surface/unused_points.h"
#include "progress.h"
#include "report.h"
#include "scan.h"
#include "settings_json.h"
#include "settings_options.h"
#include "study.h"
#include "study_output.h"
#include "surface_pair.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct StudyCommand {
  fs::path input, reference, folder;
  std::string series;
  std::vector<int> subsample, region_subsample{1, 2, 4};
  std::optional<CropRange> region;
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

/// Made only when there is something to put in.
void require_folder(const fs::path& folder) {
  const fs::path above = fs::absolute(folder).parent_path();
  if (fs::exists(folder) ? !fs::is_directory(folder) : !fs::is_directory(above)) {
    throw InputError(folder.string() + ": expected a folder, or a name in one that exists");
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) throw InputError(folder.string() + ": cannot be made: " + error.message());
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
  Reference reference{read_surface_file(command.reference), {}};
  reference.surface = without_unused_points(reference.file.surface);
  if (must_turn(reference.file.frame, Frame::kLps, command.frames)) {
    reference.surface = turned(std::move(reference.surface));
  }
  return reference;
}

void require_inside(const Reference& reference, const StudyCommand& command,
                    const std::vector<Experiment>& experiments) {
  for (const Experiment& experiment : experiments) {
    const TriMesh part =
        part_inside(reference.surface, experiment.volume, experiment.volume.spacing);
    if (!part.triangles.empty()) continue;
    throw InputError(command.reference.string() + ": expected triangles inside the " +
                     (experiment.cut ? "region" : "scan") +
                     ", a voxel away from its faces, found none of " +
                     std::to_string(reference.surface.triangles.size()));
  }
}

class Study {
 public:
  Study(const StudyCommand& command, const CommonOptions& common)
      : command_(command), common_(common) {}

  int run() {
    require_folder(command_.folder);
    VolumeFile file = read_scan(command_.input, command_.series);
    const std::vector<Experiment> experiments = plan(command_, file.volume);
    const ordered_json input = input_json(facts_of(command_.input, file, command_.frame));
    file.volume.samples = {};  // the experiments have what they need of it
    reference_ = read_reference(command_);
    require_inside(reference_, command_, experiments);
    for (const Experiment& experiment : experiments) {
      require_memory(experiment.volume, experiment.settings, common_.memory_gb);
    }
    for (const Experiment& experiment : experiments) run_experiment(experiment);
    write_report(input);
    if (status_ != kExitDone) log_error(remarks_);
    return status_;
  }

 private:
  /// Tables are written after every run: an interrupted study keeps what it has.
  void run_experiment(const Experiment& experiment) {
    std::vector<StudyRun> runs;
    for (const PlannedRun& plan : experiment.runs) {
      runs.push_back(run_one(experiment, plan));
      note(runs.back());
      if (experiment.name == "region") add_variations(runs);
      make_folder(command_.folder);
      write_tables(command_.folder, experiment.prefix, runs);
    }
    for (const std::string& name : draw_pictures(command_.folder, experiment.prefix, runs)) {
      pictures_.push_back(name);
    }
    print_table(runs);
    ordered_json& entries = experiments_[experiment.name]["runs"];
    for (StudyRun& run : runs) entries.push_back(std::move(run.json));
  }

  StudyRun run_one(const Experiment& experiment, const PlannedRun& plan) {
    StudyRun run = attempt(experiment, plan);
    if (!run.surface.triangles.empty()) {
      require_one_frame(run);
      make_folder(command_.folder);
      const std::string name = plan.name + ".ply";
      write_surface(command_.folder / name, run.surface, {.frame = command_.frame});
      run.json["surface_file"] = name;
    }
    compare_with(reference_.surface, experiment, run);
    run.json["remark"] = run.remark;
    run.surface = {};
    return run;
  }

  /// What goes wrong in one run is no reason to give up those that went well: it is marked. Before
  /// any of these the input is refused.
  StudyRun attempt(const Experiment& experiment, const PlannedRun& plan) const {
    ProgressDisplay display(common_.quiet);
    const Progress show = display.callback();
    const Progress progress = [&](std::string_view stage, double share) {
      return show(plan.name + ": " + std::string(stage), share);
    };
    StudyRun run = begun(plan);
    try {
      return execute(experiment, plan, progress);
    } catch (const InputError& error) {
      if (frames_.is_null()) throw InputError(plan.name + ": " + error.what());
      mark_failed(run, error.what());
    } catch (const NumericalError& error) {
      mark_failed(run, error.what());
    }
    return run;
  }

  /// All runs lie in the scan's frame: one of them tells whether the reference does.
  void require_one_frame(const StudyRun& run) {
    if (!frames_.is_null()) return;
    const SurfacePair pair = pair_up(reference_.file, {run.surface, Frame::kLps}, command_.frames,
                                     "the surface of " + run.plan.name);
    frames_ = frames_json(pair);
  }

  /// Keeps the worst status, and why, for the end.
  void note(const StudyRun& run) {
    status_ = std::max(status_, run.status);
    if (run.status == kExitDone) return;
    remarks_ += (remarks_.empty() ? "" : "; ") + run.plan.name + ": " + run.remark;
  }

  void write_report(const ordered_json& input) const {
    ordered_json report;
    report["program"] = program_json();
    report["input"] = input;
    report["output"] = {{"frame", command_.frame == Frame::kRas ? "ras" : "lps"},
                        {"threads", thread_count()}};
    report["reference"] = {{"path", command_.reference.string()},
                           {"triangles", reference_.surface.triangles.size()},
                           {"vertices", reference_.surface.points.size()}};
    report["frames"] = frames_;
    report["settings"] = to_json(settings_of(command_.settings));
    report.update(experiments_);
    report["pictures"] = pictures_;
    report["converged"] = status_ == kExitDone;
    add_costs(report);
    write_json(command_.folder / "study.json", report);
  }

  const StudyCommand& command_;
  const CommonOptions& common_;
  Reference reference_;
  ordered_json experiments_ = ordered_json::object(), frames_;
  ordered_json pictures_ = ordered_json::array();
  int status_ = kExitDone;
  std::string remarks_;
};

int run_study(const StudyCommand& command, const CommonOptions& common) {
  if (command.subsample.empty() && !command.region) {
    throw CLI::ValidationError("study", "expected --subsample, --region or both, found neither");
  }
  return Study(command, common).run();
}

CropRange parse_region(const std::string& text) {
  Settings settings;
  as_usage([&] { from_json({{"crop", crop_ranges(text, "--region")}}, settings); });
  return settings.crop;
}

void add_study_options(CLI::App& c, const std::shared_ptr<StudyCommand>& o) {
  c.add_option("--reference", o->reference, "Surface that is taken for true")->required();
  c.add_option("-o,--output", o->folder, "Folder of all that is written; made if need be")
      ->required();
  c.add_option_function<std::string>(
      "--subsample", [o](const std::string& t) { o->subsample = parse_steps(t, "--subsample"); },
      "S,S,...: a run for each, on every S-th slice of the scan");
  c.add_option_function<std::string>(
      "--region", [o](const std::string& t) { o->region = parse_region(t); },
      "I0:I1,J0:J1,K0:K1, voxels: runs on this part, with all voxels and with every second in "
      "the plane");
  c.add_option_function<std::string>(
      "--region-subsample",
      [o](const std::string& t) { o->region_subsample = parse_steps(t, "--region-subsample"); },
      "S,S,...: of the latter, one for each, on every S-th slice (default 1,2,4)");
  c.add_option("--series", o->series, "DICOM series UID");
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
    action = [options, &common] { return run_study(*options, common); };
  });
}

}  // namespace mesamis
