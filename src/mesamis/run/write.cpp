// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/write.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "mesamis/label_files/write_labels.h"
#include "mesamis/page/run_page.h"
#include "mesamis/report/body_json.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/label_report.h"
#include "mesamis/report/label_surface_files.h"
#include "mesamis/report/meshing_json.h"
#include "mesamis/report/object_report.h"
#include "mesamis/report/run_surface.h"
#include "mesamis/run/outcome_details.h"
#include "mesamis/run/run_files.h"
#include "mesamis/shape_files/element_files.h"
#include "mesamis/shape_files/surface_files.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The mesh with its cells in sets: bins of grey values, or the objects under the labels that their
/// surfaces have in files.
std::optional<MeshOutput> mesh_output(const OutcomeDetails& o, const MeshOptions& options) {
  const Result* mesh = o.mesh();
  if (mesh == nullptr) return std::nullopt;
  if (o.one) return make_mesh_output(*mesh, o.image(), options);
  std::vector<FoundObject> objects = o.objects();
  std::vector<Segment> segments;
  segments.reserve(objects.size());
  for (const FoundObject& object : objects) segments.push_back(object.segment);
  const std::vector<NamedSurface> named = named_segments(segments);  // without their triangles
  for (std::size_t n = 0; n < named.size(); ++n) objects[n].segment.label = named[n].label;
  return make_mesh_output(*mesh, o.image(), options, objects);
}

void write_surfaces(const OutcomeDetails& o, const RunFiles& w, OutputSet& set) {
  std::vector<OutputPath> files;
  for (const fs::path& path : w.surfaces) files.push_back(set.file(path));
  if (o.several) {
    const RunSurfaceOptions as{w.frame, w.name, w.error, false, w.subject};
    return write_label_surfaces(files, *o.several, as, o.wanted.size() > 1);
  }
  const bool grey = std::any_of(files.begin(), files.end(), carries_grey);
  SurfaceWriteOptions as =
      surface_options(*o.one, o.image().voxel_size(),
                      {w.frame, w.name, w.error, grey && o.grey.empty(), w.subject});
  if (!o.grey.empty()) as.grey = o.grey;
  for (const OutputPath& path : files) write_surface(path, o.one->surface, as);
}

void write_meshes(const OutcomeDetails& o, const RunFiles& w, const std::optional<MeshOutput>& mesh,
                  OutputSet& set) {
  if (mesh) {
    for (const fs::path& path : w.meshes) write_mesh(set.file(path), *mesh, w.frame);
  }
  if (o.mesh() == nullptr) return;
  for (const fs::path& path : w.band_meshes) write_band_mesh(set.file(path), *o.mesh(), w.frame);
}

/// What the report says of the method and of the elements.
ordered_json found_json(const OutcomeDetails& o) {
  ordered_json found = o.one ? run_json(o.asked, *o.one, o.checks.front())
                             : label_run_json(o.asked, *o.several, o.checks);
  if (o.elements.body) found["body"] = body_json(*o.elements.body);
  const auto& quality = o.elements.quality;
  for (std::size_t n = 0; n < quality.size(); ++n) {
    ordered_json& surface = o.one ? found["surface"] : found["object"]["surfaces"][n];
    surface["meshing"] = meshing_json(quality[n]);
  }
  return found;
}

/// All warnings, each once.
ordered_json warnings_json(const OutcomeDetails& o, const ReportFacts& facts) {
  ordered_json warnings = ordered_json::array();
  const auto add = [&](const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      if (std::find(warnings.begin(), warnings.end(), line) == warnings.end()) {
        warnings.push_back(line);
      }
    }
  };
  if (facts.input) add(facts.input->warnings);
  if (o.object) add(o.object->warnings);
  add(facts.warnings);
  add(o.warnings);
  return warnings;
}

