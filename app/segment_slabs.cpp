// SPDX-License-Identifier: Apache-2.0
#include "segment_slabs.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "deliver.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/run/segment_in_slabs.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/volume_files/rounding_record.h"
#include "outputs.h"
#include "progress.h"
#include "scan.h"
#include "segment_checks.h"
#include "segment_run.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

/// What tells a scan from another of the same name: a folder's files are not looked at.
std::string identity_of(const fs::path& path) {
  const auto written = fs::last_write_time(path).time_since_epoch().count();
  const auto bytes = fs::is_regular_file(path) ? fs::file_size(path) : 0;
  return fs::absolute(path).string() + " " + std::to_string(bytes) + " " + std::to_string(written);
}

/// The same of labels, with what is chosen of them.
std::string identity_of(const LabelArguments& labels) {
  std::string text = identity_of(labels.file);
  if (!labels.names.empty()) text += " " + identity_of(labels.names);
  for (const std::string& name : labels.chosen) text += " label " + name;
  if (labels.margin) text += " margin " + std::to_string(*labels.margin);
  return text + " ";
}

bool is_in_pieces(const fs::path& mesh) { return lower_extension(mesh) == kPiecesExtension; }

/// The meshes that are written in pieces, or those that are written at once.
Paths meshes_of(const SegmentOptions& run, bool in_pieces) {
  Paths meshes;
  std::copy_if(run.out.meshes.begin(), run.out.meshes.end(), std::back_inserter(meshes),
               [=](const fs::path& mesh) { return is_in_pieces(mesh) == in_pieces; });
  return meshes;
}

/// Whether a file has the name of a piece of a mesh: F_0.vtu for F.pvtu.
bool is_piece_of(const fs::path& index, const fs::path& file) {
  const fs::path there = fs::absolute(index), piece = fs::absolute(file);
  const std::string begin = there.stem().string() + "_", name = piece.stem().string();
  return piece.parent_path() == there.parent_path() && lower_extension(piece) == ".vtu" &&
         name.rfind(begin, 0) == 0 && name.size() > begin.size() &&
         name.find_first_not_of("0123456789", begin.size()) == std::string::npos;
}

/// The pieces of a mesh are written beside its index: nothing else may have their names.
void require_room_for_pieces(const SegmentOptions& run) {
  for (const fs::path& index : run.out.meshes) {
    if (!is_in_pieces(index)) continue;
    for (const fs::path& other : run.out.meshes) {
      if (!is_piece_of(index, other)) continue;
      throw CLI::ValidationError("--mesh", "expected a name other than that of a piece of " +
                                               index.string() + ", found " + other.string());
    }
  }
}

/// Whether a surface is to carry grey values, which are those of the mesh below it.
bool wants_grey(const SegmentOptions& run) {
  return std::any_of(run.out.surfaces.begin(), run.out.surfaces.end(), carries_grey);
}

fs::path first_output(const SegmentOptions& run) {
  if (!run.out.surfaces.empty()) return run.out.surfaces.front();
  return run.out.meshes.empty() ? run.out.report : run.out.meshes.front();
}

/// Without a place for checkpoints, scratch files lie beside the first output.
SlabRunOptions slab_options(const SegmentOptions& run, const SlabArguments& slabs,
                            const Progress& progress) {
  SlabRunOptions options;
  if (slabs.slabs.value_or(0) > 0) options.turns = slabs.slabs;
  options.scratch = slabs.checkpoint;
  options.resumable = !slabs.checkpoint.empty();
  options.progress = progress;
  if (run.scan.labels.given()) options.input += identity_of(run.scan.labels);
  if (!run.scan.input.empty()) options.input += identity_of(run.scan.input);
  options.mesh = !meshes_of(run, false).empty();
  options.grey = wants_grey(run);
  if (options.scratch.empty()) options.scratch = first_output(run) += ".slabs";
  return options;
}

[[noreturn]] void refuse_with_slabs(const std::string& option) {
  throw CLI::ValidationError(
      "--slabs", "expected no option that needs the whole scan at once, found " + option);
}

