// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/report.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "mesamis/base/parallel.h"
#include "mesamis/base/version.h"
#include "mesamis/files/sha256.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/method/setting_table.h"
#include "mesamis/report/json_file.h"
#include "mesamis/report/settings_json.h"

namespace mesamis::detail::report {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json energy_json(const Energy& e) {
  return {
      {"total", e.total()}, {"fidelity", e.fidelity}, {"smoothing", e.smoothing}, {"edge", e.edge}};
}

/// What was not measured is null.
json known(bool is_known, double value) { return is_known ? json(value) : json(); }

/// What a pass has not measured is null: the first has no energy before it, the last leads to no
/// other mesh.
ordered_json iteration_json(const Iteration& i, bool is_first, bool is_last) {
  return {{"tets", i.tets},
          {"nodes", i.nodes},
          {"energy", i.energy.total()},
          {"energy_parts", energy_json(i.energy)},
          {"energy_change", known(!is_first, i.energy_change)},
          {"surface_change_mm", known(i.has_surface(), i.surface_change)},
          {"surface_tolerance_mm", known(i.has_surface(), i.surface_tolerance)},
          {"mesh_change", known(!is_first && !is_last, i.mesh_change)},
          {"amis_iterations", i.amis.iterations},
          {"v_change", i.amis.v_change},
          {"v_clamped", i.amis.clamped},
          {"solver",
           {{"iterations", i.amis.solver_iterations},
            {"residual", i.amis.solver_residual},
            {"converged", i.amis.solver_converged}}},
          {"estimator", known(!is_last, i.estimator)},
          {"predicted_tets", known(!is_last, i.predicted_tets)},
          {"aspect_max", i.aspect_max},
          {"aspect_mean", i.aspect_mean},
          {"seconds",
           {{"project", i.seconds.project},
            {"amis", i.seconds.amis},
            {"estimate", i.seconds.estimate},
            {"remesh", i.seconds.remesh},
            {"transfer", i.seconds.transfer}}}};
}

ordered_json mesh_json(const RunSummary& run) {
  return {{"tets", run.tets},
          {"nodes", run.nodes},
          {"edge_unit_fraction", run.fit.unit_edge_fraction},
          {"quality_min", run.fit.quality_min},
          {"quality_mean", run.fit.quality_mean}};
}

ordered_json parts_json(const std::optional<SelectionReport>& parts) {
  if (!parts) return nullptr;
  return {{"islands", parts->islands},
          {"cavities", parts->cavities},
          {"islands_dropped", parts->islands_dropped},
          {"volume_dropped_mm3", parts->volume_dropped},
          {"cavities_filled", parts->cavities_filled},
          {"volume_filled_mm3", parts->volume_filled}};
}

/// Of an open surface nobody can say what is inside.
json known_count(const SurfaceCheck& check, std::int64_t count) {
  return check.closed() ? json(count) : json();
}

/// @param triangles, vertices  of the surface that was checked.
ordered_json check_json(std::int64_t triangles, std::int64_t vertices, const SurfaceCheck& check) {
  return {{"triangles", triangles},
          {"vertices", vertices},
          {"closed", check.closed()},
          {"manifold", check.manifold()},
          {"components", check.components},
          {"islands", known_count(check, check.islands)},
          {"cavities", known_count(check, check.cavities)},
          {"volume_mm3", check.volume},
          {"area_mm2", check.area}};
}

ordered_json surface_json(const RunSummary& run) {
  const Parameters& p = run.parameters;
  const bool solid = p.surface == SurfaceKind::kSolid;
  ordered_json j{{"kind", solid ? "solid" : "band"}};
  if (solid) {
    j["level_native"] = p.level;
    j["level_grey"] = p.grey.to_grey(p.level);
    if (run.image.has_local_levels()) {
      j["level_range_native"] = run.image.level_range;
      j["tunnels_closed"] = run.image.closed_tunnels;
    }
    j.update(printable_json(run.printable, p.tolerance.value()));
  }
  j.update(check_json(run.triangles, run.vertices, run.check));
  j["self_intersections"] = run.self_intersections;
  return j;
}

/// What the scan is like, and how near to the truth its surface can be expected to be.
ordered_json quality_json(const RunSummary& run) {
  ordered_json expected;
  if (run.parameters.surface == SurfaceKind::kSolid) {
    expected = error_json(run.expected_error);
  }
  ordered_json quality = image_json(run.parameters, run.image);
  quality["expected_error_mm"] = std::move(expected);
  return quality;
}

/// Whether a setting has the value of the preset of the paper, whoever wrote it.
bool is_of_preset(const Setting& setting, const Settings& asked) {
  return !setting.paper.empty() && setting.get(asked) == parse_value(setting, setting.paper);
}

/// The settings that can be left to the program: the value, where it came from, how surely it is
/// known, and how it was found.
/// @param used  all settings of the run.
ordered_json chosen_json(const Settings& asked, const ordered_json& used,
                         const MeasuredImage& image) {
  ordered_json chosen = ordered_json::object();
  for (const Setting& setting : setting_table()) {
    if (setting.automatic.empty()) continue;
    const bool is_level = setting.name == "level" && used["level"].is_number();
    const Origin origin = origin_of(setting, asked);
    const bool local = setting.name == "level" && asked.has_local_level();  // measured, by default
    const bool measured = origin == Origin::kMeasured || local;
    chosen[setting.name] = {
        {"value", used[setting.name]},
        {"source", measured                       ? "measured"
                   : is_of_preset(setting, asked) ? "preset"
                   : origin == Origin::kDefault   ? "default"
                                                  : "given"},
        {"uncertainty", known(is_level && image.level_uncertainty > 0, image.level_uncertainty)},
        {"reason", measured ? ordered_json(setting.automatic) : ordered_json()}};
  }
  return chosen;
}

/// The names of the settings that the user gave.
ordered_json given_json(const Settings& asked) {
  ordered_json given = ordered_json::array();
  for (const Setting& setting : setting_table()) {
    if (origin_of(setting, asked) == Origin::kGiven) given.push_back(setting.name);
  }
  return given;
}

ordered_json grey_json(const Parameters& p) {
  const GreyMap& map = p.grey;
  return {{"length_unit_mm", p.unit_mm},
          {"window_native", {map.low, map.high}},
          {"threshold_grey",
           map.has_threshold() ? ordered_json(map.to_grey(map.threshold)) : ordered_json(nullptr)}};
}

/// The directions of the axes i, j, k, one after another.
ordered_json direction_json(const Mat3& direction) {
  const Mat3 axes = transpose(direction);
  return {vec_json(axes.rows[0]), vec_json(axes.rows[1]), vec_json(axes.rows[2])};
}

}  // namespace

