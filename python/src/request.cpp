// SPDX-License-Identifier: Apache-2.0
#include "request.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/error.h"
#include "mesamis/label_files/read_labels.h"
#include "mesamis/object/places.h"

namespace mesamis::python {
namespace {

std::optional<LabelSource> source_of(const Arguments& a, const char* name) {
  if (!a.has(name)) return std::nullopt;
  if (py::isinstance<py::str>(a.object(name)))
    return LabelSource{a.get<std::string>(name), nullptr};
  return LabelSource{"", a.get<std::shared_ptr<Scan>>(name)};
}

[[noreturn]] void refuse_pair(const std::string& what, const std::string& other) {
  throw InputError(what + ": expected it without " + other + ", found both");
}

void require_consistent(const CallRequest& r, const Arguments& a) {
  if (!r.tissue.empty()) parse_tissue(r.tissue);
  if (!r.box.empty()) {
    parse_box(r.box);
    if (!(r.settings.crop == CropRange{})) refuse_pair("box", "crop");
  }
  if (r.remove_body && r.keep_surroundings) refuse_pair("remove='body'", "keep_surroundings");
  if (!r.labels && (a.has("label") || a.has("label_names"))) {
    throw InputError("label: expected labels beside it, found none");
  }
  if (r.labels && (!r.tissue.empty() || r.mask || !r.seeds.empty())) {
    refuse_pair("labels", "tissue, mask and seeds");
  }
  if (r.margin && !(*r.margin > 0)) {
    throw InputError("margin: expected a number above 0, found " + std::to_string(*r.margin));
  }
}

LabelMap labels_of_samples(const VolumeView& view) {
  LabelMap map;
  static_cast<VoxelGrid&>(map) = view;
  std::vector<std::uint16_t> labels;
  labels.reserve(view.samples.size());
  for (const float value : view.samples) {
    if (!(value >= 0 && value <= static_cast<float>(kMaxLabel) && value == std::floor(value))) {
      throw InputError("labels: expected whole numbers of 0 to 65535, found " +
                       std::to_string(value));
    }
    labels.push_back(static_cast<std::uint16_t>(value));
  }
  map.layers.push_back(std::move(labels));
  return with_all_segments(std::move(map));
}

}  // namespace

Frame frame_of(const std::string& name) {
  if (name == "lps") return Frame::kLps;
  if (name == "ras") return Frame::kRas;
  throw InputError("frame: expected 'lps' or 'ras', found '" + name + "'");
}

CallRequest request_of(const Arguments& a) {
  CallRequest r;
  r.settings =
      settings_from(a.get<std::string>("preset", "default"), a.get<std::string>("settings_file"),
                    a.get<std::string>("settings", "{}"));
  r.frame = frame_of(a.get<std::string>("frame", "lps"));
  r.tissue = a.get<std::string>("tissue");
  r.box = a.get<std::string>("box");
  r.seeds = a.get<std::vector<Vector>>("seeds");
  r.mask = source_of(a, "mask");
  r.remove_body =
      py::isinstance<py::str>(a.object("remove")) && a.get<std::string>("remove") == "body";
  if (!r.remove_body) r.remove = source_of(a, "remove");
  r.labels = source_of(a, "labels");
  r.chosen = a.get<std::vector<std::string>>("label");
  if (py::isinstance<py::str>(a.object("label_names"))) {
    r.names_file = a.get<std::string>("label_names");
  } else {
    r.names = a.get<std::vector<std::pair<Index, std::string>>>("label_names");
  }
  r.margin = a.find<double>("margin");
  r.time_limit = a.find<double>("time_limit");
  if (const auto spacing = a.find<Vector>("spacing")) r.spacing = vec(*spacing);
  r.resample = a.get<bool>("resample");
  r.keep_surroundings = a.get<bool>("keep_surroundings");
  r.padding = parse_padding(a.get<std::string>("padding", "auto"));
  r.mesh = a.get<bool>("mesh");
  r.memory_gb = a.get<double>("memory");
  require_consistent(r, a);
  return r;
}

LabelMap labels_of(const LabelSource& source, const LabelOptions& options,
                   std::vector<std::string>& warnings) {
  if (source.path.empty()) return labels_of_samples(source.scan->view);
  LabelFile file = read_label_map(source.path, options);
  warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
  return std::move(file.map);
}

LabelOptions label_options(const CallRequest& request, const VoxelGrid* scan) {
  LabelOptions options{.limits = {.memory_gb = request.memory_gb},
                       .spacing = request.spacing,
                       .resample = request.resample};
  if (scan != nullptr) options.scan = [scan] { return *scan; };
  return options;
}

ObjectRequest object_request(const CallRequest& r, const VoxelGrid& grid,
                             std::vector<std::string>& warnings) {
  ObjectRequest request;
  request.crop = r.settings.crop;
  if (!r.tissue.empty()) request.tissue = parse_tissue(r.tissue);
  for (const Vector& seed : r.seeds) request.seeds.push_back(in_frame(vec(seed), r.frame));
  const LabelOptions how = label_options(r, &grid);
  if (r.mask) request.mask = labels_of(*r.mask, how, warnings);
  request.padding = r.padding;
  request.margin = r.margin.value_or(request.margin);
  if (r.remove) request.remove = labels_of(*r.remove, how, warnings);
  if (r.remove_body) {
    request.surroundings = SurroundingsRule::kRemove;
  } else if (r.keep_surroundings) {
    request.surroundings = SurroundingsRule::kKeep;
  }
  if (!r.box.empty()) request.crop = box_to_range(grid, r.box, r.frame);
  return request;
}

}  // namespace mesamis::python
