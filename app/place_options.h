// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "label_options.h"
#include "mesamis/base/types.h"
#include "mesamis/method/chosen_run.h"

namespace CLI {
class App;
}  // namespace CLI

/// The options that say by a tissue, a place or a mask which object is meant.
namespace mesamis {

struct PlaceArguments {
  std::filesystem::path mask;      ///< --mask, may be empty
  std::vector<std::string> seeds;  ///< --seed, "X,Y,Z", mm
  std::string box;                 ///< --box, mm; may be empty
  std::string remove;              ///< --remove, a file or "body"; may be empty
  std::string tissue;              ///< --tissue, may be empty
  bool keep_surroundings = false;  ///< --keep-surroundings
  std::string padding;             ///< --padding, may be empty
  LabelOptions read{};             ///< of the label maps, but for the scan

  /// Whether they say which object is meant, as labels do.
  bool choose() const { return !mask.empty() || !seeds.empty() || !tissue.empty(); }
  /// Whether they say anything about a scan.
  bool given() const {
    return choose() || !box.empty() || !remove.empty() || keep_surroundings || !padding.empty();
  }
};

/// Adds --padding alone.
void add_padding_option(CLI::App& command, PlaceArguments& arguments);

/// Adds the options. `arguments` must outlive the parsing.
void add_place_options(CLI::App& command, PlaceArguments& arguments);

/// Checks what needs no scan: how tissue, seeds and box are written, and what does not go together.
/// @throws CLI::ValidationError
void require_places(const PlaceArguments& places, const LabelArguments& labels,
                    const Settings& settings);

/// The kind of the tissue asked for: only a bright one leaves the grey values as they are.
/// @throws InputError  as parse_tissue().
TissueKind tissue_kind(const PlaceArguments& places);

/// The arguments that say which object of a scan is meant.
struct RequestArguments {
  const PlaceArguments& places;
  const LabelArguments& labels;
  Frame frame = Frame::kLps;          ///< of the seeds
  std::function<VoxelGrid()> scan{};  ///< see LabelOptions::scan
};

/// What is asked for, and what was to be said when its label maps were read.
struct ReadRequest {
  ObjectRequest object;
  std::vector<std::string> warnings{};  ///< of the readers, one line each
};

/// What the arguments ask for; the box is open until the scan is read. Reads the label maps, and
/// logs their readers' warnings.
/// @throws InputError  as read_label_map() and parse_point().
ReadRequest read_request(const RequestArguments& arguments, const Settings& settings);

}  // namespace mesamis
