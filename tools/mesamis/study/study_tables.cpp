// SPDX-License-Identifier: Apache-2.0
#include "mesamis/study/study_tables.h"

#include <functional>
#include <nlohmann/json.hpp>

#include "mesamis/files/atomic_file.h"
#include "mesamis/study/measured_distances.h"

namespace mesamis::detail::study {
namespace {

std::string text(std::int64_t value) { return std::to_string(value); }

/// The digits of study.json.
std::string text(double value) { return nlohmann::json(value).dump(); }

std::string text(const std::optional<double>& value) { return value ? text(*value) : ""; }

/// A column of a table with a row per `Row`.
template <class Row>
struct Column {
  const char* name;
  std::string (*cell)(const Row&);
};

/// The cell of a figure of the run; empty if the method failed.
template <auto figure>
std::string run_cell(const StudyRun& run) {
  return run.summary ? text(std::invoke(figure, *run.summary)) : "";
}

/// The cell of a property of the volume segmented; empty if the method failed.
template <auto property>
std::string grid_cell(const StudyRun& run) {
  return run.summary ? text(std::invoke(property, run.grid)) : "";
}

/// The cell of a figure of the comparison; empty if there is none.
template <auto figure>
std::string comparison_cell(const StudyRun& run) {
  return run.comparison ? text(std::invoke(figure, *run.comparison)) : "";
}

/// A band is delivered as extracted: it has no count of triangles before decimation.
std::string triangles_extracted_cell(const StudyRun& run) {
  const bool solid = run.summary && run.summary->parameters.surface == SurfaceKind::kSolid;
  return solid ? text(run.summary->printable.triangles_extracted) : "";
}

using Run = const RunSummary&;
using Compared = const RunComparison&;

constexpr Column<StudyRun> kRunColumns[] = {
    {"run", [](const StudyRun& run) { return run.plan.name; }},
    {"s", [](const StudyRun& run) { return text(std::int64_t{run.plan.s}); }},
    {"slices", grid_cell<[](const Volume& v) { return std::int64_t{v.size[2]}; }>},
    {"spacing_z_mm", grid_cell<[](const Volume& v) { return v.spacing.z; }>},
    {"tets", run_cell<&RunSummary::tets>},
    {"nodes", run_cell<&RunSummary::nodes>},
    {"triangles_extracted", triangles_extracted_cell},
    {"triangles", run_cell<&RunSummary::triangles>},
    {"triangle_reduction_percent", comparison_cell<&RunComparison::triangle_reduction_percent>},
    {"energy_mm3", run_cell<&RunSummary::energy_mm3>},
    {"aspect_max", run_cell<[](Run run) { return run.iterations.back().aspect_max[0]; }>},
    {"aspect_mean", run_cell<[](Run run) { return run.iterations.back().aspect_mean[0]; }>},
    {"adaptations", run_cell<&RunSummary::adaptations>},
    {"converged",
     [](const StudyRun& run) { return std::string(run.converged() ? "true" : "false"); }},
    {"seconds", run_cell<[](Run run) { return run.seconds.total; }>},
    {"reference_to_surface_mean_mm",
     comparison_cell<[](Compared c) { return c.reference_to_surface.vertices.mean; }>},
    {"reference_to_surface_area_mean_mm",
     comparison_cell<[](Compared c) { return c.reference_to_surface.area.mean; }>},
    {"surface_to_reference_mean_mm",
     comparison_cell<[](Compared c) { return c.surface_to_reference.vertices.mean; }>},
    {"surface_to_reference_area_mean_mm",
     comparison_cell<[](Compared c) { return c.surface_to_reference.area.mean; }>},
    {"hausdorff_mm",
     comparison_cell<[](Compared c) { return c.reference_to_surface.vertices.max; }>},
    {"distance_variation_percent", comparison_cell<&RunComparison::variation_percent>}};

/// An iteration, and what it leaves unmeasured: the first has no energy before it, the last leads
/// to no other mesh.
struct IterationRow {
  const Iteration& iteration;
  bool is_first, is_last;
};

constexpr Column<IterationRow> kIterationColumns[] = {
    {"tets", [](const IterationRow& row) { return text(row.iteration.tets); }},
    {"nodes", [](const IterationRow& row) { return text(row.iteration.nodes); }},
    {"energy", [](const IterationRow& row) { return text(row.iteration.energy.total()); }},
    {"energy_change",
     [](const IterationRow& row) { return row.is_first ? "" : text(row.iteration.energy_change); }},
    {"surface_change_mm",
     [](const IterationRow& row) {
       return row.iteration.has_surface() ? text(row.iteration.surface_change) : "";
     }},
    {"mesh_change",
     [](const IterationRow& row) {
       return row.is_first || row.is_last ? "" : text(row.iteration.mesh_change);
     }},
    {"estimator",
     [](const IterationRow& row) { return row.is_last ? "" : text(row.iteration.estimator); }}};

template <class Row, std::size_t N>
std::string names_of(const Column<Row> (&columns)[N]) {
  std::string line;
  for (const auto& column : columns) line += (line.empty() ? "" : ",") + std::string(column.name);
  return line;
}

template <class Row, std::size_t N>
std::string cells_of(const Column<Row> (&columns)[N], const Row& row) {
  std::string line;
  for (const auto& column : columns) line += (&column == columns ? "" : ",") + column.cell(row);
  return line;
}

}  // namespace

std::string runs_csv(std::span<const StudyRun> runs) {
  std::string csv = names_of(kRunColumns) + "\n";
  for (const StudyRun& run : runs) csv += cells_of(kRunColumns, run) + "\n";
  return csv;
}

std::string convergence_csv(std::span<const StudyRun> runs) {
  std::string csv = "run,s,iteration," + names_of(kIterationColumns) + "\n";
  for (const StudyRun& run : runs) {
    if (!run.summary) continue;
    const auto& iterations = run.summary->iterations;
    for (std::size_t i = 0; i < iterations.size(); ++i) {
      const IterationRow row{iterations[i], i == 0, i + 1 == iterations.size()};
      csv += run.plan.name + "," + std::to_string(run.plan.s) + "," + std::to_string(i + 1) + "," +
             cells_of(kIterationColumns, row) + "\n";
    }
  }
  return csv;
}

std::string histogram_csv(std::span<const StudyRun> runs) {
  return to_csv(histogram_of(measured_distances(runs)));
}

void write_tables(const std::filesystem::path& folder, const std::string& prefix,
                  std::span<const StudyRun> runs) {
  write_file(folder / (prefix + "runs.csv"), runs_csv(runs));
  write_file(folder / (prefix + "convergence.csv"), convergence_csv(runs));
  write_file(folder / (prefix + "histogram.csv"), histogram_csv(runs));
}

}  // namespace mesamis::detail::study
