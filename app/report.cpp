// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <algorithm>
#include <sstream>

#include "json_file.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/self_intersections.h"
#include "process.h"
#include "settings_json.h"

namespace mesamis {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json energy_json(const Energy& e) {
  return {
      {"total", e.total()}, {"fidelity", e.fidelity}, {"smoothing", e.smoothing}, {"edge", e.edge}};
}

/// What a pass has not measured is null: the first has no energy before it, the last leads to no
/// other mesh.
ordered_json iteration_json(const Iteration& i, bool is_first, bool is_last) {
  auto known = [](bool is_known, double value) { return is_known ? json(value) : json(); };
  return {{"tets", i.tets},
          {"nodes", i.nodes},
          {"energy", i.energy.total()},
          {"energy_parts", energy_json(i.energy)},
          {"energy_change", known(!is_first, i.energy_change)},
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

ordered_json mesh_json(const Result& result) {
  return {{"tets", result.mesh.cells.size()},
          {"nodes", result.mesh.points.size()},
          {"edge_unit_fraction", result.fit.unit_edge_fraction},
          {"quality_min", result.fit.quality_min},
          {"quality_mean", result.fit.quality_mean}};
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

ordered_json surface_json(const Result& result, const SurfaceCheck& check) {
  const bool solid = result.settings.surface == SurfaceKind::kSolid;
  ordered_json j{{"kind", solid ? "solid" : "band"}};
  if (solid) {
    j["level_native"] = result.level_native;
    j["level_grey"] = result.grey.to_grey(result.level_native);
    j.update(printable_json(result.printable, result.settings));
  }
  j.update(check_json(result.surface, check));
  j["self_intersections"] = find_self_intersections(result.surface).size();
  return j;
}

/// Names of the settings that were left to the program.
ordered_json chosen(const Settings& asked) {
  ordered_json names = ordered_json::array();
  const ordered_json values = to_json(asked);
  for (const auto& [name, value] : values.items()) {
    if (value == "auto") names.push_back(name);
  }
  return names;
}

}  // namespace

InputFacts facts_of(const std::filesystem::path& path, const VolumeFile& file, Frame frame) {
  const Volume& volume = file.volume;
  InputFacts facts{
      path, file.format,   sha256(path), volume.modality, volume.size, volume.spacing, 0,
      0,    file.warnings, frame};
  if (!volume.samples.empty()) {
    const auto [low, high] = std::minmax_element(volume.samples.begin(), volume.samples.end());
    facts.lowest = *low;
    facts.highest = *high;
  }
  return facts;
}

ordered_json input_json(const InputFacts& input) {
  return {{"path", input.path.string()},
          {"format", input.format},
          {"sha256", input.sha256},
          {"size", input.size},
          {"spacing_mm", vec_json(input.spacing)},
          {"range", {input.lowest, input.highest}},
          {"modality", input.modality},
          {"warnings", input.warnings}};
}

void add_costs(ordered_json& report) {
  report["seconds"] = wall_seconds();
  report["peak_memory_mb"] = peak_memory_mb();
}

ordered_json printable_json(const PrintableReport& printable, const Settings& settings) {
  const auto& tolerance = settings.tolerance;
  return {{"tolerance_mm", tolerance ? ordered_json(*tolerance) : ordered_json(nullptr)},
          {"triangles_extracted", printable.triangles_extracted},
          {"distance_extracted_to_result_max", printable.extracted_to_result},
          {"distance_result_to_extracted_max", printable.result_to_extracted},
          {"parts", parts_json(printable.parts)}};
}

std::string tolerance_unmet(double tolerance, const PrintableReport& printable) {
  std::ostringstream line;
  line << "tolerance: expected distances of " << tolerance << " mm at most, found "
       << printable.extracted_to_result << " and " << printable.result_to_extracted
       << ": single precision is too coarse so far from the origin";
  return line.str();
}

ordered_json check_json(const TriMesh& surface, const SurfaceCheck& check) {
  return {{"triangles", surface.triangles.size()},
          {"vertices", surface.points.size()},
          {"closed", check.closed()},
          {"manifold", check.manifold()},
          {"components", check.components},
          {"volume_mm3", check.volume},
          {"area_mm2", check.area}};
}

Settings settings_used(const Result& result) {
  Settings used = result.settings;
  used.threshold_rule = result.threshold_used ? ThresholdRule::kValue : ThresholdRule::kNone;
  used.threshold = result.grey.threshold;
  if (used.surface == SurfaceKind::kSolid) used.level = result.level_native;
  return used;
}

ordered_json run_json(const Settings& settings, const Result& result, const SurfaceCheck& surface) {
  ordered_json report;
  report["settings"] = to_json(settings_used(result));
  report["chosen"] = chosen(settings);
  report["grey"] = {
      {"length_unit_mm", result.unit_mm},
      {"window_native", {result.grey.low, result.grey.high}},
      {"threshold_grey", result.threshold_used
                             ? ordered_json(result.grey.to_grey(result.grey.threshold))
                             : ordered_json(nullptr)}};
  report["image"] = {{"noise_left", result.restored.noise_left},
                     {"impulse_share", result.restored.impulses}};
  report["iterations"] = ordered_json::array();
  const std::size_t passes = result.iterations.size();
  for (std::size_t i = 0; i < passes; ++i) {
    report["iterations"].push_back(iteration_json(result.iterations[i], i == 0, i + 1 == passes));
  }
  report["mesh"] = mesh_json(result);
  report["surface"] = surface_json(result, surface);
  report["converged"] = result.converged;
  report["seconds_parts"] = {{"prepare", result.seconds.prepare},
                             {"surface", result.seconds.surface},
                             {"printable", result.seconds.printable},
                             {"method", result.seconds.total}};
  return report;
}

ordered_json segment_report(const InputFacts& input, const Settings& settings, const Result& result,
                            const SurfaceCheck& surface) {
  ordered_json report;
  report["program"] = program_json();
  report["input"] = input_json(input);
  report["output"] = {{"frame", input.frame == Frame::kRas ? "ras" : "lps"},
                      {"threads", thread_count()}};
  report.update(run_json(settings, result, surface));
  add_costs(report);
  return report;
}

}  // namespace mesamis
