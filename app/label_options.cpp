// SPDX-License-Identifier: Apache-2.0
#include "label_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/label_files/label_table.h"
#include "ranges.h"

namespace mesamis {
namespace {

void log_all(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) log_warning(warning);
}

}  // namespace

LabelOptions read_like(const ReadOptions& scan, bool has_scan) {
  return {.limits = scan.limits,
          .spacing = has_scan ? std::nullopt : scan.spacing,
          .resample = scan.resample};
}

void add_label_options(CLI::App& command, LabelArguments& a) {
  CLI::Option* const labels =
      command.add_option("--labels", a.file,
                         "Label map of the objects: NIfTI, NRRD, .seg.nrrd, "
                         "MetaImage, TIFF, DICOM SEG or RTSTRUCT, Zarr; a folder of masks, one "
                         "object per file, or of slices");
  command
      .add_option("--probabilities", a.probabilities,
                  "Instead of --labels: one volume of probabilities per object, or one of four "
                  "dimensions")
      ->excludes(labels);
  command
      .add_option("--label", a.chosen, "Objects of the label map, by name or number (default: all)")
      ->type_name("NAME|N");
  command.add_option(
      "--label-names", a.names,
      "Names and colours of the labels: ITK-SNAP .label, Slicer .ctbl, N NAME R G B");
  command.add_option("--margin", a.margin, "Margin of error of the labels, or around --mask, mm")
      ->check(above_zero());
}

LabelMap read_marks(const std::filesystem::path& path, const LabelOptions& options,
                    std::vector<std::string>& warnings) {
  LabelFile file = read_label_map(path, options);
  log_all(file.warnings);
  warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
  return std::move(file.map);
}

LabelMap read_named_labels(const LabelArguments& a, const std::function<VoxelGrid()>& scan,
                           std::vector<std::string>& warnings) {
  LabelOptions how = a.read;
  how.scan = scan;
  LabelMap map = read_marks(a.file, how, warnings);
  return a.names.empty() ? map : with_names(std::move(map), read_label_table(a.names));
}

LabelChoice read_label_choice(const LabelArguments& a, const std::function<VoxelGrid()>& scan,
                              std::vector<std::string>& warnings) {
  LabelChoice choice;
  if (!a.file.empty()) {
    choice.map = read_named_labels(a, scan, warnings);
  } else {
    ProbabilityFile file = read_probabilities(a.probabilities, a.read);
    log_all(file.warnings);
    warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
    choice.map = most_probable(file.probabilities);
    choice.exact_by = std::move(file.probabilities);
    if (!a.names.empty()) choice.map = with_names(std::move(choice.map), read_label_table(a.names));
  }
  choice.chosen = find_segments(choice.map.segments, a.chosen);
  choice.margin = a.margin;
  return choice;
}

}  // namespace mesamis
