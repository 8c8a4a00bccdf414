// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/sections.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "mesamis/base/written_number.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/page/base64.h"
#include "mesamis/page/figures.h"

namespace mesamis::detail::page {
namespace {

using nlohmann::json;

bool has(const json& report, const std::string& pointer) {
  return !entry(report, pointer).is_null();
}

bool is_true(const json& value) { return value.is_boolean() && value.get<bool>(); }

std::size_t objects_of(const json& report) {
  const json& surfaces = entry(report, "/object/surfaces");
  return surfaces.is_array() ? surfaces.size() : 0;
}

/// The head of a table: its caption and its columns.
Html table(std::string_view caption, const std::vector<std::string>& columns) {
  Html head("tr"), made("table");
  for (const std::string& column : columns) head.add(element("th", column).set("scope", "col"));
  made.add(element("caption", caption));
  return made.add(Html("thead").add(head));
}

/// A table that scrolls on its own where the page is narrow.
Html scrolled(const Html& wide) {
  return of_class("div", "wide")
      .set("tabindex", "0")
      .set("role", "region")
      .set("aria-label", "table")
      .add(wide);
}

Html cell(const Html& value) { return Html("td").add(value); }

Html row_head(std::string_view words) { return element("th", words).set("scope", "row"); }

// ---------------------------------------------------------------- what came out

/// A number with what it is.
void add_tile(Html& tiles, std::string_view name, const Html& value) {
  Html tile("div");
  tiles.add(tile.add(element("dt", name)).add(Html("dd").add(value)));
}

void add_tile(Html& tiles, const json& report, std::string_view name,
              const std::pair<std::string, std::string>& pointer_unit) {
  const auto& [pointer, unit] = pointer_unit;
  if (!has(report, pointer)) return;
  Html value;
  value.add(datum(report, pointer));
  if (!unit.empty()) value.add(element("small", unit));
  add_tile(tiles, name, value);
}

/// The sum of the objects' volumes, mm^3; nothing if one is missing.
std::optional<double> volume_of_objects(const json& report) {
  double sum = 0;
  for (const json& one : entry(report, "/object/surfaces")) {
    const json& volume = entry(one, "/volume_mm3");
    if (!volume.is_number()) return {};
    sum += volume.get<double>();
  }
  return sum;
}

/// The mean of the errors that are known, over the area, mm; nothing if none is.
std::optional<double> error_of_objects(const json& report) {
  double sum = 0, whole = 0;
  for (const json& one : entry(report, "/object/surfaces")) {
    const json &error = entry(one, "/expected_error_mm/mean"), &area = entry(one, "/area_mm2");
    if (!error.is_number() || !area.is_number()) continue;
    sum += error.get<double>() * area.get<double>();
    whole += area.get<double>();
  }
  return whole > 0 ? std::optional(sum / whole) : std::nullopt;
}

std::string cm3_text(double mm3) { return significant_text(mm3 / 1000, 3) + "\u00a0cm³"; }
std::string error_text(double mm) { return significant_text(mm, 2) + "\u00a0mm"; }

std::string size_text(const Vec3& mm) {
  std::string text;
  for (const double side : {mm.x, mm.y, mm.z}) {
    text += (text.empty() ? "" : " × ") + significant_text(side, 3);
  }
  return text + "\u00a0mm";
}

std::string object_name(const json& report, const SeenSurfaces& seen) {
  const std::size_t objects = objects_of(report);
  if (!seen.name.empty()) return seen.name;
  if (objects == 1) return figure_text(entry(report, "/object/surfaces/0/name"));
  if (objects > 1) return figure_text(json(objects)) + " objects";
  const json& tissue = entry(report, "/object/tissue");
  return tissue.is_string() && !tissue.get<std::string>().empty() ? tissue.get<std::string>()
                                                                  : "all that is bright";
}

void add_one_object(Html& tiles, const json& report) {
  const json& volume = entry(report, "/surface/volume_mm3");
  if (volume.is_number()) {
    add_tile(tiles, "volume",
             datum_as(report, "/surface/volume_mm3", cm3_text(volume.get<double>())));
  }
  const json& error = entry(report, "/quality/expected_error_mm/mean");
  if (error.is_number()) {
    add_tile(tiles, "expected error, mean",
             datum_as(report, "/quality/expected_error_mm/mean", error_text(error.get<double>())));
  }
  add_tile(tiles, report, "closed", {"/surface/closed", ""});
}

/// Sums, and the mean of the errors over the area.
void add_several_objects(Html& tiles, const json& report) {
  if (const auto volume = volume_of_objects(report)) {
    add_tile(tiles, "volume", element("span", cm3_text(*volume)));
  }
  if (const auto error = error_of_objects(report)) {
    add_tile(tiles, "expected error, mean", element("span", error_text(*error)));
  }
  std::size_t closed = 0;
  for (const json& one : entry(report, "/object/surfaces")) {
    closed += is_true(entry(one, "/closed"));
  }
  const std::size_t objects = objects_of(report);
  add_tile(tiles, "closed",
           element("span", closed == objects
                               ? std::string("yes")
                               : std::to_string(closed) + " of " + std::to_string(objects)));
}

/// Whether the surface encloses a range of values, so that a level says nothing.
bool is_range(const json& report) { return entry(report, "/object/image") == "within range"; }

/// The numbers of the method.
Html method_tiles(const json& report) {
  Html tiles = of_class("dl", "tiles method");
  const std::string native = native_unit(report);
  const json& level = entry(report, "/surface/level_native");
  if (level.is_number() && !is_range(report)) {
    const bool ct = native == "HU";
    Html value = datum_as(report, "/surface/level_native",
                          significant_text(level.get<double>(), ct ? 3 : 4) + "\u00a0" + native);
    add_tile(tiles, "level", value);
  }
  add_tile(tiles, report, "triangles", {"/surface/triangles", ""});
  add_tile(tiles, report, "parts", {"/surface/islands", ""});
  if (entry(report, "/mesh/tets") != 0) add_tile(tiles, report, "tetrahedra", {"/mesh/tets", ""});
  return tiles;
}

// ---------------------------------------------------------------- settings

std::string unit_of(const Setting& setting, const json& report) {
  if (setting.unit == "native") return native_unit(report);
  return setting.unit == "mm^3" ? "mm³" : setting.unit;
}

/// The pointer to the words that tell how a setting was found; empty: it was not left to the program.
/// Reports of earlier versions hold these words alone.
std::string reason_at(const json& report, const std::string& name) {
  const std::string at = "/chosen/" + name;
  if (entry(report, at).is_string()) return at;
  return has(report, at + "/reason") ? at + "/reason" : std::string();
}

/// How a setting came to its value.
std::string origin_of(const json& report, const std::string& name) {
  for (const json& given : entry(report, "/given")) {
    if (given == name) return "given";
  }
  return reason_at(report, name).empty() ? "default" : "chosen";
}

// ---------------------------------------------------------------- words

std::string words(const json& report, const std::string& pointer) {
  return figure_text(entry(report, pointer));
}

std::string times(const json& list) {
  std::string text;
  for (const json& value : list) text += (text.empty() ? "" : " × ") + figure_text(value);
  return text;
}

Html scan_sentence(const json& report) {
  Html p;
  p.text("The scan (")
      .text(has(report, "/input/modality") && !words(report, "/input/modality").empty()
                ? words(report, "/input/modality") + ", "
                : "");
  p.text(times(entry(report, "/input/size")) + " voxels of ");
  p.text(times(entry(report, "/input/spacing_mm")) + " mm) was segmented with mesamis ");
  p.add(datum(report, "/program/version")).text(" (").add(datum(report, "/program/commit"));
  return p.text("). ");
}

Html image_sentence(const json& report) {
  Html p;
  if (!has(report, "/quality/noise")) return p;
  p.text("Noise of a standard deviation of ")
      .add(datum(report, "/quality/noise", native_unit(report)));
  p.text(" and a blur of ")
      .add(datum(report, "/quality/blur"))
      .text(" voxels (standard deviation along each axis) were measured in the image");
  if (is_true(entry(report, "/settings/restore")))
    p.text(", and the blur was undone as far as the noise permits");
  return p.text(". ");
}

Html mesh_sentence(const json& report) {
  Html p;
  if (!has(report, "/mesh/tets")) return p;
  p.text(
      "The functional of Ambrosio and Tortorelli was minimised on anisotropic tetrahedral meshes "
      "adapted to the image [1]");
  const json& passes = entry(report, "/iterations");
  if (passes.is_array() && passes.size() > 1) {
    p.text(", in " + std::to_string(passes.size() - 1) +
           (passes.size() == 2 ? " adaptation" : " adaptations"));
  }
  return p.text("; the last mesh has ").add(datum(report, "/mesh/tets")).text(" tetrahedra. ");
}

Html surface_sentence(const json& report) {
  Html p;
  if (objects_of(report) > 0) {
    return p.text(
        "The surfaces of " + std::to_string(objects_of(report)) +
        " labelled objects follow the image where it has an edge, the labels elsewhere. ");
  }
  if (!has(report, "/surface/triangles")) return p;
  const bool is_solid = entry(report, "/surface/kind") == "solid";
  if (has(report, "/surface/level_native") || (is_range(report) && is_solid)) {
    if (is_range(report)) {
      p.text("The surface encloses the values ")
          .add(datum(report, "/object/tissue", native_unit(report)));
    } else {
      p.text("The surface is the level set at ")
          .add(datum(report, "/surface/level_native", native_unit(report)));
    }
    if (has(report, "/surface/tolerance_mm")) {
      p.text(", decimated within ").add(datum(report, "/surface/tolerance_mm", "mm"));
    }
  } else {
    p.text("The surface is the boundary of the cells at edges of the image");
  }
  p.text(". It has ").add(datum(report, "/surface/triangles")).text(" triangles");
  if (is_true(entry(report, "/surface/closed"))) p.text(" and is closed");
  p.text(". ");
  if (has(report, "/quality/expected_error_mm/mean")) {
    p.text("Its mean distance to the truth is expected to be ")
        .add(datum(report, "/quality/expected_error_mm/mean", "mm"))
        .text(" (95 % of its area: less than ")
        .add(datum(report, "/quality/expected_error_mm/p95", "mm"))
        .text("). ");
  }
  return p;
}

constexpr const char* kCitation =
    "[1] Clerici, F., Ferro, N., Marconi, S., Micheletti, S., Negrello, E., Perotto, S.: "
    "Anisotropic "
    "adapted meshes for image segmentation: application to 3D medical data. MOX Report 48/2020, "
    "MOX, "
    "Politecnico di Milano, 2020.";

void add_list(Html& list, const json& messages) {
  for (const json& message : messages) list.add(element("li", figure_text(message)));
}

void add_parts(Html& list, const json& report) {
  const auto dropped = [&](const char* count, const char* volume, const std::string& what) {
    const json& n = entry(report, std::string("/surface/parts/") + count);
    if (!n.is_number() || n == 0) return;
    Html item("li");
    item.text(what + ": ").add(datum(report, std::string("/surface/parts/") + count)).text(", ");
    list.add(item.add(datum(report, std::string("/surface/parts/") + volume, "mm³")));
  };
  dropped("islands_dropped", "volume_dropped_mm3", "Small parts dropped");
  dropped("cavities_filled", "volume_filled_mm3", "Cavities filled");
  const json& removed = entry(report, "/object/removed");
  for (std::size_t n = 0; removed.is_array() && n < removed.size(); ++n) {
    const std::string at = "/object/removed/" + std::to_string(n);
    Html item("li");
    item.text("Removed from the scan: ").add(datum(report, at + "/what")).text(", ");
    list.add(item.add(datum(report, at + "/cm3", "cm³")));
  }
  if (has(report, "/object/padding/voxels")) {
    Html item("li");
    item.add(datum(report, "/object/padding/voxels"))
        .text(" voxels beyond what the scanner saw were filled with ");
    list.add(item.add(datum(report, "/object/padding/filled_with", native_unit(report))));
  }
}

}  // namespace

Html page_part(const std::string& id, std::string_view heading) {
  Html section("section");
  section.set("id", id).set("aria-labelledby", id + "-heading");
  return section.add(element("h2", heading).set("id", id + "-heading"));
}

Html verdict_section(const json& report) {
  const json& kept = entry(report, "/verdict/kept");
  const json& converged = entry(report, "/converged");
  const bool good = kept.is_boolean() ? is_true(kept) : converged.is_null() || is_true(converged);
  const std::string message =
      has(report, "/verdict/message") ? words(report, "/verdict/message") : "";
  Html p = of_class("p", good ? "verdict good" : "verdict bad");
  p.add(of_class("span", "mark").set("aria-hidden", "true").text(good ? "✓" : "!"));
  p.text(good              ? "All checks passed: the run converged and its surface is sound."
         : message.empty() ? "The run did not converge."
                           : message);
  return p;
}

Html headline_section(const json& report, const SeenSurfaces& seen) {
  Html tiles = of_class("dl", "tiles");
  add_tile(tiles, "object", element("span", object_name(report, seen)));
  if (seen.size) add_tile(tiles, "size", element("span", size_text(*seen.size)));
  if (objects_of(report) > 0) {
    add_several_objects(tiles, report);
  } else {
    add_one_object(tiles, report);
  }
  Html both;
  both.add(tiles);
  const Html method = method_tiles(report);
  return method.is_empty() ? both : both.add(method);
}

Html notes_section(const json& report) {
  Html list("ul");
  const json& all = entry(report, "/warnings");
  add_list(list, all.is_array() ? all : entry(report, "/input/warnings"));
  add_parts(list, report);
  if (list.is_empty()) return Html();
  return page_part("notes", "Warnings and what was left out").add(list);
}

Html surfaces_section(const json& report) {
  const std::size_t objects = objects_of(report);
  if (objects == 0) {
    const Html figures =
        figure_table(report, "The surface",
                     {{"kind", "/surface/kind"},
                      {"triangles", "/surface/triangles"},
                      {"triangles before decimation", "/surface/triangles_extracted"},
                      {"decimated within", "/surface/tolerance_mm", "mm"},
                      {"closed", "/surface/closed"},
                      {"manifold", "/surface/manifold"},
                      {"parts", "/surface/islands"},
                      {"cavities", "/surface/cavities"},
                      {"pairs of triangles that intersect", "/surface/self_intersections"},
                      {"volume", "/surface/volume_mm3", "mm³"},
                      {"area", "/surface/area_mm2", "mm²"},
                      {"expected error, mean", "/quality/expected_error_mm/mean", "mm"},
                      {"expected error, 95 % of the area", "/quality/expected_error_mm/p95", "mm"},
                      {"expected error, greatest", "/quality/expected_error_mm/max", "mm"}});
    return figures.is_empty() ? Html() : page_part("surface", "Surface").add(figures);
  }
  Html rows("tbody"), made = table("The surfaces of the objects",
                                   {"object", "triangles", "volume, mm³", "area, mm²", "parts",
                                    "closed", "expected error, mm"});
  for (std::size_t n = 0; n < objects; ++n) {
    const std::string at = "/object/surfaces/" + std::to_string(n);
    Html row("tr");
    row.add(row_head(words(report, at + "/name")));
    for (const char* key : {"/triangles", "/volume_mm3", "/area_mm2", "/islands", "/closed",
                            "/expected_error_mm/mean"}) {
      row.add(cell(datum(report, at + key)));
    }
    rows.add(row);
  }
  return page_part("surface", "Surfaces").add(scrolled(made.add(rows)));
}

Html scan_section(const json& report) {
  const std::string native = native_unit(report);
  const Html figures =
      figure_table(report, "The scan",
                   {{"file", "/input/path"},
                    {"format", "/input/format"},
                    {"modality", "/input/modality"},
                    {"voxels", "/input/size"},
                    {"voxel", "/input/spacing_mm", "mm"},
                    {"origin, LPS", "/input/origin_mm", "mm"},
                    {"values", "/input/range", native},
                    {"noise", "/quality/noise", native},
                    {"noise left after restoring", "/quality/noise_left", native},
                    {"correlation of noise", "/quality/noise_correlation"},
                    {"share of impulses", "/quality/impulse_share"},
                    {"blur", "/quality/blur", "voxels"},
                    {"contrast of the object", "/quality/contrast", native},
                    {"uncertainty of the level", "/quality/level_uncertainty", native},
                    {"window", "/grey/window_native", native},
                    {"SHA-256", "/input/sha256"}});
  return figures.is_empty() ? Html() : page_part("scan", "Scan").add(figures);
}

Html choices_section(const json& report) {
  Html rows("tbody");
  for (const Setting& setting : setting_table()) {
    const std::string reason = reason_at(report, setting.name);
    if (reason.empty()) continue;
    Html row("tr");
    row.add(row_head(setting.name));
    row.add(cell(datum(report, "/settings/" + setting.name, unit_of(setting, report))));
    rows.add(row.add(cell(datum(report, reason))));
  }
  if (rows.is_empty()) return Html();
  Html made =
      table("Settings that were left to the program", {"setting", "value", "how it was found"});
  return page_part("choices", "What was chosen, and why")
      .add(scrolled(made.set("class", "prose").add(rows)));
}

Html passes_section(const json& report) {
  const json& passes = entry(report, "/iterations");
  if (!passes.is_array() || passes.empty()) return Html();
  Html rows("tbody");
  for (std::size_t n = 0; n < passes.size(); ++n) {
    const std::string at = "/iterations/" + std::to_string(n);
    Html row("tr");
    row.add(row_head(n + 1 == passes.size() ? "final" : std::to_string(n + 1)));
    for (const char* key : {"/tets", "/nodes", "/energy", "/energy_change", "/surface_change_mm",
                            "/mesh_change", "/estimator", "/amis_iterations"}) {
      row.add(cell(datum(report, at + key)));
    }
    rows.add(row);
  }
  Html made =
      table("Each pass minimises on a mesh and adapts it",
            {"pass", "tetrahedra", "nodes", "energy", "change of energy",
             "movement of the surface, mm", "change of the mesh", "error estimate", "iterations"});
  return scrolled(made.add(rows));
}

Html settings_section(const json& report) {
  Html rows("tbody");
  for (const Setting& setting : setting_table()) {
    if (!report.contains(json::json_pointer("/settings/" + setting.name))) continue;
    Html row("tr");
    row.add(row_head(setting.name));
    row.add(cell(datum(report, "/settings/" + setting.name, unit_of(setting, report))));
    row.add(cell(element("span", origin_of(report, setting.name))));
    rows.add(row.add(cell(element("span", setting.help))));
  }
  if (rows.is_empty()) return Html();
  Html made = table("Every setting with the value used", {"setting", "value", "origin", "meaning"});
  Html details("details");
  details.add(element("summary", "All settings"));
  return page_part("settings", "Settings")
      .add(details.add(scrolled(made.set("class", "prose").add(rows))));
}

Html repeat_section(const json& report, const std::string& command) {
  Html section = page_part("repeat", "How to repeat the run");
  section.add(element(
      "p", "The same scan and the same settings give the same bytes, for any number of threads:"));
  section.add(
      Html("pre").set("tabindex", "0").set("aria-label", "command").add(element("code", command)));
  if (!has(report, "/settings")) return section;
  const std::string settings =
      report.at("settings").dump(2, ' ', false, json::error_handler_t::replace);
  Html link = element("a", "settings.json");
  link.set("download", "settings.json")
      .set("href", "data:application/json;base64," + base64(settings + "\n"));
  Html p("p");
  p.text("The values that the program chose are in ").add(link);
  return section.add(p.text("; with --settings settings.json they are used as they are."));
}

Html methods_section(const json& report) {
  Html p("p");
  p.add(scan_sentence(report)).add(image_sentence(report)).add(mesh_sentence(report));
  p.add(surface_sentence(report));
  Html section = page_part("methods", "Methods, for a publication");
  return section.add(p).add(element("p", kCitation).set("class", "citation"));
}

}  // namespace mesamis::detail::page
