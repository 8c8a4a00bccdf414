// SPDX-License-Identifier: Apache-2.0
// The readers of label maps, probabilities and label tables, and of settings.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "mesamis/label_files/label_table.h"
#include "mesamis/label_files/read_labels.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/settings_json.h"
#include "reader_targets.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

void require_labels(const LabelFile& file) {
  require_law(!file.format.empty(), "no format");
  for (const std::string& warning : file.warnings) require_one_line(warning);
  try {
    require_valid(file.map);
  } catch (const InputError& error) {
    require_law(false, std::string("a label map that is not valid: ") + error.what());
  }
}

void require_probabilities(const ProbabilityFile& file) {
  const Probabilities& p = file.probabilities;
  require_law(!p.layers.empty() && p.segments.size() == p.layers.size(), "objects are missing");
  for (const std::vector<float>& layer : p.layers) {
    require_law(layer.size() == p.voxel_count(), "values are missing");
    const bool valid =
        std::all_of(layer.begin(), layer.end(), [](float v) { return v >= 0 && v <= 1; });
    require_law(valid, "a value that is no probability");
  }
}

template <const char* kName>
void run_labels(std::string_view bytes) {
  const fs::path file = input_folder().write(kName, bytes);
  read_or_refuse(file, [](const fs::path& path) {
    require_labels(read_label_map(path, {.limits = fuzz_limits()}));
  });
  read_or_refuse(file, [](const fs::path& path) {
    require_probabilities(read_probabilities({path}, {.limits = fuzz_limits()}));
  });
}

/// A structure set, read with a scan and without.
void run_contours(std::string_view bytes) {
  const fs::path file = input_folder().write("rt.dcm", bytes);
  const auto scan = [] {
    VoxelGrid grid;
    grid.size = {20, 24, 10};
    grid.spacing = {0.5, 0.6, 2};
    grid.origin = {-4, -5, 1};
    grid.frame_of_reference = "1.2.9";
    return grid;
  };
  for (const bool with_scan : {true, false}) {
    read_or_refuse(file, [&](const fs::path& path) {
      LabelOptions options{.limits = fuzz_limits()};
      if (with_scan) options.scan = scan;
      require_labels(read_label_map(path, options));
    });
  }
}

/// A folder of two masks; the first byte tells how much of the bytes the first one has, in 256ths.
void run_masks(std::string_view bytes) {
  const std::size_t share = bytes.empty() ? 0 : static_cast<unsigned char>(bytes[0]);
  const std::string_view rest = bytes.substr(std::min<std::size_t>(1, bytes.size()));
  const std::size_t first = rest.size() * share / 256;
  const fs::path file = input_folder().write("a.nrrd", rest.substr(0, first));
  input_folder().write("b.nrrd", rest.substr(first));
  read_or_refuse(file, [](const fs::path& path) {
    require_labels(read_label_map(path.parent_path(), {.limits = fuzz_limits()}));
  });
}

void run_label_table(std::string_view bytes) {
  read_or_refuse(input_folder().write("names.txt", bytes), [](const fs::path& path) {
    for (const Segment& segment : read_label_table(path)) {
      require_law(segment.label > 0 || segment.number_in_file > kMaxLabel,
                  "the label of the background");
    }
  });
}

/// Settings that are read are written and read again as they are.
void run_settings_json(std::string_view bytes) {
  read_or_refuse(input_folder().write("settings.json", bytes), [](const fs::path& path) {
    const Settings settings = read_settings(path, {});
    require_valid(settings);
    write_json(path, to_json(settings));
    const Settings again = read_settings(path, {});
    for (const Setting& setting : setting_table()) {
      require_law(setting.get(again) == setting.get(settings),
                  "a setting that changes when it is written: " + setting.name);
    }
  });
}

constexpr char kNifti[] = "labels.nii", kNrrd[] = "labels.seg.nrrd", kDicom[] = "labels.dcm";

constexpr FuzzTarget kTargets[] = {
    {"label_nifti", run_labels<kNifti>},  {"label_nrrd", run_labels<kNrrd>},
    {"label_dicom", run_labels<kDicom>},  {"label_table", run_label_table},
    {"label_contours", run_contours},     {"label_masks", run_masks},
    {"settings_json", run_settings_json},
};

}  // namespace

std::span<const FuzzTarget> label_targets() { return kTargets; }

}  // namespace mesamis
