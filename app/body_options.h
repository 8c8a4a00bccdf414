// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/method/settings.h"
#include "mesamis/report/body_request.h"
#include "mesamis/run/outcome_details.h"

namespace CLI {
class App;
}  // namespace CLI

/// The options of bodies for finite elements, and of surfaces for other meshers, which are their
/// skins.
namespace mesamis {

struct BodyArguments {
  std::vector<std::filesystem::path> files;  ///< --body
  std::string element = "tet4";              ///< --element
  std::string gmsh = "2.2";                  ///< --gmsh-version
  BodyOptions options;                     ///< --element-size, --element-gradation, --wall-elements
  std::optional<double> skin_tolerance;    ///< --skin-tolerance, mm
  std::string material, calibration, ash;  ///< as they were written; may be empty
  std::optional<double> gap, poisson;      ///< --material-gap, MPa; --poisson
  std::optional<double> rim;      ///< --material-rim, mm; none: as deep as the scan is blurred
  std::vector<std::string> sets;  ///< --set
  std::string surface_quality = "printing";  ///< --surface-quality
  /// The options given that mean nothing without elements, without --body, without --material.
  std::vector<std::string> of_elements, of_body, of_material;

  bool given() const { return !files.empty(); }
  bool meshing() const { return surface_quality == "meshing"; }
  bool elements() const { return given() || meshing(); }
};

/// Adds the options. `arguments` must outlive the parsing.
void add_body_options(CLI::App& command, BodyArguments& arguments);

/// Checks files, texts and what belongs together before any work.
/// @throws CLI::ValidationError, InputError  as require_output() and the parsers.
void require_body(const BodyArguments& arguments);

/// Checks settings that elements depend on before any work.
/// @throws CLI::ValidationError  for a band, and where neither setting nor --skin-tolerance is a
///                               tolerance for a skin.
void require_elements_for(const BodyArguments& arguments, const Settings& settings);

/// What elements a run is asked for.
/// @param frame  that places and directions of sets are written in.
/// @throws CLI::ValidationError  as the parsers.
ElementRequest element_request(const BodyArguments& arguments, Frame frame, double memory_gb);

/// Logs what the elements of a run miss, but for what decides its exit status.
void warn_of_elements(const BodyArguments& arguments, const OutcomeDetails& outcome);

}  // namespace mesamis
