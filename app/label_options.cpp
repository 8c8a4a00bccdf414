// SPDX-License-Identifier: Apache-2.0
#include "label_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/label_files/label_table.h"

namespace mesamis {
namespace {

void log_all(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) log_warning(warning);
}

}  // namespace

void add_label_options(CLI::App& command, LabelArguments& a) {
  CLI::Option* const labels =
      command.add_option("--labels", a.file,
                         "Label map that says which objects are meant: NIfTI, NRRD, .seg.nrrd, "
                         "MetaImage, TIFF, DICOM SEG or RTSTRUCT, Zarr; a folder of masks, one "
                         "object per file, or of slices");
  command
      .add_option("--probabilities", a.probabilities,
                  "Instead of --labels: one volume of probabilities per object, or one of four "
                  "dimensions")
      ->excludes(labels);
  command.add_option("--label", a.chosen,
                     "Objects of the label map, by name or number; all if none");
  command.add_option(
      "--label-names", a.names,
      "Names and colours of the labels: ITK-SNAP .label, Slicer .ctbl, N NAME R G B");
  command.add_option("--margin", a.margin, "How far labels may be wrong, or around --mask, mm")
      ->check(CLI::PositiveNumber);
}

LabelMap read_marks(const std::filesystem::path& path, const LabelOptions& options,
                    std::vector<std::string>& warnings) {
  LabelFile file = read_label_map(path, options);
  log_all(file.warnings);
  warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
  return std::move(file.map);
}

NamedLabels read_labels(const LabelArguments& a, const std::function<VoxelGrid()>& scan) {
  NamedLabels labels;
  if (!a.file.empty()) {
    labels.map = read_marks(a.file, {a.limits, scan}, labels.warnings);
  } else {
    ProbabilityFile file = read_probabilities(a.probabilities, a.limits);
    log_all(file.warnings);
    labels.warnings = std::move(file.warnings);
    labels.map = most_probable(file.probabilities);
    labels.probabilities = std::move(file.probabilities);
  }
  if (!a.names.empty()) labels.map = with_names(std::move(labels.map), read_label_table(a.names));
  return labels;
}

LabelRequest label_request(const LabelArguments& a, const NamedLabels& labels) {
  const LabelMap& map = labels.map;
  LabelRequest request{map};
  if (labels.probabilities) request.probabilities = &*labels.probabilities;
  for (const std::string& wanted : a.chosen) {
    const Segment segment = find_segment(map.segments, wanted);
    const auto end = request.chosen.end();
    if (std::find(request.chosen.begin(), end, segment) == end) request.chosen.push_back(segment);
  }
  request.margin = a.margin;
  return request;
}

}  // namespace mesamis
