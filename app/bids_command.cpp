// SPDX-License-Identifier: Apache-2.0
// mesamis bids: `segment` for every image of a BIDS dataset, as a BIDS App is called.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bids_dataset.h"
#include "commands.h"
#include "interrupt.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/files/atomic_file.h"
#include "mesamis/files/sha256.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/report.h"
#include "mesamis/report/settings_json.h"
#include "mesamis/shape_files/surface_files.h"
#include "outputs.h"
#include "process.h"
#include "ranges.h"
#include "run_action.h"
#include "scan.h"
#include "segment_run.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct BidsArguments {
  fs::path dataset, out;
  std::string level;
  BidsFilter filter;
  std::string desc;                         ///< empty: the suffix of the image
  std::vector<std::string> formats{"stl"};  ///< of the surfaces, without the dot
  bool tetrahedra = false, dseg = false, skip_existing = false;
  SegmentOptions segment;  ///< what all images have in common
};

/// "sub-01" and "01" are one label.
void strip(std::vector<std::string>& labels, const std::string& key) {
  for (std::string& label : labels) {
    if (label.starts_with(key)) label.erase(0, key.size());
  }
}

/// What a run on an image is asked for, to tell whether a later one would be the same.
nlohmann::ordered_json asked_of(const BidsArguments& a) {
  return {{"settings", to_json(settings_of(a.segment.settings))},
          {"tissue", a.segment.scan.places.tissue},
          {"keep_surroundings", a.segment.scan.places.keep_surroundings},
          {"padding", a.segment.scan.places.padding},
          {"modality", a.segment.scan.read.modality},
          {"time_limit", a.segment.time_limit.value_or(0)},
          {"formats", a.formats},
          {"tetrahedra", a.tetrahedra},
          {"dseg", a.dseg},
          {"error", a.segment.out.error},
          {"frame", a.segment.scan.frame == Frame::kRas ? "ras" : "lps"}};
}

/// The run on one image.
SegmentOptions options_for(const BidsArguments& a, const BidsImage& image) {
  const std::string desc = a.desc.empty() ? image.suffix : a.desc;
  const auto made = [&](const std::string& ending) {
    return derivative_of(image, a.out, desc, ending);
  };
  SegmentOptions s = a.segment;
  s.scan.input = image.path;
  for (const std::string& format : a.formats) s.out.surfaces.push_back(made("mesh." + format));
  if (a.tetrahedra) s.out.meshes = {made("mesh.vtu")};
  if (a.dseg) s.out.labelmap = made("dseg.nii.gz");
  s.out.report = made("mesh.json");
  s.out.name = s.out.report.stem().string();
  s.report_also = {{"Sources", {uri_of(image)}}, {"bids", asked_of(a)}};
  return s;
}

/// Whether the files of a report lie beside it as it says.
bool has_files(const nlohmann::json& report, const fs::path& folder) {
  const auto& files = report.at("files");
  return std::all_of(files.begin(), files.end(), [&](const nlohmann::json& file) {
    const fs::path path = folder / fs::path(file.at("path").get<std::string>()).filename();
    return fs::exists(path) && sha256(path) == file.at("sha256");
  });
}

/// The exit status of a run, as its report tells it.
int status_in(const nlohmann::json& report) {
  if (report.at("verdict").at("kept") == true) return kExitDone;
  return report.at("surface").at("closed") == true ? kExitNotConverged : kExitNotClosed;
}

