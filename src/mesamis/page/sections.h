// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/page/html.h"

/// The parts of a page that are made of a report alone. Each is empty where the report has nothing
/// for it.
namespace mesamis::detail::page {

/// A part of the page with its heading; others refer to it by its id.
Html page_part(const std::string& id, std::string_view heading);

/// Whether all that was promised was kept, and what was not, in a line.
Html verdict_section(const nlohmann::json& report);

/// What a page knows of the surfaces beside the report.
struct SeenSurfaces {
  std::size_t count = 0;
  std::string name = {};     ///< of the one; may be empty
  std::optional<Vec3> size;  ///< of the box around all of them, mm; none: no surface is at hand
};

/// What is asked first: object, size, volume, expected error, closed or not; below it the numbers
/// of the method: level, triangles, parts, tetrahedra.
Html headline_section(const nlohmann::json& report, const SeenSurfaces& seen = {});

/// Warnings, and what was done to the scan and to the surface: parts dropped, surroundings removed.
Html notes_section(const nlohmann::json& report);

/// Surface or surfaces: counts, sizes, errors.
Html surfaces_section(const nlohmann::json& report);

/// What the scan is like.
Html scan_section(const nlohmann::json& report);

/// The settings that the program chose, and why.
Html choices_section(const nlohmann::json& report);

/// Pass by pass: cells, energy, movement.
Html passes_section(const nlohmann::json& report);

/// Every setting.
Html settings_section(const nlohmann::json& report);

/// How to repeat the run.
/// @param command   see repeat_command().
Html repeat_section(const nlohmann::json& report, const std::string& command);

/// A paragraph for a publication, with the citation.
Html methods_section(const nlohmann::json& report);

}  // namespace mesamis::detail::page
