// SPDX-License-Identifier: Apache-2.0
#include "place_options.h"

#include <CLI/CLI.hpp>

#include "arguments.h"
#include "mesamis/object/places.h"
#include "mesamis/object/tissue.h"

namespace mesamis {
namespace {

constexpr const char* kGroup = "Which object";
constexpr const char* kBody = "body";

std::string tissue_names() {
  std::string names;
  for (const Tissue& tissue : tissue_table()) names += tissue.name + " ";
  return names + "or LO:HI";
}

[[noreturn]] void refuse_pair(const std::string& option, const std::string& other) {
  throw CLI::ValidationError(option, "expected it without " + other + ", found both");
}

}  // namespace

void add_padding_option(CLI::App& command, PlaceArguments& a) {
  command
      .add_option("--padding", a.padding,
                  "Voxels that were not measured, which are filled: auto (default), detected; "
                  "none; or all voxels of one native value")
      ->type_name("auto|none|VALUE")
      ->group(kGroup);
}

void add_place_options(CLI::App& command, PlaceArguments& a) {
  command
      .add_option("--tissue", a.tissue,
                  "Tissue to segment, by name or by a range of native values: " + tissue_names())
      ->type_name("NAME|LO:HI")
      ->group(kGroup);
  command
      .add_option("--mask", a.mask,
                  "Label map: keep only what lies within --margin (2 mm) of a marked voxel")
      ->group(kGroup);
  command
      .add_option("--seed", a.seeds,
                  "X,Y,Z, mm, in the frame of --frame: keep the island with this point; several: "
                  "an object for each, split where they touch")
      ->type_name("X,Y,Z")
      ->allow_extra_args(false)
      ->group(kGroup);
  command
      .add_option("--box", a.box,
                  "X0:X1,Y0:Y1,Z0:Z1, mm, in the frame of --frame: part of the scan to use; ends "
                  "are optional")
      ->type_name("RANGES")
      ->group(kGroup);
  command
      .add_option(
          "--remove", a.remove,
          "Label map of what to remove; body: everything outside the patient, refused if none "
          "is found")
      ->group(kGroup);
  command
      .add_flag("--keep-surroundings", a.keep_surroundings,
                "Keep table and head rest, which are removed where a patient is found in CT")
      ->group(kGroup);
  add_padding_option(command, a);
}

void require_places(const PlaceArguments& places, const LabelArguments& labels,
                    const Settings& settings) {
  if (!places.tissue.empty()) parsed("--tissue", [&] { return parse_tissue(places.tissue); });
  for (const std::string& seed : places.seeds) {
    parsed("--seed", [&] { return parse_point(seed, Frame::kLps); });
  }
  if (!places.box.empty()) {
    parsed("--box", [&] { return parse_box(places.box); });
    if (!(settings.crop == CropRange{})) refuse_pair("--box", "--crop");
  }
  if (!places.padding.empty()) parsed("--padding", [&] { return parse_padding(places.padding); });
  if (places.remove == kBody && places.keep_surroundings) {
    refuse_pair("--remove body", "--keep-surroundings");
  }
  if (!labels.given() && !(labels.chosen.empty() && labels.names.empty())) {
    throw CLI::ValidationError("--label", "expected --labels beside it, found none");
  }
  if (labels.margin && !labels.given() && places.mask.empty()) {
    throw CLI::ValidationError("--margin", "expected --labels or --mask beside it, found neither");
  }
  if (labels.given() && places.choose()) {
    refuse_pair("--labels", "--tissue, --mask and --seed");
  }
}

TissueKind tissue_kind(const PlaceArguments& places) {
  return places.tissue.empty() ? TissueKind::kBright : parse_tissue(places.tissue).kind;
}

ReadRequest read_request(const RequestArguments& arguments, const Settings& settings) {
  const auto& [places, labels, frame, scan] = arguments;
  LabelOptions how = places.read;
  how.scan = scan;
  ReadRequest read;
  read.object.crop = settings.crop;
  ObjectRequest& request = read.object;
  if (!places.tissue.empty()) request.tissue = parse_tissue(places.tissue);
  for (const std::string& seed : places.seeds) request.seeds.push_back(parse_point(seed, frame));
  if (!places.mask.empty()) request.mask = read_marks(places.mask, how, read.warnings);
  if (!places.padding.empty()) request.padding = parse_padding(places.padding);
  request.margin = labels.margin.value_or(request.margin);
  const bool body = places.remove == kBody;
  if (!places.remove.empty() && !body) {
    request.remove = read_marks(places.remove, how, read.warnings);
  }
  if (body) {
    request.surroundings = SurroundingsRule::kRemove;
  } else if (places.keep_surroundings) {
    request.surroundings = SurroundingsRule::kKeep;
  }
  return read;
}

}  // namespace mesamis
