// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

/// Manual pages, made from the command line's own parser and the table of settings.
namespace mesamis {

/// A page as a file in share/man/man1.
struct ManPage {
  std::string name;  ///< "mesamis-segment.1"
  std::string text;  ///< for man: roff
};

/// The page of the program and one for each of its commands.
/// @param program  with its commands, see add_commands().
/// @param date     "2026-11-24", at the foot of each page; may be empty.
std::vector<ManPage> man_pages(const CLI::App& program, const std::string& date);

}  // namespace mesamis
