// SPDX-License-Identifier: Apache-2.0
#include "bids_dataset.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>

#include "mesamis/base/error.h"
#include "mesamis/base/version.h"
#include "mesamis/files/atomic_file.h"
#include "mesamis/report/json_file.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDescriptionFile = "dataset_description.json";
constexpr const char* kBidsVersion = "1.9.0";
/// Suffixes of label maps and of what has four dimensions: no scans to segment.
constexpr std::array kNoScans{"dseg", "probseg", "mask", "defacemask", "bold", "sbref", "dwi"};

bool holds(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

std::string joined(std::string first, const char* between, const std::string& last) {
  return first.append(between).append(last);
}

/// Names in a folder, in order.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator files(folder, error);
  if (error) throw InputError(folder.string() + ": " + error.message());
  for (const auto& file : files) names.push_back(file.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

bool is_label(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+';
  });
}

/// The label of a folder "sub-01"; nothing if the name is another one.
std::optional<std::string> label_in(const std::string& name, std::string_view key) {
  if (!name.starts_with(key)) return std::nullopt;
  const std::string label = name.substr(key.size());
  return is_label(label) ? std::optional(label) : std::nullopt;
}

/// The name of a NIfTI file without its extension; nothing for other files.
std::optional<std::string> nifti_stem(const std::string& name) {
  for (const std::string_view extension : {".nii.gz", ".nii"}) {
    if (name.ends_with(extension)) return name.substr(0, name.size() - extension.size());
  }
  return std::nullopt;
}

bool is_entity(std::string_view text) {
  const std::size_t hyphen = text.find('-');
  return hyphen != text.npos && is_label(text.substr(0, hyphen)) &&
         is_label(text.substr(hyphen + 1));
}

/// Splits "sub-01_acq-thin_ct" into entities and suffix.
/// @return false  if it is something else.
bool split_stem(const std::string& stem, BidsImage& image) {
  const std::size_t last = stem.rfind('_');
  if (last == std::string::npos) return false;
  image.entities = stem.substr(0, last);
  image.suffix = stem.substr(last + 1);
  std::string_view rest = image.entities;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('_'), rest.size());
    if (!is_entity(rest.substr(0, end))) return false;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return is_label(image.suffix);
}

/// One walk through a dataset.
struct Walk {
  const fs::path& dataset;
  const BidsFilter& filter;
  BidsImages found{};

  bool wants_suffix(const std::string& suffix) const {
    if (!filter.suffixes.empty()) return holds(filter.suffixes, suffix);
    return std::find(kNoScans.begin(), kNoScans.end(), suffix) == kNoScans.end();
  }

  /// @param begin  of the names of its files: "sub-01_ses-02".
  void take_file(const std::string& folder, const std::string& begin, const std::string& name) {
    const auto stem = nifti_stem(name);
    if (!stem) return;
    BidsImage image{dataset / folder / name, folder + "/" + name, folder, {}, {}};
    if (!split_stem(*stem, image) || !(image.entities + "_").starts_with(begin + "_")) {
      found.warnings.push_back(image.name + ": expected a name " + begin +
                               "_[KEY-LABEL_...]SUFFIX, found '" + name + "'; left out");
      return;
    }
    if (wants_suffix(image.suffix)) found.images.push_back(std::move(image));
  }

  void take_datatypes(const std::string& folder, const std::string& begin) {
    for (const std::string& type : filter.datatypes) {
      const std::string inner = joined(folder, "/", type);
      if (!fs::is_directory(dataset / inner)) continue;
      for (const std::string& name : names_in(dataset / inner)) take_file(inner, begin, name);
    }
  }

  void take_participant(const std::string& folder) {
    if (filter.sessions.empty()) take_datatypes(folder, folder);
    for (const std::string& name : names_in(dataset / folder)) {
      const auto session = label_in(name, "ses-");
      if (!session || !fs::is_directory(dataset / folder / name)) continue;
      if (!filter.sessions.empty() && !holds(filter.sessions, *session)) continue;
      take_datatypes(joined(folder, "/", name), joined(folder, "_", name));
    }
  }
};

