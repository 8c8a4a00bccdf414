// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesamis/base/error.h"

namespace mesamis {

/// "3,2.5,4" as numbers.
/// @throws CLI::ValidationError  naming the option, if there are not `count` finite numbers.
std::vector<double> parse_numbers(const std::string& text, std::size_t count,
                                  const std::string& option);

/// One number, in any of the usual spellings: 5, +5, .5, 05, 5e3.
/// @return false  if the text is not a number, or not finite.
bool parse_number(const std::string& text, double& value);

/// "3,2,4" as whole numbers.
/// @throws CLI::ValidationError  naming the option, if there are not `count` of them.
std::vector<int> parse_integers(const std::string& text, std::size_t count,
                                const std::string& option);

/// "3,2,4" as whole numbers, of any count above zero.
/// @throws CLI::ValidationError  naming the option, if the text is something else.
std::vector<int> parse_integers(const std::string& text, const std::string& option);

/// Ends the command as one that was used wrongly.
/// @throws CLI::ValidationError  always; with the option's name in front of the message, if one is
/// given.
[[noreturn]] void refuse_usage(const std::string& message);
[[noreturn]] void refuse_usage(const std::string& option, const std::string& message);

/// Notes that an option was given, for CLI::Option::each().
std::function<void(const std::string&)> noted(std::vector<std::string>& names,
                                              const std::string& name);

/// Refuses options that were given without the one that they belong to.
/// @param given     names of such options; may be empty.
/// @param expected  "--body beside it, found none"
/// @throws CLI::ValidationError  naming the first.
void require_beside(const std::vector<std::string>& given, bool has_master,
                    const std::string& expected);

/// Runs a check of options and turns its InputError, which stands for a file, into an error of
/// usage.
/// @throws CLI::ValidationError  with the message of the InputError.
template <class Check>
auto as_usage(const Check& check) {
  try {
    return check();
  } catch (const InputError& error) {
    refuse_usage(error.what());
  }
}

/// A message without the subject that is the option's own name: "box: expected ..." of "--box".
std::string without_subject(const std::string& message, const std::string& option);

/// Parses the value of an option. A value that is written wrongly is an error of usage that names
/// its option.
/// @throws CLI::ValidationError  with the message of the InputError.
template <class Parse>
auto parsed(const std::string& option, const Parse& parse) {
  try {
    return parse();
  } catch (const InputError& error) {
    refuse_usage(option, without_subject(error.what(), option));
  }
}

/// Checks a text that goes into files.
/// @throws CLI::ValidationError  naming the option, if it is not UTF-8.
void require_utf8(const std::string& text, const std::string& option);

/// The text without blanks at its end as one line of a message, see as_one_line().
std::string one_line(const std::string& text);

}  // namespace mesamis
