// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/slicer_log.h"

#include <sstream>
#include <utility>

namespace mesamis::detail::printing {
namespace {

constexpr std::size_t kLongestLine = 200;

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

bool says_error(std::string_view line) {
  return contains(line, "error") || contains(line, "ERROR") || contains(line, "what():");
}

/// Progress, traces and the settings that CuraEngine repeats.
bool is_noise(std::string_view line) {
  return line.empty() || contains(line, "=> ") || contains(line, "[trace]") ||
         contains(line, "[WARNING]") || contains(line, "Progress:") || contains(line, " -s ");
}

}  // namespace

std::string one_log_line(std::string_view text) {
  std::string line(text);
  for (char& c : line) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 32 || code == 127) c = ' ';
  }
  while (line.ends_with(' ')) line.pop_back();
  return line;
}

std::string failure_line(std::string_view output) {
  std::istringstream lines{std::string(output)};
  std::string before, last;
  for (std::string line; std::getline(lines, line);) {
    line = one_log_line(line);
    line.erase(0, line.find_first_not_of(' '));
    if (says_error(line)) return line.substr(0, kLongestLine);
    if (is_noise(line)) continue;
    before = std::exchange(last, line);
  }
  if (!before.empty()) before += ' ';
  return (before + last).substr(0, kLongestLine);
}

}  // namespace mesamis::detail::printing
