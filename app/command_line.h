// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "commands.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

/// The command line of the program: its parser, and what is said where a line is refused.
namespace mesamis {

/// Adds the options of every command, which may stand before or after it, and asks for a command.
/// Call it before commands are added. `common` must outlive the parsing.
void add_common_options(CLI::App& app, CommonOptions& common);

/// Adds the common options and every command. Parsing a line sets `common` and the action of the
/// command that it names; nothing is run. `common` and `action` must outlive the parsing.
void add_commands(CLI::App& app, CommonOptions& common, Action& action);

/// One line for what the parser found wrong, and where to read more.
/// @param count, arguments  as main() has them: the first is the program.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error, int count,
                          const char* const* arguments);

}  // namespace mesamis
