// SPDX-License-Identifier: Apache-2.0
#include "ranges.h"

#include <functional>

#include "mesamis/base/written_number.h"

namespace mesamis {
namespace {

/// @param range  as the help names it.
/// @param word   between "a number" and the range.
CLI::Validator in_range(const std::string& word, const std::string& range,
                        const std::function<bool(double)>& holds) {
  const auto check = [=](const std::string& text) {
    const auto number = written_number(text);
    if (number && holds(*number)) return std::string();
    return "expected a number " + word + range + ", found " + quoted_text(text);
  };
  return CLI::Validator([check](std::string& text) { return check(text); }, range);
}

}  // namespace

CLI::Validator above_zero() {
  return in_range("", "above 0", [](double number) { return number > 0; });
}

CLI::Validator zero_or_more() {
  return in_range("of ", "0 or more", [](double number) { return number >= 0; });
}

CLI::Validator from_to(double low, double high) {
  return in_range("from ", number_text(low) + " to " + number_text(high),
                  [=](double number) { return number >= low && number <= high; });
}

}  // namespace mesamis