nlohmann::ordered_json slabs_json(const SlabRunResult& found, const Team& team) {
  auto each = nlohmann::ordered_json::array();
  for (std::size_t s = 0; s < found.slabs.size(); ++s) {
    const SlabWork& work = found.slabs[s];
    each.push_back({{"first_slice", found.plan.cuts[s]},
                    {"slices", found.plan.cuts[s + 1] - found.plan.cuts[s]},
                    {"first_slice_of_mesh", found.mesh_plan.cuts[s]},
                    {"slices_of_mesh", found.mesh_plan.cuts[s + 1] - found.mesh_plan.cuts[s]},
                    {"voxels", work.voxels},
                    {"rows", work.rows},
                    {"cells", work.cells},
                    {"bytes_of_others", work.bytes},
                    {"seconds", work.seconds}});
  }
  return {{"count", found.plan.count()},
          {"processes", team.size()},
          {"overlap_mm", found.plan.overlap * found.plan.unit_mm},
          {"own_rows", found.own_rows},
          {"own_cells", found.own_cells},
          {"slabs", std::move(each)}};
}

/// What is needed of labels in more than their slabs.
void require_label_slabs(const SegmentOptions& run) {
  if (!run.scan.labels.probabilities.empty()) refuse_with_slabs("--probabilities");
  if (run.wants_mesh()) refuse_with_slabs("--mesh with --labels");
}

nlohmann::ordered_json slabs_json(const LabelSlabResult& found, const Team& team) {
  auto each = nlohmann::ordered_json::array();
  for (std::size_t s = 0; s < found.slabs.size(); ++s) {
    each.push_back({{"first_slice", found.cuts[s]},
                    {"slices", found.cuts[s + 1] - found.cuts[s]},
                    {"voxels", found.slabs[s].voxels},
                    {"seconds", found.slabs[s].seconds}});
  }
  return {{"count", found.slabs.size()}, {"processes", team.size()}, {"slabs", std::move(each)}};
}

/// Reads labels where they are read, and chooses of them on every process.
LabelSlabRequest label_request(const SegmentOptions& run) {
  LabelSlabRequest request;
  request.read = [&run] {
    ReadLabels labels;
    labels.map = read_named_labels(run.scan.labels, grid_of_scan(run.scan), labels.warnings);
    return labels;
  };
  request.choose = [&run](const LabelMap& head) {
    const std::vector<Segment> chosen = find_segments(head.segments, run.scan.labels.chosen);
    const std::vector<Segment>& wanted = chosen.empty() ? head.segments : chosen;
    require_object_files(run, wanted);
    return wanted;
  };
  request.margin = run.scan.labels.margin;
  return request;
}

/// What single precision takes from samples shows in the slice in the middle, before the run; that
/// slice alone may be of one value.
void warn_of_rounding(const SegmentOptions& run, const FileSlices& source) {
  const RoundingRecord rounded;
  source.read(source.grid().size[2] / 2, 1);
  std::vector<std::string> warnings;
  try {
    rounded.warn(run.scan.input, warnings);
  } catch (const InputError& error) {
    warnings.emplace_back(error.what());
  }
  for (const std::string& warning : warnings) log_warning(warning);
}

/// Opens the scan of a run, and logs the reader's warnings.
std::unique_ptr<FileSlices> open_slices_of(const SegmentOptions& run) {
  std::unique_ptr<FileSlices> source = open_any_slices(run.scan.input, run.scan.read);
  for (const std::string& warning : source->head().warnings) log_warning(warning);
  warn_of_rounding(run, *source);
  return source;
}

/// Lets the report tell of the slabs too.
void tell_of_slabs(ReportFacts& facts, nlohmann::ordered_json slabs) {
  facts.complete = [slabs = std::move(slabs),
                    others = facts.complete](nlohmann::ordered_json& report) {
    report["slabs"] = slabs;
    others(report);
  };
}

/// Of the report: a scan that is read a few slices at a time. Its samples were not all looked at,
/// and its files are too large for a sum.
InputFacts facts_of_slices(const SegmentOptions& run, const FileSlices& source) {
  const VolumeFile& head = source.head();
  return facts_of({run.scan.input, head.format, head.warnings, {}}, head.volume);
}

