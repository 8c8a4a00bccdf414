// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

/// Completion of the command line in shells, made from its own parser.
namespace mesamis {

/// A script for bash, which names commands, options, words and files; needs nothing but bash 4.
/// @param program  with its commands, see add_commands().
std::string bash_completion(const CLI::App& program);

/// A function for zsh, _mesamis, with the help of each option.
/// @param program  with its commands, see add_commands().
std::string zsh_completion(const CLI::App& program);

}  // namespace mesamis
