// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/label_files/read_labels.h"
#include "mesamis/run/segment.h"
#include "mesamis/volume_files/read_volume.h"

namespace CLI {
class App;
}  // namespace CLI

/// The options that say by labels which object is meant.
namespace mesamis {

struct LabelArguments {
  std::filesystem::path file;                        ///< --labels; may be empty
  std::vector<std::filesystem::path> probabilities;  ///< --probabilities
  std::vector<std::string> chosen;                   ///< --label, names or numbers; empty: all
  std::filesystem::path names;                       ///< --label-names, may be empty
  std::optional<double> margin;                      ///< --margin, mm
  LabelOptions read{};                               ///< but for the scan, see read_like()

  /// Whether the user names a label map.
  bool given() const { return !file.empty() || !probabilities.empty(); }
};

/// How label maps and probabilities are read beside a scan, or without one, whose spacing is then
/// theirs.
/// @param scan  as it is asked for.
LabelOptions read_like(const ReadOptions& scan, bool has_scan);

/// Adds the options. `arguments` must outlive the parsing.
void add_label_options(CLI::App& command, LabelArguments& arguments);

/// Reads a label map and logs the reader's warnings.
/// @param warnings  the reader's are added.
/// @throws InputError  as read_label_map().
LabelMap read_marks(const std::filesystem::path& path, const LabelOptions& options,
                    std::vector<std::string>& warnings);

/// The same for the map of --labels, with the names of --label-names.
/// @param scan  see LabelOptions::scan.
/// @throws InputError  as the readers.
LabelMap read_named_labels(const LabelArguments& arguments, const std::function<VoxelGrid()>& scan,
                           std::vector<std::string>& warnings);

/// Reads the label map, logs the reader's warnings, names its labels, and chooses those that the
/// options name.
/// @param scan      see LabelOptions::scan.
/// @param warnings  the reader's are added.
/// @throws InputError  as the readers and find_segments().
LabelChoice read_label_choice(const LabelArguments& arguments,
                              const std::function<VoxelGrid()>& scan,
                              std::vector<std::string>& warnings);

}  // namespace mesamis
