// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

/// What manual pages and shells need to know of a command's options, read from its parser, so that
/// no option is listed a second time.
namespace mesamis {

/// An option or a positional, as the parser knows it.
struct OptionFacts {
  std::vector<std::string> names = {};     ///< "-o", "--output"; of a positional: "input"
  bool positional = false;                 ///< named by its place
  bool required = false;                   ///< the command is refused without it
  bool repeated = false;                   ///< takes several values
  std::string value = {};                  ///< what a value looks like: "N|auto"; empty: a switch
  std::string range = {};                  ///< "1 to 999", "above 0"; empty: any, or words alone
  std::vector<std::string> words = {};     ///< values that are words
  std::vector<std::string> endings = {};   ///< of files that it takes: ".stl"; empty: any, or none
  bool file = false;                       ///< a value may be the name of a file
  std::vector<std::string> excludes = {};  ///< names of the options that must not stand beside it
  std::string group = {};                  ///< heading in the help; empty: hidden
  std::string help = {};
};

/// The options of a command in the order of its help, the hidden ones left out.
std::vector<OptionFacts> option_facts(const CLI::App& command);

/// The commands of the program in the order of its help, the hidden ones left out.
std::vector<const CLI::App*> shown_commands(const CLI::App& program);

/// A name as a usage line has it: "INPUT".
std::string in_capitals(std::string name);

}  // namespace mesamis
