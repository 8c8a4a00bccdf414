// SPDX-License-Identifier: Apache-2.0
// mesamis phantom: a synthetic scan whose surface is known.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "arguments.h"
#include "commands.h"
#include "costs.h"
#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/phantom/degrade.h"
#include "mesamis/phantom/phantom.h"
#include "mesamis/phantom/phantom_truth.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/report.h"
#include "mesamis/shape_files/surface_files.h"
#include "mesamis/volume_files/write_volume.h"
#include "outputs.h"
#include "ranges.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

struct PhantomCommand {
  bool list = false;
  std::string name, type = "float";
  fs::path output, truth, report;
  std::array<Index, 3> size{0, 0, 0};
  Vec3 spacing{1, 1, 1};
  int samples = 4;
  bool gzip = false;
  DegradeOptions degrade{.blur = 1};
};

int print_list() {
  for (const PhantomInfo& info : phantom_list()) {
    std::cout << info.name << ": " << info.description << " (" << info.size[0] << " x "
              << info.size[1] << " x " << info.size[2] << ")\n";
  }
  return kExitDone;
}

/// Refuses what is wrong with the command line before any work is done.
Phantom require_all(const PhantomCommand& command) {
  if (command.name.empty())
    throw CLI::ValidationError("name: expected a phantom; --list shows them");
  if (command.output.empty()) throw CLI::ValidationError("--output is required");
  require_output(command.output, {".nrrd"}, "--output");
  if (!command.truth.empty()) {
    require_output(command.truth, written_surface_formats(), "--truth");
  }
  if (!command.report.empty()) require_output(command.report, {".json"}, "--report");
  require_distinct_files({command.output, command.truth, command.report}, {});
  return as_usage([&command] {
    require_valid(command.degrade);
    return make_phantom(command.name, command.size, command.spacing);
  });
}

nlohmann::ordered_json truth_json(const PhantomTruth& truth, const Phantom& phantom) {
  const Vec3& spacing = phantom.spacing;
  const double voxel = std::min({spacing.x, spacing.y, spacing.z});
  nlohmann::ordered_json json = check_json(truth.surface, truth.check);
  json.update({{"error_max_mm", truth.error.max},
               {"error_mean_mm", truth.error.mean},
               {"error_max_voxel", truth.error.max / voxel},
               {"error_promised_voxel", kTruthErrorVoxel}});
  return json;
}

nlohmann::ordered_json phantom_settings(const PhantomCommand& command, const Phantom& phantom) {
  const DegradeOptions& degrade = command.degrade;
  return {{"name", phantom.name},
          {"size", phantom.size},
          {"spacing_mm", vec_json(phantom.spacing)},
          {"scale", phantom.scale},
          {"background", phantom.background},
          {"samples", command.samples},
          {"blur_voxel", degrade.blur},
          {"speckle", degrade.speckle},
          {"noise", degrade.noise},
          {"salt_pepper", degrade.salt_pepper},
          {"pepper", degrade.pepper},
          {"salt", degrade.salt},
          {"seed", degrade.seed},
          {"type", command.type},
          {"gzip", command.gzip}};
}

int status_of(const PhantomTruth& truth) {
  if (!truth.is_closed_manifold()) return kExitNotClosed;
  if (truth.within_bound()) return kExitDone;
  log_warning("the truth's error is " + std::to_string(truth.error.max) + " mm, expected at most " +
              std::to_string(kTruthErrorVoxel) + " of a voxel");
  return kExitNotConverged;
}

void write_report(const PhantomCommand& command, const Phantom& phantom, const PhantomTruth& truth,
                  OutputSet& set) {
  nlohmann::ordered_json report;
  report["program"] = program_json();
  report["settings"] = phantom_settings(command, phantom);
  if (!command.truth.empty()) report["truth"] = truth_json(truth, phantom);
  report["files"] = files_json(set);
  add_costs(report);
  write_json(set.file(command.report), report);
}

