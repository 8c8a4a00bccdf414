// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/page/html.h"

/// Values of a report on a page.
namespace mesamis::detail::page {

/// A value as people read it: whole numbers in groups of three digits, others with four digits,
/// lists with commas; a dash for null and "yes" or "no" for a switch.
std::string figure_text(const nlohmann::json& value);

/// The entry of a report at a JSON pointer; null where there is none.
const nlohmann::json& entry(const nlohmann::json& report, const std::string& pointer);

/// An entry of a report as an element `data` that holds the exact value and its pointer beside the
/// text: <data value="40.125" data-of="/quality/noise">40.12</data>.
/// @param unit  follows numbers.
Html datum(const nlohmann::json& report, const std::string& pointer, std::string_view unit = {});

/// The same element for an entry that is shown otherwise: in another unit, or rounded.
/// @param words  what is shown, with its unit.
Html datum_as(const nlohmann::json& report, const std::string& pointer, std::string_view words);

/// A row of a table of two columns: what it is, and its value.
struct FigureRow {
  std::string name, pointer, unit = {};
};

/// A table of entries of a report; those that it lacks are left out.
Html figure_table(const nlohmann::json& report, std::string_view caption,
                  const std::vector<FigureRow>& rows);

/// "HU" for a scan that is a CT by its file or, "/page/unit", by its values; else "native units".
std::string native_unit(const nlohmann::json& report);

}  // namespace mesamis::detail::page
