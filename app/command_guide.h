// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// What help and manual pages show first of a command.
namespace mesamis {

/// A line for a shell.
struct CommandExample {
  std::string purpose;  ///< "One file for each object of a label map"
  std::string line;     ///< "mesamis segment ct.nii.gz --labels labels.nii.gz -o '{label}.stl'"
};

struct CommandGuide {
  std::vector<std::string> most_used = {};  ///< options that --help shows; empty: all of them
  std::vector<CommandExample> examples = {};
};

/// The guide of a command by its name; empty for a command without one.
const CommandGuide& guide_of(const std::string& command);

}  // namespace mesamis
