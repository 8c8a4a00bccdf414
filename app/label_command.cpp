// SPDX-License-Identifier: Apache-2.0
// mesamis label: converts closed surfaces to a label map on the grid of a scan.
#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "arguments.h"
#include "commands.h"
#include "label_lines.h"
#include "label_options.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/label_files/read_labels.h"
#include "mesamis/label_files/write_labels.h"
#include "mesamis/report/label_output.h"
#include "mesamis/shape_files/object_files.h"
#include "outputs.h"
#include "scan.h"
#include "segment_checks.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct LabelCommand {
  Paths surfaces;
  fs::path like, output;
  ReadOptions read;
  Frame frame = Frame::kLps;
};

/// The grid of a scan, or of a label map.
VoxelGrid grid_like(const LabelCommand& command) {
  if (command.read.raw || !is_label_file(command.like, command.read.limits)) {
    return read_any_grid(command.like, command.read);
  }
  return read_label_map(command.like, read_like(command.read, false)).map;
}

/// A file of one object names it; that of several does.
std::vector<NamedSurface> objects_of(const fs::path& path, const LabelCommand& command) {
  ObjectFile file = read_object_file(path, command.read.limits);
  if (!file.frame) file.frame = command.frame;
  const bool one = file.objects.size() == 1;
  std::vector<NamedSurface> objects = in_lps(std::move(file));
  if (one) objects[0].name = path.stem().string();
  for (const NamedSurface& object : objects) {
    const SurfaceCheck check = check_surface(object.surface);
    if (check.closed()) continue;
    throw InputError(path.string() + ": expected a closed surface, found " + flaws_of(check) +
                     (one ? "" : " in '" + object.name + "'"));
  }
  return objects;
}

/// Labels of a file are kept where no two of all files are alike; else they are 1, 2, ...
void number_objects(std::vector<NamedSurface>& objects) {
  std::vector<Index> labels;
  labels.reserve(objects.size());
  for (const NamedSurface& object : objects) labels.push_back(object.label);
  std::sort(labels.begin(), labels.end());
  const bool distinct = std::adjacent_find(labels.begin(), labels.end()) == labels.end();
  if (distinct && labels.front() > 0 && labels.back() <= kMaxLabel) return;
  for (std::size_t n = 0; n < objects.size(); ++n) objects[n].label = static_cast<Index>(n + 1);
}

int run_label(const LabelCommand& command) {
  require_labelmap(command.output, "--output");
  Paths inputs = command.surfaces;
  inputs.push_back(command.like);
  require_distinct_files({command.output}, inputs);
  std::vector<NamedSurface> objects;
  for (const fs::path& path : command.surfaces) {
    std::vector<NamedSurface> more = objects_of(path, command);
    std::move(more.begin(), more.end(), std::back_inserter(objects));
  }
  number_objects(objects);
  std::vector<FoundObject> found;
  found.reserve(objects.size());
  for (const NamedSurface& object : objects) {
    found.push_back({object.surface, {object.name, object.label, 0, object.colour}});
  }
  const SurfaceLabels labels = labels_of_surfaces(grid_like(command), found);
  for (const std::string& warning : labels.warnings) log_warning(warning);
  write_label_map(command.output, labels.map);
  print_labels(labels.map);
  return kExitDone;
}

}  // namespace

void add_label_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto options = std::make_shared<LabelCommand>();
  CLI::App* command =
      app.add_subcommand("label", "Convert closed surfaces to a label map on the grid of a scan");
  command
      ->add_option("surfaces", options->surfaces,
                   listed("Surfaces, an object each or several in a file:", read_surface_formats()))
      ->required();
  command->add_option("--like", options->like, "Scan, or label map, whose grid is taken")
      ->required();
  command->add_option("-o,--output", options->output, "Label map: .nii .nii.gz .nrrd .seg.nrrd")
      ->required();
  command
      ->add_option_function<std::string>(
          "--frame",
          [options](const std::string& name) {
            options->frame = name == "ras" ? Frame::kRas : Frame::kLps;
          },
          "Frame of surfaces whose files state none (default lps)")
      ->check(CLI::IsMember({"lps", "ras"}));
  add_read_options(*command, options->read);
  command->callback([options, &common, &action] {
    action = [options, &common] {
      options->read.limits = common.limits;
      return run_label(*options);
    };
  });
}

}  // namespace mesamis