int run_label_slabs(const SegmentOptions& run, const SlabArguments& slabs, const Settings& settings,
                    const CommonOptions& common) {
  require_several(run);
  const bool has_scan = !run.scan.input.empty();
  std::unique_ptr<FileSlices> source;
  if (has_scan) source = open_slices_of(run);
  ProgressDisplay display(common.quiet || common.is_helper(),
                          stage_shares({.labels = true, .scan = has_scan, .slabs = true}));
  const LabelSlabRun request{label_request(run), source.get(), settings,
                             slab_options(run, slabs, display.callback())};
  const auto found =
      segment_labels_in_slabs(request, fs::absolute(first_output(run)).parent_path(), *common.team);
  display.finish();
  if (!found) return kExitDone;
  const OutcomeDetails& outcome = found->outcome.details();
  for (const std::string& warning : outcome.warnings) log_warning(warning);
  RunFiles out = outputs_of(run, common);
  if (source) out.facts.input = facts_of_slices(run, *source);
  out.facts.warnings.insert(out.facts.warnings.end(), found->work.warnings.begin(),
                            found->work.warnings.end());
  tell_of_slabs(out.facts, slabs_json(found->work, *common.team));
  OutputSet set;
  return deliver(outcome, out, set, display);
}

RunFiles outputs_of(const SegmentOptions& run, const FileSlices& source, const SlabOutcome& found,
                    const CommonOptions& common) {
  RunFiles out = outputs_of(run, common);
  out.meshes = meshes_of(run, false);
  out.facts.input = facts_of_slices(run, source);
  const std::vector<std::string> warnings = found.outcome.warnings();
  out.facts.warnings.insert(out.facts.warnings.end(), warnings.begin(), warnings.end());
  tell_of_slabs(out.facts, slabs_json(found.work, *common.team));
  return out;
}

}  // namespace

void add_slab_options(CLI::App& command, SlabArguments& arguments) {
  command
      .add_option_function<std::string>(
          "--slabs",
          [&arguments](const std::string& text) {
            arguments.slabs = text == "auto" ? 0 : parse_integers(text, 1, "--slabs").front();
            if (*arguments.slabs < (text == "auto" ? 0 : 1)) {
              throw CLI::ValidationError("--slabs", "expected at least 1, found " + text);
            }
          },
          "Work on an Nth of the scan at a time (auto: on 67 million voxels), for scans larger "
          "than "
          "the memory; the surface does not depend on N; scratch files lie beside the "
          "first output")
      ->type_name("N|auto");
  command
      .add_option("--checkpoint", arguments.checkpoint,
                  "Folder for the scratch files of --slabs: a killed run resumes "
                  "there; removed at the end")
      ->type_name("DIR");
}

void require_slabs(const SegmentOptions& run, const Settings& settings) {
  const auto refuse = refuse_with_slabs;
  if (run.scan.labels.given()) require_label_slabs(run);
  if (run.scan.places.given()) refuse("--tissue, --seed, --box, --mask, --remove or --padding");
  if (!run.out.band_meshes.empty()) refuse("--band-mesh");
  require_room_for_pieces(run);
  if (run.out.mesh.region == MeshRegion::kObject &&
      std::any_of(run.out.meshes.begin(), run.out.meshes.end(), is_in_pieces)) {
    refuse("--mesh-region object for a .pvtu");
  }
  if (run.body.elements()) refuse("--body or --surface-quality");
  if (!run.out.labelmap.empty()) refuse("--labelmap");
  if (run.out.page.given()) refuse("--html or --pictures");
  if (settings.preview) refuse("--preview");
  if (!(settings.crop == CropRange{})) refuse("--crop");
  if (run.scan.input.empty() && !run.scan.labels.given()) {
    throw CLI::ValidationError("input", "expected a scan, found none");
  }
}

int run_slabs(const SegmentOptions& run, const SlabArguments& slabs, const Settings& settings,
              const CommonOptions& common) {
  if (run.scan.labels.given()) return run_label_slabs(run, slabs, settings, common);
  Team& team = *common.team;
  const std::unique_ptr<FileSlices> source = open_slices_of(run);
  ProgressDisplay display(common.quiet || common.is_helper(), stage_shares({.slabs = true}));
  std::optional<OutputSet> set;
  if (team.rank() == 0) set.emplace();
  SlabRequest request{
      *source, settings, slab_options(run, slabs, display.callback()), {}, run.scan.frame};
  for (const fs::path& path : meshes_of(run, true)) {
    request.piece_meshes.emplace_back(path, set ? &*set : nullptr);
  }
  fs::path folder;  // of a copy of the scan
  if (!run.out.meshes.empty()) folder = fs::absolute(run.out.meshes.front()).parent_path();
  const auto found = segment_in_slabs(request, folder, team);
  display.finish();
  if (!found) return kExitDone;
  for (const std::string& warning : found->outcome.warnings()) log_warning(warning);
  return deliver(found->outcome.details(), outputs_of(run, *source, *found, common), *set, display);
}

}  // namespace mesamis
