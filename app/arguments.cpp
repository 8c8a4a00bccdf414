// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "mesamis/base/utf8.h"
#include "mesamis/base/written_number.h"

namespace mesamis {
namespace {

/// @param count  of the numbers; 0: any count above zero.
template <class Number>
std::vector<Number> parse_list(const std::string& text, std::size_t count,
                               const std::string& option) {
  std::vector<Number> numbers;
  const char* at = text.data();
  const char* end = at + text.size();
  bool more = true;  // a number must follow
  while (more) {
    Number value{};
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(static_cast<double>(value))) break;
    numbers.push_back(value);
    more = stop != end && *stop == ',';
    at = more ? stop + 1 : stop;
  }
  if (more || at != end || (count != 0 && numbers.size() != count)) {
    const std::string how_many = count == 0 ? "" : std::to_string(count) + " ";
    throw CLI::ValidationError(
        option, "expected " + how_many + "numbers with commas between, found '" + text + "'");
  }
  return numbers;
}

}  // namespace

void refuse_usage(const std::string& message) { throw CLI::ValidationError(message); }

void refuse_usage(const std::string& option, const std::string& message) {
  throw CLI::ValidationError(option, message);
}

std::string without_subject(const std::string& message, const std::string& option) {
  const std::string subject = option.substr(std::min(option.size(), std::size_t{2})) + ": ";
  return message.starts_with(subject) ? message.substr(subject.size()) : message;
}

bool parse_number(const std::string& text, double& value) {
  const auto number = written_number(text);
  value = number.value_or(value);
  return number.has_value();
}

std::vector<double> parse_numbers(const std::string& text, std::size_t count,
                                  const std::string& option) {
  return parse_list<double>(text, count, option);
}

std::vector<int> parse_integers(const std::string& text, std::size_t count,
                                const std::string& option) {
  return parse_list<int>(text, count, option);
}

std::vector<int> parse_integers(const std::string& text, const std::string& option) {
  return parse_list<int>(text, 0, option);
}

void require_utf8(const std::string& text, const std::string& option) {
  if (is_utf8(text)) return;
  throw CLI::ValidationError(option, "expected UTF-8, found something else");
}

std::string one_line(const std::string& text) {
  const std::size_t last = text.find_last_not_of("\n ");
  return as_one_line(std::string_view(text).substr(0, last + 1));
}

std::function<void(const std::string&)> noted(std::vector<std::string>& names,
                                              const std::string& name) {
  return [&names, name](const std::string&) { names.push_back(name); };
}

void require_beside(const std::vector<std::string>& given, bool has_master,
                    const std::string& expected) {
  if (!given.empty() && !has_master) refuse_usage(given.front(), "expected " + expected);
}

}  // namespace mesamis