/// The exit status of this very run if it has been made: by this program, with these settings, of
/// this image.
std::optional<int> made_before(const SegmentOptions& s) {
  if (!fs::exists(s.out.report)) return {};
  try {
    const nlohmann::json report = read_json(s.out.report);
    const bool is_made = report.at("program") == nlohmann::json(program_json()) &&
                         report.at("bids") == nlohmann::json(s.report_also.at("bids")) &&
                         report.at("input").at("sha256") == sha256(s.scan.input) &&
                         has_files(report, s.out.report.parent_path());
    return is_made ? std::optional(status_in(report)) : std::nullopt;
  } catch (const InputError&) {
    return {};
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

/// Takes away the folders of an image that hold nothing.
void remove_empty(const fs::path& out, fs::path folder) {
  std::error_code error;
  while (folder != out && fs::is_empty(folder, error) && !error) {
    fs::remove(folder, error);
    folder = folder.parent_path();
  }
}

int segment_image(const BidsArguments& a, const SegmentOptions& options,
                  const CommonOptions& common) {
  const fs::path folder = options.out.report.parent_path();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string() + ": " + error.message());
  restart_clock();
  const int status = run_segment(options, common);
  remove_empty(a.out, folder);
  return status;
}

/// The worse of two exit statuses.
int worse(int a, int b) {
  constexpr std::array kOrder{kExitDone,  kExitNotConverged, kExitNotClosed,
                              kExitInput, kExitUsage,        kExitInternal};
  const auto rank = [&](int status) {
    return std::find(kOrder.begin(), kOrder.end(), status) - kOrder.begin();
  };
  return rank(a) < rank(b) ? b : a;
}

/// Two images must not be written over each other.
void require_different(const BidsArguments& a, const std::vector<BidsImage>& images) {
  std::map<fs::path, std::string> names;
  for (const BidsImage& image : images) {
    const auto [first, is_new] = names.emplace(options_for(a, image).out.report, image.name);
    if (is_new) continue;
    throw InputError(image.name + ": expected output names that differ from those of " +
                     first->second +
                     ", found the same; choose one image with --suffix, or give "
                     "no --desc");
  }
}

int run_images(const BidsArguments& a, const std::vector<BidsImage>& images,
               const CommonOptions& common) {
  int status = kExitDone;
  std::size_t made = 0, kept = 0;
  for (const BidsImage& image : images) {
    const SegmentOptions options = options_for(a, image);
    const auto before = a.skip_existing ? made_before(options) : std::nullopt;
    if (before) {
      ++kept;
      status = worse(status, *before);
      continue;
    }
    log_info(fmt::format("{} ({} of {})", image.name, &image - images.data() + 1, images.size()));
    const int one =
        run_action([&] { return segment_image(a, options, common); }, image.path.string());
    if (noted_interrupt() != 0) break;
    if (one != kExitDone) remove_empty(a.out, options.out.report.parent_path());
    made += fs::exists(options.out.report) && one != kExitInput && one != kExitUsage ? 1 : 0;
    status = worse(status, one);
  }
  log_info(fmt::format("{} images: {} segmented, {} kept, {} failed", images.size(), made, kept,
                       images.size() - made - kept));
  return status;
}

/// What needs no image to be refused.
void require_arguments(const BidsArguments& a) {
  const Settings settings = settings_of(a.segment.settings);
  require_places(a.segment.scan.places, a.segment.scan.labels, settings);
  const auto is_alphanumeric = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  if (!std::all_of(a.desc.begin(), a.desc.end(), is_alphanumeric)) {
    throw CLI::ValidationError("--desc", "expected letters and digits, found '" + a.desc + "'");
  }
  for (const std::string& type : a.filter.datatypes) {
    if (!type.empty() && std::all_of(type.begin(), type.end(), is_alphanumeric)) continue;
    throw CLI::ValidationError("--datatype", "expected letters and digits, found '" + type + "'");
  }
  std::error_code error;
  if (fs::equivalent(a.dataset, a.out, error)) {
    throw CLI::ValidationError("output",
                               "expected a folder other than the dataset, found the dataset");
  }
  if (a.segment.out.error &&
      std::none_of(a.formats.begin(), a.formats.end(),
                   [](const std::string& format) { return carries_arrays("x." + format); })) {
    throw CLI::ValidationError("--error", "expected vtp or ply among --format, found none");
  }
}

int run_participants(const BidsArguments& a, const CommonOptions& common) {
  require_arguments(a);
  const std::string name = dataset_name(a.dataset);
  const BidsImages found = find_images(a.dataset, a.filter);
  for (const std::string& warning : found.warnings) log_warning(warning);
  require_different(a, found.images);
  write_derivatives(a.out, a.dataset, name);
  if (a.dseg) write_file(a.out / "dseg.tsv", "index\tname\n1\tobject\n");
  return run_images(a, found.images, common);
}

int answer_group() {
  log_info("group: no results across participants; each image has its own report");
  return kExitDone;
}

std::vector<std::string> format_names() {
  std::vector<std::string> names = written_surface_formats();
  std::erase_if(names, [](const std::string& name) { return name.ends_with(".dcm"); });
  for (std::string& name : names) name.erase(0, 1);
  return names;
}

void add_choice_options(CLI::App& c, BidsArguments& a) {
  BidsFilter& filter = a.filter;
  c.add_option("--participant-label,--participant_label", filter.participants,
               "Participants, with or without sub- (default: all)")
      ->type_name("LABEL");
  c.add_option("--session-label,--session_label", filter.sessions,
               "Sessions, with or without ses- (default: all)")
      ->type_name("LABEL");
  c.add_option("--datatype", filter.datatypes, "Folders of images (default: anat ct)")
      ->type_name("NAME");
  c.add_option("--suffix", filter.suffixes,
               "Kinds of images: T1w, ct (default: all but label maps)")
      ->type_name("NAME");
  c.add_flag("--skip-existing", a.skip_existing,
             "Skip images with a report of the same program, settings and image");
}

void add_made_options(CLI::App& c, BidsArguments& a) {
  c.add_option("--desc", a.desc, "desc- of the output files (default: the suffix of the image)")
      ->type_name("NAME");
  c.add_option("--format", a.formats, "Surfaces: stl ply obj vtp 3mf amf glb (default: stl)")
      ->check(CLI::IsMember(format_names()));
  c.add_flag("--tetrahedra", a.tetrahedra, "Also the adapted mesh: _mesh.vtu");
  c.add_flag("--dseg", a.dseg, "Also the result as voxels: _dseg.nii.gz");
  c.add_flag("--error", a.segment.out.error,
             "Write the expected error at each point, in vtp and ply");
  PlaceArguments& places = a.segment.scan.places;
  c.add_option("--tissue", places.tissue, "Tissue to segment, as for segment")
      ->type_name("NAME|LO:HI");
  c.add_flag("--keep-surroundings", places.keep_surroundings,
             "Keep table and head rest, which are removed where a patient is found in CT");
  add_padding_option(c, places);
  add_modality_option(c, a.segment.scan.read);
  add_frame_option(c, a.segment.scan.frame);
  c.add_option("--time-limit", a.segment.time_limit,
               "Seconds per image after which no new mesh is begun")
      ->check(above_zero());
}

}  // namespace

void add_bids_command(CLI::App& app, CommonOptions& common, Action& action) {
  auto arguments = std::make_shared<BidsArguments>();
  CLI::App* command =
      app.add_subcommand("bids", "Segment the images of a BIDS dataset (docs/bids.md)");
  command->add_option("dataset", arguments->dataset, "Folder of the dataset")->required();
  command->add_option("output", arguments->out, "Folder of the derivatives")->required();
  command->add_option("level", arguments->level, "participant, or group: nothing")
      ->required()
      ->check(CLI::IsMember({"participant", "group"}));
  add_choice_options(*command, *arguments);
  add_made_options(*command, *arguments);
  add_settings_options(*command, arguments->segment.settings);
  command->callback([arguments, &common, &action] {
    strip(arguments->filter.participants, "sub-");
    strip(arguments->filter.sessions, "ses-");
    action = [arguments, &common] {
      return arguments->level == "group" ? answer_group() : run_participants(*arguments, common);
    };
  });
}

}  // namespace mesamis
