// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

/// Help as text for a terminal of 80 columns, made from the parser and command_guide.h.
namespace mesamis {

/// Which options a help shows.
enum class HelpExtent {
  kMostUsed,  ///< --help: those used most, where the command has a list of them, and examples
  kAll        ///< --help-all: every option, in groups with a heading, those of every command too
};

/// The help of the program, or of one of its commands.
/// @param app  with its options; a command of a program.
std::string help_text(const CLI::App& app, HelpExtent extent);

/// Makes the parser show help_text() for --help and --help-all. Call it before commands are added.
void set_up_help(CLI::App& program);

}  // namespace mesamis
