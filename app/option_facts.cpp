// SPDX-License-Identifier: Apache-2.0
#include "option_facts.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <regex>
#include <sstream>

namespace mesamis {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

bool is_word(const std::string& text) {
  static const std::regex word("[a-z][a-z0-9_-]*");
  return std::regex_match(text, word);
}

/// "TEXT:{box,object}" and "ENUM:value in {auto->0,turned->1} OR {0,1}": what stands in the first
/// braces, without numbers behind arrows.
std::vector<std::string> listed_words(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}', open);
  if (open == std::string::npos || close == std::string::npos) return {};
  std::vector<std::string> words = split(type.substr(open + 1, close - open - 1), ',');
  for (std::string& word : words) word = word.substr(0, word.find("->"));
  return words;
}

/// "N|auto": the words among the forms of a setting.
std::vector<std::string> words_among_forms(const std::string& type) {
  std::vector<std::string> words = split(type, '|');
  std::erase_if(words, [](const std::string& form) { return !is_word(form); });
  return words;
}

/// "  name: what it is" on lines of their own: a table of words in the help.
std::vector<std::string> words_of_lines(const std::string& help) {
  std::vector<std::string> words;
  const std::vector<std::string> lines = split(help, '\n');
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::string word = lines[i].substr(0, lines[i].find(':'));
    if (is_word(word)) words.push_back(word);
  }
  return words;
}

std::vector<std::string> words_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  std::vector<std::string> words = listed_words(type);
  if (words.empty()) words = words_among_forms(type);
  return words.empty() ? words_of_lines(option.get_description()) : words;
}

/// "INT:1 to 999" says "1 to 999"; "FLOAT:above 0" says "above 0". See ranges.h.
std::string range_of(const std::string& type) {
  const std::size_t colon = type.find(':');
  const std::string kind = type.substr(0, colon);
  const bool number = kind == "FLOAT" || kind == "INT" || kind == "UINT";
  return number && colon != std::string::npos ? type.substr(colon + 1) : "";
}

/// "Surface: .stl .ply; ..." and "Mesh: .vtu, Gmsh .msh": the endings behind the colon, where each
/// part of the list has one. "NIfTI, NRRD, .seg.nrrd" leaves files open.
std::vector<std::string> endings_in(const std::string& help) {
  static const std::regex ending(R"((?:^|\s)((?:\.(?=[a-z0-9]*[a-z])[a-z0-9]+)+))");
  const std::size_t colon = help.find(": ");
  if (colon == std::string::npos) return {};
  std::vector<std::string> endings;
  for (const std::string& part : split(help.substr(colon + 1, help.find(';') - colon - 1), ',')) {
    const std::size_t before = endings.size();
    for (std::sregex_iterator at(part.begin(), part.end(), ending), end; at != end; ++at) {
      endings.push_back((*at)[1]);
    }
    if (endings.size() == before) return {};
  }
  return endings;
}

/// Whether the help begins with the form of a value, "X,Y,Z: ...", which is no file then.
bool begins_with_form(const std::string& help) {
  static const std::regex form("^(Voxels |Of the voxels )?[A-Z][A-Z0-9-]*[,:\\[].*");
  return std::regex_match(help.substr(0, help.find('\n')), form);
}

/// What a value looks like, without what was said of its range and its words.
std::string value_of(const CLI::Option& option, const OptionFacts& facts) {
  if (option.get_type_size_max() == 0) return "";  // a switch
  const std::string type = option.get_type_name();
  const std::string kind = type.substr(0, type.find(':'));
  if (!listed_words(type).empty()) {
    std::string words;
    for (const std::string& word : facts.words) words += (words.empty() ? "" : "|") + word;
    return words;
  }
  if (kind == "TEXT") return facts.file ? "FILE" : "TEXT";
  if (kind == "FLOAT") return "X";
  return kind == "INT" || kind == "UINT" ? "N" : type;
}

std::vector<std::string> names_of(const CLI::Option& option, bool positional) {
  if (positional) return {option.get_name(true)};
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

OptionFacts facts_of(const CLI::Option& option) {
  OptionFacts facts;
  facts.positional = option.get_positional();
  facts.names = names_of(option, facts.positional);
  facts.required = option.get_required();
  facts.repeated = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
  facts.group = option.get_group();
  facts.help = option.get_description();
  facts.words = words_of(option);
  facts.range = range_of(option.get_type_name());
  const std::string type = option.get_type_name();
  facts.file = option.get_type_size_max() != 0 &&
               (type == "TEXT" || type == "TEXT:PNG" || type == "DIR") && facts.words.empty() &&
               !begins_with_form(facts.help);
  if (facts.file) facts.endings = endings_in(facts.help);
  facts.value = value_of(option, facts);
  if (!option.get_default_str().empty()) {
    facts.help += " (default " + option.get_default_str() + ")";
  }
  for (const CLI::Option* other : option.get_excludes()) {
    facts.excludes.push_back(other->get_name());
  }
  return facts;
}

}  // namespace

std::vector<OptionFacts> option_facts(const CLI::App& command) {
  std::vector<OptionFacts> all;
  for (const std::string& group : command.get_groups()) {
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_group() == group && !group.empty()) all.push_back(facts_of(*option));
    }
  }
  return all;
}

std::string in_capitals(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  return name;
}

std::vector<const CLI::App*> shown_commands(const CLI::App& program) {
  std::vector<const CLI::App*> shown;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    if (!command->get_group().empty()) shown.push_back(command);
  }
  return shown;
}

}  // namespace mesamis
