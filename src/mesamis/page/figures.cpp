// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/figures.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace mesamis::detail::page {
namespace {

using nlohmann::json;

constexpr const char* kThinSpace = "\u202f";

std::string grouped(std::string digits) {
  const std::size_t first = digits.starts_with('-') ? 1 : 0;
  for (std::size_t at = digits.size(); at > first + 3;) {
    at -= 3;
    digits.insert(at, kThinSpace);
  }
  return digits;
}

std::string number_text(double value) {
  constexpr double kLarge = 1e9, kSmall = 1e-4;
  const double size = std::abs(value);
  if (size >= 1000 && size < kLarge) return grouped(fmt::format("{:.0f}", value));
  if (size != 0 && (size >= kLarge || size < kSmall)) return fmt::format("{:.3e}", value);
  return fmt::format("{:.4g}", value);
}

std::string list_text(const json& list) {
  std::string text;
  for (const json& value : list) text += (text.empty() ? "" : ", ") + figure_text(value);
  return text.empty() ? "none" : text;
}

}  // namespace

std::string figure_text(const json& value) {
  if (value.is_null()) return "–";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_integer()) return grouped(value.dump());
  if (value.is_number()) return number_text(value.get<double>());
  return list_text(value);
}

const json& entry(const json& report, const std::string& pointer) {
  static const json none;
  const json::json_pointer at(pointer);
  return report.contains(at) ? report.at(at) : none;
}

Html datum_as(const json& report, const std::string& pointer, std::string_view words) {
  Html data("data");
  data.set("value", entry(report, pointer).dump(-1, ' ', false, json::error_handler_t::replace));
  return data.set("data-of", pointer).text(words);
}

Html datum(const json& report, const std::string& pointer, std::string_view unit) {
  const json& value = entry(report, pointer);
  const Html data = datum_as(report, pointer, figure_text(value));
  if (unit.empty() || !(value.is_number() || value.is_array())) return data;
  Html whole;
  whole.add(data).text("\u00a0").text(unit);
  return whole;
}

Html figure_table(const json& report, std::string_view caption,
                  const std::vector<FigureRow>& rows) {
  Html table = of_class("table", "pairs"), body("tbody");
  table.add(element("caption", caption).set("class", "unseen"));
  for (const FigureRow& row : rows) {
    const json& found = entry(report, row.pointer);
    const bool blank = found.is_string() && found.get<std::string>().empty();
    if (found.is_null() || blank) continue;
    Html line("tr"), value("td");
    line.add(element("th", row.name).set("scope", "row"));
    line.add(value.add(datum(report, row.pointer, row.unit)));
    body.add(line);
  }
  return body.is_empty() ? Html() : table.add(body);
}

std::string native_unit(const json& report) {
  const bool ct = entry(report, "/input/modality") == "CT" || entry(report, "/page/unit") == "HU";
  return ct ? "HU" : "native units";
}

}  // namespace mesamis::detail::page