InputFacts facts_of(const ScanSource& source, const VolumeView& volume) {
  InputFacts facts{source.path,
                   source.format,
                   source.files.empty() ? std::string() : sha256(source.files),
                   volume.modality,
                   volume.size,
                   volume.spacing,
                   {},
                   source.warnings,
                   volume.origin,
                   volume.direction};
  if (!volume.samples.empty()) {
    const auto [low, high] = sample_range(volume.samples);
    facts.range = {low, high};
  }
  return facts;
}

ordered_json input_json(const InputFacts& input) {
  const auto text = [](const std::string& known) {
    return known.empty() ? ordered_json(nullptr) : ordered_json(known);
  };
  ordered_json json{{"path", text(input.path.string())},
                    {"format", input.format},
                    {"sha256", text(input.sha256)},
                    {"size", input.size},
                    {"spacing_mm", vec_json(input.spacing)},
                    {"origin_mm", vec_json(input.origin)},
                    {"direction", direction_json(input.direction)}};
  if (input.range) json["range"] = *input.range;
  json["modality"] = input.modality;
  json["warnings"] = input.warnings;
  return json;
}

ordered_json image_json(const Parameters& p, const MeasuredImage& image) {
  return {{"noise", p.noise},
          {"noise_left", image.noise_left},
          {"noise_correlation", image.noise_correlation},
          {"impulse_share", image.impulses},
          {"blur", p.blur},
          {"contrast", image.contrast},
          {"level_uncertainty", known(image.level_uncertainty > 0, image.level_uncertainty)}};
}

