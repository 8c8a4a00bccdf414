// SPDX-License-Identifier: Apache-2.0
#include "shell_completion.h"

#include <CLI/CLI.hpp>
#include <vector>

#include "option_facts.h"

namespace mesamis {
namespace {

using Words = std::vector<std::string>;

std::string joined(const Words& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

void append(Words& words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
}

Words names_of(const std::vector<OptionFacts>& options) {
  Words names;
  for (const OptionFacts& option : options) {
    if (!option.positional) append(names, option.names);
  }
  return names;
}

Words command_names(const CLI::App& program) {
  Words names;
  for (const CLI::App* command : shown_commands(program)) names.push_back(command->get_name());
  return names;
}

// ---- bash

/// What follows an option: a line of the table that the script asks.
std::string bash_value(const OptionFacts& option) {
  if (!option.words.empty()) return "words " + joined(option.words, " ");
  if (option.file) return "files " + joined(option.endings, " ");
  return "nothing";
}

std::string bash_case(const std::string& pattern, const std::string& value) {
  return "    " + pattern + ") echo '" + value + "' ;;\n";
}

/// The options of one command: "segment:-o|segment:--output) echo 'files .stl' ;;"
std::string bash_values(const std::string& command, const std::vector<OptionFacts>& options) {
  const std::string key = command + ":";
  std::string cases;
  for (const OptionFacts& option : options) {
    if (option.value.empty() && !option.positional) continue;
    Words patterns;
    if (option.positional) patterns.push_back(key);
    for (const std::string& name : option.names) {
      if (!option.positional) patterns.push_back(key + name);
    }
    cases.append(bash_case(joined(patterns, "|"), bash_value(option)));
  }
  return cases;
}

constexpr const char* kBashHead =
    R"sh(# SPDX-License-Identifier: Apache-2.0
# Completion of mesamis for bash. Written by 'mesamis manual --bash'.

)sh";

constexpr const char* kBashBody = R"sh(
# _mesamis_files PREFIX [ENDING...]: folders, and files that end so; all where none does.
_mesamis_files() {
  local prefix=$1 file ending
  shift
  compopt -o filenames 2>/dev/null || true
  COMPREPLY=()
  while IFS= read -r file; do
    if [ $# -eq 0 ] || [ -d "$file" ]; then
      COMPREPLY+=("$file")
      continue
    fi
    for ending in "$@"; do
      [[ $file != *"$ending" ]] || { COMPREPLY+=("$file"); break; }
    done
  done < <(compgen -f -- "$prefix")
  [ ${#COMPREPLY[@]} -gt 0 ] || mapfile -t COMPREPLY < <(compgen -f -- "$prefix")
}

_mesamis() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command= word
  local -a values
  [ "$before" != = ] || before=${COMP_WORDS[COMP_CWORD - 2]}
  if [ "$current" = = ]; then current=; fi
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    if [[ " $_mesamis_commands " == *" $word "* ]]; then
      command=$word
      break
    fi
  done
  COMPREPLY=()
  read -r -a values <<<"$(_mesamis_value "$command:$before")"
  [ ${#values[@]} -gt 0 ] || read -r -a values <<<"$(_mesamis_value ":$before")"
  if [ ${#values[@]} -eq 0 ] && [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_mesamis_options "$command")" -- "$current")
    return
  fi
  if [ ${#values[@]} -eq 0 ] && [ -z "$command" ]; then
    mapfile -t COMPREPLY < <(compgen -W "$_mesamis_commands" -- "$current")
    return
  fi
  [ ${#values[@]} -gt 0 ] || read -r -a values <<<"$(_mesamis_value "$command:")"
  case ${values[0]:-} in
    words) mapfile -t COMPREPLY < <(compgen -W "${values[*]:1}" -- "$current") ;;
    files) _mesamis_files "$current" "${values[@]:1}" ;;
  esac
}

complete -F _mesamis mesamis
)sh";

// ---- zsh

/// In single quotes, within [...] or behind a colon of a specification.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text.substr(0, text.find('\n'))) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return out;
}

std::string zsh_files(const Words& endings) {
  if (endings.empty()) return "_files";
  Words bare;
  for (const std::string& ending : endings) bare.push_back(ending.substr(1));
  return "_files -g \"*.(" + joined(bare, "|") + ")(-.)\"";
}

std::string zsh_action(const OptionFacts& option) {
  if (!option.words.empty()) return "(" + joined(option.words, " ") + ")";
  return option.file ? zsh_files(option.endings) : " ";
}

/// One specification per name; a name excludes the others, unless the option may come again.
std::string zsh_option(const OptionFacts& option) {
  std::string lines;
  for (const std::string& name : option.names) {
    Words others = option.excludes;
    if (!option.repeated) append(others, option.names);
    std::string line = option.repeated ? "*" : "(" + joined(others, " ") + ")";
    line += name;
    if (!option.value.empty()) line += name.starts_with("--") ? "=" : "+";
    line += "[" + zsh_text(option.help) + "]";
    if (!option.value.empty()) line += ":" + zsh_text(option.value) + ":" + zsh_action(option);
    lines += "    '" + line + "' \\\n";
  }
  return lines;
}

std::string zsh_positional(const OptionFacts& option) {
  const std::string colon = option.required ? ":" : "::";
  return "    '" + colon + zsh_text(option.names.front()) + ":" + zsh_action(option) + "' \\\n";
}

std::string zsh_arguments(const std::vector<OptionFacts>& options) {
  std::string lines;
  for (const OptionFacts& option : options) {
    lines += option.positional ? zsh_positional(option) : zsh_option(option);
  }
  return lines;
}

std::string zsh_command(const CLI::App& command) {
  return "_mesamis_" + command.get_name() + "() {\n  _arguments -s -S \\\n" +
         zsh_arguments(option_facts(command)) + "    \"${_mesamis_common[@]}\"\n}\n\n";
}

constexpr const char* kZshBody = R"sh(_mesamis() {
  local curcontext=$curcontext state line
  typeset -A opt_args
  _arguments -C -s -S "${_mesamis_common[@]}" '1:command:->command' '*::argument:->argument'
  case $state in
    command) _describe -t commands command _mesamis_commands ;;
    argument)
      curcontext=${curcontext%:*:*}:mesamis-$words[1]:
      (( ! $+functions[_mesamis_$words[1]] )) || _mesamis_$words[1]
      ;;
  esac
}

_mesamis "$@"
)sh";

}  // namespace

std::string bash_completion(const CLI::App& program) {
  const std::vector<OptionFacts> common = option_facts(program);
  const std::string common_names = joined(names_of(common), " ");
  std::string options, values = bash_values("", common);
  for (const CLI::App* command : shown_commands(program)) {
    const std::vector<OptionFacts> own = option_facts(*command);
    Words names = names_of(own);
    append(names, names_of(common));
    options += bash_case(command->get_name(), joined(names, " "));
    values += bash_values(command->get_name(), own);
  }
  return kBashHead + ("_mesamis_commands='" + joined(command_names(program), " ") + "'\n\n") +
         "# The options of a command, and of every command.\n_mesamis_options() {\n  case $1 in\n" +
         options + bash_case("*", common_names) + "  esac\n}\n\n" +
         "# What follows COMMAND:OPTION, or COMMAND: alone: words, files, nothing.\n" +
         "_mesamis_value() {\n  case $1 in\n" + values + "  esac\n}\n" + kBashBody;
}

std::string zsh_completion(const CLI::App& program) {
  std::string commands, functions;
  for (const CLI::App* command : shown_commands(program)) {
    commands += "  '" + command->get_name() + ":" + zsh_text(command->get_description()) + "'\n";
    functions += zsh_command(*command);
  }
  std::string common = zsh_arguments(option_facts(program));
  for (std::size_t at; (at = common.find(" \\\n")) != std::string::npos;) common.erase(at, 2);
  return "#compdef mesamis\n# SPDX-License-Identifier: Apache-2.0\n"
         "# Completion of mesamis for zsh. Written by 'mesamis manual --zsh'.\n\n"
         "local -a _mesamis_commands=(\n" +
         commands + ")\n\nlocal -a _mesamis_common=(\n" + common + ")\n\n" + functions + kZshBody;
}

}  // namespace mesamis
