// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/frame.h"
#include "mesamis/delivery/body_output.h"

/// The options of bodies for finite elements.
namespace mesamis {

struct BodyArguments {
  std::vector<std::filesystem::path> files;  ///< --body
  std::string element = "tet4";              ///< --element
  std::string gmsh = "2.2";                  ///< --gmsh-version
  BodyOptions options;                     ///< --element-size, --element-gradation, --wall-elements
  std::string material, calibration, ash;  ///< as they were written; may be empty
  std::optional<double> gap, poisson;      ///< --material-gap, MPa; --poisson
  std::vector<std::string> sets;           ///< --set

  bool given() const { return !files.empty(); }
};

/// Adds the options. `arguments` must outlive the parsing.
void add_body_options(CLI::App& command, BodyArguments& arguments);

/// Checks files and texts before any work.
/// @throws CLI::ValidationError, InputError  as require_output() and the parsers.
void require_body(const BodyArguments& arguments);

/// What the arguments ask for.
/// @param tolerance  mm, > 0: of the skin.
/// @throws CLI::ValidationError  as the parsers.
BodyRequest body_request(const BodyArguments& arguments, double tolerance);

/// Writes the body to each of the files.
/// @throws InputError  as write_elements().
void write_bodies(const BodyArguments& arguments, const BodyOutput& body, Frame frame);

}  // namespace mesamis