/// The page has what a reader of the report file would find.
void write_page_of(const OutcomeDetails& o, const RunFiles& w, const ordered_json& report,
                   OutputSet& set) {
  const auto shown = w.shown_scan ? w.shown_scan() : std::nullopt;
  const auto replace = ordered_json::error_handler_t::replace;
  RunPage page{nlohmann::json::parse(report.dump(-1, ' ', false, replace))};
  page.scan = shown ? &*shown : nullptr;
  const std::vector<FoundObject> objects = o.objects();
  for (std::size_t n = 0; n < objects.size(); ++n) {
    const FoundObject& object = objects[n];
    if (object.surface.triangles.empty()) continue;
    page.surfaces.push_back({&object.surface, o.one ? "" : object.segment.name,
                             object.segment.colour, o.expected_error(n)});
  }
  if (const Result* mesh = o.mesh()) {
    page.mesh = &mesh->mesh;
    page.grey = mesh->u;
  }
  page.names = w.page.names;
  write_page(w.page, page, set);
}

void write_report(const OutcomeDetails& o, const RunFiles& w, ordered_json report, OutputSet& set) {
  if (w.page.given()) write_page_of(o, w, report, set);
  if (w.report.empty() && !w.facts.written) return;
  report["files"] = files_json(set);
  if (w.facts.complete) w.facts.complete(report);
  if (!w.report.empty()) write_json(set.file(w.report), report);
  if (w.facts.written) w.facts.written(report, set);
}

/// A level that --tissue gave with its range was not measured; that of values between two ends says
/// nothing of the scan.
void tell_level_of_tissue(const OutcomeDetails& o, ordered_json& report) {
  if (o.is_of_range() && report.contains("surface") && report["surface"].contains("level_native")) {
    report["surface"]["level_native"] = nullptr;
    report["chosen"]["level"]["value"] = nullptr;
  }
  const auto& tissue = o.object_asked.tissue;
  const bool from_tissue = o.object && o.object->level && tissue && tissue->level_is_given() &&
                           o.object->level->from == LevelSource::kTissue;
  if (!from_tissue || !report.contains("chosen") || !report["chosen"].contains("level")) return;
  report["chosen"]["level"]["source"] = "tissue";
  report["chosen"]["level"]["reason"] = nullptr;
}

}  // namespace

ordered_json detail::run::report_json(const OutcomeDetails& o, const RunFiles& w) {
  const ReportFacts& facts = w.facts;
  ordered_json report, chosen;
  if (o.object) chosen = object_json(o.object_asked, *o.object);
  if (!facts.mask.empty()) chosen["mask"]["path"] = facts.mask;
  report["program"] = program_json();
  if (facts.input) report["input"] = input_json(*facts.input);
  if (!facts.command.empty()) report["command"] = facts.command;
  report["output"] = output_json(w.frame);
  if (o.one && o.object) report["object"] = chosen;
  report.update(found_json(o));
  if (o.object) report["object"].update(chosen);
  tell_level_of_tissue(o, report);
  report["warnings"] = warnings_json(o, facts);
  report["verdict"] = {{"kept", o.verdict.kind == VerdictKind::kKept},
                       {"message", o.verdict.message}};
  return report;
}

void detail::run::write(const OutcomeDetails& o, const RunFiles& w, OutputSet& set) {
  std::optional<MeshOutput> mesh;  // before any file is written: it may be refused
  if (!w.meshes.empty()) mesh = mesh_output(o, w.mesh);
  if (o.one && !w.surfaces.empty()) require_surface(*o.one, o.asked);
  if (!w.surfaces.empty()) write_surfaces(o, w, set);
  write_meshes(o, w, mesh, set);
  if (o.elements.body) {
    for (const fs::path& path : w.bodies) {
      write_elements(set.file(path), o.elements.body->elements, {.frame = w.frame, .gmsh = w.gmsh});
    }
  }
  if (!w.labelmap.empty()) write_label_map(set.file(w.labelmap), label_map_of(o.grid, o.objects()));
  if (!w.wants_report()) return;
  ordered_json report = report_json(o, w);
  if (mesh) report["mesh"]["region"] = region_json(*mesh);
  write_report(o, w, std::move(report), set);
}

void detail::run::write(const OutcomeDetails& outcome, const RunFiles& files) {
  OutputSet set;
  write(outcome, files, set);
  set.commit();
}

void write(const Outcome& outcome, const Outputs& outputs) {
  write(outcome.details(), RunFiles{outputs});
}

std::string report_text(const Outcome& outcome) {
  return report_json(outcome.details(), {})
      .dump(2, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace mesamis
