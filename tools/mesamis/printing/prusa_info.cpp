// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/prusa_info.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "mesamis/files/refuse.h"
#include "mesamis/printing/slicer_log.h"

namespace mesamis::detail::printing {
namespace {

/// Splits "key = value", without the blanks around them.
bool split_entry(std::string_view line, std::string& key, std::string& value) {
  const std::size_t sign = line.find(" = ");
  if (sign == std::string_view::npos) return false;
  key = line.substr(0, sign);
  value = line.substr(sign + 3);
  value.erase(0, value.find_first_not_of(' '));
  return true;
}

/// Keys that --info states for every surface; all other counts are repairs.
bool is_description(std::string_view key) {
  constexpr std::array kPrefixes{"size_", "min_", "max_", "number_of_facets"};
  return std::any_of(kPrefixes.begin(), kPrefixes.end(), [key](std::string_view prefix) {
    return key.substr(0, prefix.size()) == prefix;
  });
}

void take_entry(const std::string& key, const std::string& value, PrusaInfo& info) {
  if (key == "manifold") {
    info.manifold = value == "yes";
    return;
  }
  double number = 0;
  if (is_description(key) || !parse_number(value, number) || !std::isfinite(number)) return;
  const auto whole = static_cast<std::int64_t>(std::clamp(number, -1e18, 1e18));
  if (key == "volume") {
    info.volume = number;
  } else if (key == "open_edges") {
    info.open_edges = whole;
  } else if (key == "number_of_parts") {
    info.parts = whole;
  } else if (whole != 0) {
    info.repairs.emplace_back(key, whole);
  }
}

void add(std::string& list, const std::string& key, std::int64_t value) {
  list += (list.empty() ? "" : ", ") + key + " = " + std::to_string(value);
}

}  // namespace

PrusaInfo parse_prusa_info(std::string_view output) {
  PrusaInfo info;
  std::istringstream lines{std::string(output)};
  std::string key, value;
  for (std::string line; std::getline(lines, line);) {
    if (split_entry(one_log_line(line), key, value)) take_entry(key, value, info);
  }
  return info;
}

std::string flaws_of(const PrusaInfo& info) {
  std::string flaws;
  if (info.open_edges != 0) add(flaws, "open_edges", info.open_edges);
  for (const auto& [what, count] : info.repairs) add(flaws, what, count);
  if (flaws.empty() && !info.manifold) flaws = "manifold = no";
  return flaws;
}

}  // namespace mesamis::detail::printing