int run_phantom(const PhantomCommand& command) {
  if (command.list) return print_list();
  const Phantom phantom = require_all(command);
  OutputSet set;
  const PhantomSlices sharp(phantom, command.samples);
  const DegradedSlices scan(sharp, command.degrade);
  write_nrrd(set.file(command.output), scan,
             {.type = command.type == "short" ? SampleType::kShort : SampleType::kFloat,
              .gzip = command.gzip,
              .slab = scan.slab()});
  PhantomTruth truth;
  if (!command.truth.empty()) {
    truth = make_truth(phantom);
    write_surface(set.file(command.truth), truth.surface, {.name = phantom.name});
  }
  if (!command.report.empty()) write_report(command, phantom, truth, set);
  commit(set);
  std::cout << phantom.name << ": " << phantom.size[0] << " x " << phantom.size[1] << " x "
            << phantom.size[2] << " voxels";
  if (!command.truth.empty()) {
    std::cout << "; truth: " << truth.surface.triangles.size() << " triangles, at most "
              << truth.error.max << " mm from the surface";
  }
  std::cout << "\n";
  return command.truth.empty() ? kExitDone : status_of(truth);
}

void add_degrade_options(CLI::App& sub, DegradeOptions& degrade) {
  sub.add_option("--blur", degrade.blur, "Gaussian, sigma in voxels of each axis")
      ->capture_default_str();
  sub.add_option("--noise", degrade.noise, "Gaussian, standard deviation in grey values")
      ->capture_default_str();
  sub.add_option("--speckle", degrade.speckle, "Multiplicative Gaussian, standard deviation")
      ->capture_default_str();
  sub.add_option("--salt-pepper", degrade.salt_pepper, "Share of voxels that become 0 or 255")
      ->capture_default_str();
  sub.add_option("--seed", degrade.seed, "Seed of the noise")
      ->check(zero_or_more())
      ->capture_default_str();
}

void add_grid_options(CLI::App& sub, const std::shared_ptr<PhantomCommand>& command) {
  sub.add_option_function<std::string>(
         "--size",
         [command](const std::string& text) {
           const std::vector<int> n = parse_integers(text, 3, "--size");
           for (std::size_t a = 0; a < 3; ++a) {
             if (n[a] < kPhantomSizeMin) {
               throw CLI::ValidationError("--size", "expected at least " +
                                                        std::to_string(kPhantomSizeMin) +
                                                        " voxels, found '" + text + "'");
             }
             command->size[a] = n[a];
           }
         },
         "Voxels NX,NY,NZ (default: see --list)")
      ->type_name("NX,NY,NZ");
  sub.add_option_function<std::string>(
         "--spacing",
         [command](const std::string& text) {
           const std::vector<double> s = parse_numbers(text, 3, "--spacing");
           command->spacing = {s[0], s[1], s[2]};
         },
         "Of the voxels X,Y,Z, mm (default 1,1,1)")
      ->type_name("X,Y,Z");
  sub.add_option("--samples", command->samples, "Points per voxel and direction at the surface")
      ->check(from_to(1, 16))
      ->capture_default_str();
}

std::string name_help() {
  std::string text = "Phantom:";
  for (const PhantomInfo& info : phantom_list()) {
    text += "\n" + info.name + ": " + info.description;
  }
  return text;
}

}  // namespace

void add_phantom_command(CLI::App& app, CommonOptions&, Action& action) {
  auto command = std::make_shared<PhantomCommand>();
  CLI::App* sub = app.add_subcommand("phantom", "A synthetic scan whose surface is known");
  sub->add_option("name", command->name, name_help());
  sub->add_flag("--list", command->list, "Show the phantoms, a line each");
  sub->add_option("-o,--output", command->output, "Volume: .nrrd");
  sub->add_option("--truth", command->truth, listed("True surface:", written_surface_formats()));
  add_grid_options(*sub, command);
  add_degrade_options(*sub, command->degrade);
  sub->add_option("--type", command->type, "Type of the samples: float, or short (rounded)")
      ->check(CLI::IsMember({"float", "short"}))
      ->capture_default_str();
  sub->add_flag("--gzip", command->gzip, "Compress the samples");
  sub->add_option("--report", command->report, "Report: .json");
  sub->callback([command, &action] { action = [command] { return run_phantom(*command); }; });
}

}  // namespace mesamis
