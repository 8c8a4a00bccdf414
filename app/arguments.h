// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "mesamis/base/error.h"

namespace mesamis {

/// "3,2.5,4" as numbers.
/// @throws CLI::ValidationError  naming the option, if there are not `count` finite numbers.
std::vector<double> parse_numbers(const std::string& text, std::size_t count,
                                  const std::string& option);

/// One number, in any of the usual spellings: 5, +5, .5, 05, 5e3.
/// @return false  if the text is none, or not finite.
bool parse_number(const std::string& text, double& value);

/// The same for whole numbers.
std::vector<int> parse_integers(const std::string& text, std::size_t count,
                                const std::string& option);

/// Any count of them, one at least.
std::vector<int> parse_integers(const std::string& text, const std::string& option);

/// Runs a check of options: what it refuses is an error of usage, not of a file.
/// @throws CLI::ValidationError  with the words of an InputError.
template <class Check>
auto as_usage(const Check& check) {
  try {
    return check();
  } catch (const InputError& error) {
    throw CLI::ValidationError(error.what());
  }
}

/// Text on one line, control characters replaced: what may stand in a message.
std::string one_line(const std::string& text);

}  // namespace mesamis