std::vector<std::string> participants_of(const fs::path& dataset) {
  std::vector<std::string> labels;
  for (const std::string& name : names_in(dataset)) {
    const auto label = label_in(name, "sub-");
    if (label && fs::is_directory(dataset / name)) labels.push_back(*label);
  }
  return labels;
}

void require_participants(const std::vector<std::string>& wanted,
                          const std::vector<std::string>& there, const fs::path& dataset) {
  for (const std::string& label : wanted) {
    if (holds(there, label)) continue;
    throw InputError(dataset.string() + ": expected a folder sub-" + label + ", found none");
  }
}

nlohmann::ordered_json description_of(const fs::path& out, const fs::path& dataset,
                                      const std::string& name) {
  std::error_code error;
  const fs::path link = fs::relative(dataset, out, error);
  return {{"Name", name + ": surfaces"},
          {"BIDSVersion", kBidsVersion},
          {"DatasetType", "derivative"},
          {"GeneratedBy",
           {{{"Name", "mesamis"},
             {"Version", version()},
             {"Description", "Surfaces and adapted meshes of scans"}}}},
          {"DatasetLinks", {{"raw", (error ? dataset : link).generic_string()}}}};
}

/// A folder of derivatives belongs to one pipeline.
void require_ours(const fs::path& out) {
  const fs::path file = out / kDescriptionFile;
  if (!fs::exists(file)) return;
  const nlohmann::json there = read_json(file);
  const nlohmann::json by = there.is_object() && there.contains("GeneratedBy")
                                ? there["GeneratedBy"]
                                : nlohmann::json::array();
  for (const auto& program : by) {
    if (program.is_object() && program.contains("Name") && program["Name"] == "mesamis") return;
  }
  throw InputError(file.string() + ": expected derivatives of mesamis, found those of others");
}

constexpr const char* kReadme =
    "Surfaces made by mesamis of the images of a BIDS dataset.\n"
    "\n"
    "*_mesh.EXT is the surface of an image, in millimetres; *_mesh.json is its report: where it "
    "comes\n"
    "from, every setting, and what was found. desc-LABEL names the kind of the image.\n";

}  // namespace

BidsImages find_images(const fs::path& dataset, const BidsFilter& filter) {
  const std::vector<std::string> there = participants_of(dataset);
  require_participants(filter.participants, there, dataset);
  Walk walk{dataset, filter};
  for (const std::string& label : there) {
    if (filter.participants.empty() || holds(filter.participants, label)) {
      walk.take_participant("sub-" + label);
    }
  }
  if (walk.found.images.empty()) {
    std::string folders;
    for (const std::string& type : filter.datatypes)
      folders += (folders.empty() ? "" : ", ") + type;
    throw InputError(dataset.string() + ": expected NIfTI images in folders " + folders +
                     " of sub-LABEL, found none");
  }
  return std::move(walk.found);
}

std::string dataset_name(const fs::path& dataset) {
  const fs::path file = dataset / kDescriptionFile;
  const nlohmann::json description = read_json(file);
  for (const char* key : {"Name", "BIDSVersion"}) {
    if (description.is_object() && description.contains(key) && description[key].is_string()) {
      continue;
    }
    throw InputError(file.string() + ": expected an entry " + key + ", found none");
  }
  return description["Name"];
}

fs::path derivative_of(const BidsImage& image, const fs::path& out, const std::string& desc,
                       const std::string& ending) {
  return out / image.folder / (image.entities + "_desc-" + desc + "_" + ending);
}

void write_derivatives(const fs::path& out, const fs::path& dataset, const std::string& name) {
  require_ours(out);
  std::error_code error;
  fs::create_directories(out, error);
  if (error) throw InputError(out.string() + ": " + error.message());
  write_json(out / kDescriptionFile, description_of(out, dataset, name));
  if (!fs::exists(out / "README")) write_file(out / "README", kReadme);
  if (!fs::exists(out / ".bidsignore")) write_file(out / ".bidsignore", "*_mesh.*\n");
}

std::string uri_of(const BidsImage& image) { return "bids:raw:" + image.name; }

}  // namespace mesamis
