// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/segment_in_slabs.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "mesamis/method/chosen_run.h"
#include "mesamis/report/label_report.h"
#include "mesamis/report/mesh_output.h"
#include "mesamis/run/outcome_details.h"
#include "mesamis/shape_files/mesh_files.h"

namespace mesamis::detail::run {
namespace {

namespace fs = std::filesystem;

/// Writes meshes slab by slab, and at the end the indices of their pieces.
class PieceWriter {
 public:
  explicit PieceWriter(const SlabRequest& request) : request_(request) {}

  /// Its cells have the mean of the voxels in them.
  void write(Index slab, const Result& piece, const VolumeView& scan) {
    const MeshWithArrays grid = make_mesh_piece(piece, scan);
    for (const OutputPath& path : request_.piece_meshes) {
      const std::string name = path.stem().string() + "_" + std::to_string(slab) + ".vtu";
      pieces_[path].push_back(name);
      write_vtu({fs::path(path).replace_filename(name), path.set}, grid.mesh,
                {grid.point_arrays, grid.cell_arrays, request_.frame});
    }
    for (const MeshArray& array : grid.point_arrays) keep(array, index_.point_arrays);
    for (const MeshArray& array : grid.cell_arrays) keep(array, index_.cell_arrays);
  }

  void write_indices() const {
    for (const auto& [path, pieces] : pieces_) {
      write_pvtu(path, pieces, index_.point_arrays, index_.cell_arrays);
    }
  }

 private:
  /// All pieces have the same arrays.
  static void keep(const MeshArray& array, std::vector<MeshArray>& known) {
    const auto is_same = [&](const MeshArray& other) { return other.name == array.name; };
    if (std::any_of(known.begin(), known.end(), is_same)) return;
    known.push_back({array.name, array.components, {}});
  }

  const SlabRequest& request_;
  std::map<OutputPath, std::vector<std::string>> pieces_;  // names, by index
  MeshWithArrays index_;                                   // names and components of the arrays
};

std::string of_one_level(const VoxelGrid& grid, const SlabRunOptions& options) {
  return "--level local: expected at most " + std::to_string(options.most_looked_at) +
         " voxels of a CT in slabs, found " + std::to_string(grid.voxel_count()) +
         ": one level for all places (take a crop, or every n-th voxel)";
}

void add_triangle_warnings(OutcomeDetails& outcome) {
  for (std::string& line : triangle_warnings(outcome)) outcome.warnings.push_back(std::move(line));
}

OutcomeDetails outcome_of(const SlabRequest& request, SlabRunResult& work) {
  OutcomeDetails outcome;
  outcome.asked = request.settings;
  outcome.grid = request.source.grid();
  outcome.one = std::move(work.result);
  outcome.grey = std::move(work.grey);
  outcome.wanted = {one_object()};
  if (work.is_too_large) outcome.warnings.push_back(of_one_level(outcome.grid, request.slabs));
  add_triangle_warnings(outcome);
  judge_surfaces(outcome);
  return outcome;
}

}  // namespace

std::optional<SlabOutcome> segment_in_slabs(const SlabRequest& request, const fs::path& scratch,
                                            Team& team) {
  std::optional<MappedScan> scan;
  const auto samples = [&]() -> const VolumeView& {
    if (!scan) scan.emplace(map_scan(request.source, scratch));
    return scan->volume;
  };
  PieceWriter pieces(request);
  SlabRunOptions options = request.slabs;
  if (!request.piece_meshes.empty()) {
    options.take_piece = [&](Index s, const Result& piece) { pieces.write(s, piece, samples()); };
  }
  auto work = run_in_slabs(request.source, request.settings, options, team);
  if (!work) return std::nullopt;
  OutcomeDetails outcome = outcome_of(request, *work);
  if (options.mesh) outcome.in_place = samples().samples;
  pieces.write_indices();
  return SlabOutcome{Outcome(std::move(outcome)), *std::move(work), std::move(scan)};
}

std::optional<LabelSlabOutcome> segment_labels_in_slabs(const LabelSlabRun& run,
                                                        const fs::path& scratch, Team& team) {
  OutcomeDetails outcome;
  outcome.asked = run.settings;
  std::optional<MappedScan> scan;
  LabelSlabRequest labels = run.labels;
  if (run.scan != nullptr) {
    labels.scan = run.scan->grid();
    labels.find = [&](const LabelRequest& extracted) {
      scan.emplace(map_scan(*run.scan, scratch));
      Request request{.scan = scan->volume, .labels = LabelChoice{}, .settings = run.settings};
      choose_image(request, {}, outcome);
      return run_on_labels(ObjectInPlace{*outcome.object, outcome.image()}, extracted, run.settings,
                           run.slabs.progress);
    };
  }
  auto work = label_surfaces_in_slabs(labels, run.settings, run.slabs, team);
  if (!work) return std::nullopt;
  if (!scan) outcome.grid = work->head;
  outcome.several = std::move(work->result);
  outcome.wanted = work->chosen;
  outcome.warnings = missing_objects(*outcome.several, outcome.wanted);
  add_triangle_warnings(outcome);
  judge_surfaces(outcome);
  return LabelSlabOutcome{Outcome(std::move(outcome)), *std::move(work), std::move(scan)};
}

}  // namespace mesamis::detail::run