ordered_json program_json() {
  return {{"name", "mesamis"}, {"version", version()}, {"commit", commit()}};
}

std::string producer() { return std::string("mesamis ") + version() + " (" + commit() + ")"; }

ordered_json output_json(Frame frame) {
  return {{"frame", frame == Frame::kRas ? "ras" : "lps"}, {"threads", thread_count()}};
}

ordered_json files_json(const OutputSet& set) {
  ordered_json files = ordered_json::array();
  for (const OutputSet::Member& file : set.members()) {
    files.push_back({{"path", file.target.string()},
                     {"bytes", std::filesystem::file_size(file.temporary)},
                     {"sha256", sha256(file.temporary)}});
  }
  return files;
}

ordered_json printable_json(const PrintableReport& printable, double tolerance) {
  return {{"tolerance_mm", std::isfinite(tolerance) ? ordered_json(tolerance) : nullptr},
          {"triangles_extracted", printable.triangles_extracted},
          {"distance_extracted_to_result_max", printable.extracted_to_result},
          {"distance_result_to_extracted_max", printable.result_to_extracted},
          {"parts", parts_json(printable.parts)}};
}

ordered_json error_json(const ErrorSummary& error) {
  if (!error.is_known()) return nullptr;
  return {{"mean", error.mean}, {"p95", error.percentile95}, {"max", error.most}};
}

ordered_json check_json(const TriMesh& surface, const SurfaceCheck& check) {
  return check_json(static_cast<std::int64_t>(surface.triangles.size()),
                    static_cast<std::int64_t>(surface.points.size()), check);
}

ordered_json settings_used_json(const Settings& asked, const Parameters& used,
                                const MeasuredImage& image) {
  ordered_json report;
  report["settings"] = to_json(settings_of(used));
  report["chosen"] = chosen_json(asked, report["settings"], image);
  report["given"] = given_json(asked);
  report["grey"] = grey_json(used);
  return report;
}

ordered_json run_json(const Settings& asked, const Result& result, const SurfaceCheck& surface) {
  return run_json(asked, summarize(result, surface));
}

ordered_json loop_json(const RunSummary& run) {
  ordered_json report;
  report["iterations"] = ordered_json::array();
  const std::size_t passes = run.iterations.size();
  for (std::size_t i = 0; i < passes; ++i) {
    report["iterations"].push_back(iteration_json(run.iterations[i], i == 0, i + 1 == passes));
  }
  report["mesh"] = mesh_json(run);
  return report;
}

ordered_json run_json(const Settings& asked, const RunSummary& run) {
  ordered_json report = settings_used_json(asked, run.parameters, run.image);
  report["quality"] = quality_json(run);
  report.update(loop_json(run));
  report["surface"] = surface_json(run);
  report["converged"] = run.converged;
  report["stopped"] = run.stopped;
  report["seconds_parts"] = {{"prepare", run.seconds.prepare},
                             {"surface", run.seconds.surface},
                             {"printable", run.seconds.printable},
                             {"method", run.seconds.total}};
  return report;
}

ordered_json region_json(const MeshOutput& mesh) {
  const bool object = mesh.options.region == MeshRegion::kObject;
  ordered_json bins = ordered_json::array();
  for (std::size_t b = 0; b < mesh.bins.size(); ++b) {
    const MeshBin& bin = mesh.bins[b];
    bins.push_back({{"name", mesh.sets.sets[b].name},
                    {"native", {bin.low, bin.high}},
                    {"native_mean", bin.cells > 0 ? ordered_json(bin.native_mean) : nullptr},
                    {"cells", bin.cells},
                    {"volume_mm3", bin.volume}});
  }
  return {
      {"name", object ? "object" : "box"},
      {"level_native", object && mesh.level_native ? ordered_json(*mesh.level_native) : nullptr},
      {"cells", mesh.grid.mesh.cells.size()},
      {"nodes", mesh.grid.mesh.points.size()},
      {"volume_mm3", mesh.volume},
      {"components", mesh.components},
      {"bins", std::move(bins)}};
}

}  // namespace mesamis::detail::report
