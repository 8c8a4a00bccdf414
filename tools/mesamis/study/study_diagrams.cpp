// SPDX-License-Identifier: Apache-2.0
#include "mesamis/study/study_diagrams.h"

#include <algorithm>

#include "mesamis/study/measured_distances.h"

namespace mesamis::detail::study {
namespace {

/// A mean distance over s. The baseline has no place on that axis: its voxels are smaller in the
/// plane, too.
template <class Mean>
PlotSeries distance_series(std::span<const StudyRun> runs, const std::string& name,
                           const Mean& mean) {
  PlotSeries series{name, {}, {}};
  for (const StudyRun& run : runs) {
    if (run.plan.baseline || !run.comparison) continue;
    series.x.push_back(run.plan.s);
    series.y.push_back(mean(*run.comparison));
  }
  return series;
}

std::vector<PlotSeries> distance_curves(std::span<const StudyRun> runs) {
  using Compared = const RunComparison&;
  return {distance_series(runs, "reference to surface, vertices (15)",
                          [](Compared c) { return c.reference_to_surface.vertices.mean; }),
          distance_series(runs, "reference to surface, by area",
                          [](Compared c) { return c.reference_to_surface.area.mean; }),
          distance_series(runs, "surface to reference, vertices",
                          [](Compared c) { return c.surface_to_reference.vertices.mean; }),
          distance_series(runs, "surface to reference, by area",
                          [](Compared c) { return c.surface_to_reference.area.mean; })};
}

/// The share of the vertices in each bin, as stairs.
PlotSeries stairs(const std::string& name, const std::vector<std::size_t>& counts, double width) {
  std::size_t total = 0;
  for (const std::size_t count : counts) total += count;
  PlotSeries series{name, {}, {}, false};
  for (std::size_t bin = 0; bin < counts.size(); ++bin) {
    const double from = static_cast<double>(bin) * width;
    const double percent = 100 * static_cast<double>(counts[bin]) / static_cast<double>(total);
    series.x.insert(series.x.end(), {from, from + width});
    series.y.insert(series.y.end(), {percent, percent});
  }
  return series;
}

std::vector<PlotSeries> histogram_stairs(const std::vector<DirectedDistances>& directions) {
  const DistanceHistogram histogram = histogram_of(directions);
  std::vector<PlotSeries> curves;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    const auto& of_vertices = histogram.columns[2 * d];
    curves.push_back(stairs(directions[d].name, of_vertices.counts, histogram.width));
  }
  return curves;
}

/// A figure of every iteration, a curve per run.
template <class Figure>
std::vector<PlotSeries> iteration_curves(std::span<const StudyRun> runs, const Figure& figure) {
  std::vector<PlotSeries> curves;
  for (const StudyRun& run : runs) {
    if (!run.summary) continue;
    PlotSeries series{run.plan.name, {}, {}};
    for (const Iteration& iteration : run.summary->iterations) {
      series.x.push_back(static_cast<double>(series.x.size() + 1));
      series.y.push_back(figure(*run.summary, iteration));
    }
    curves.push_back(std::move(series));
  }
  return curves;
}

double energy_mm3(const RunSummary& run, const Iteration& iteration) {
  const double unit = run.parameters.unit_mm;
  return unit * unit * unit * iteration.energy.total();
}

double cells(const RunSummary&, const Iteration& iteration) {
  return static_cast<double>(iteration.tets);
}

PlotOptions labels(const std::string& title, const std::string& x, const std::string& y) {
  PlotOptions options;
  options.title = title;
  options.x_label = x;
  options.y_label = y;
  return options;
}

PlotOptions with_log_y(PlotOptions options) {
  options.log_y = true;
  return options;
}

bool is_empty(const Diagram& diagram) {
  return std::all_of(diagram.series.begin(), diagram.series.end(),
                     [](const PlotSeries& series) { return series.x.empty(); });
}

}  // namespace

std::vector<Diagram> study_diagrams(std::span<const StudyRun> runs) {
  std::vector<Diagram> diagrams{
      {"distance.svg", distance_curves(runs),
       labels("Mean distance between reference and surface", "s (every s-th slice is kept)",
              "mean distance, mm")},
      {"histogram.svg", histogram_stairs(measured_distances(runs)),
       with_log_y(labels("Distances (16) from the reference's vertices to the surface",
                         "distance, mm", "share of the vertices, %"))},
      {"energy.svg", iteration_curves(runs, energy_mm3),
       labels("Energy after each minimisation", "iteration", "energy, grey value² mm³")},
      {"cells.svg", iteration_curves(runs, cells),
       with_log_y(labels("Cells of the mesh minimised on", "iteration", "tetrahedra"))}};
  std::erase_if(diagrams, is_empty);
  return diagrams;
}

std::vector<std::string> draw_diagrams(const std::filesystem::path& folder,
                                       const std::string& prefix, std::span<const StudyRun> runs) {
  std::vector<std::string> names;
  for (const Diagram& diagram : study_diagrams(runs)) {
    names.push_back(prefix + diagram.name);
    draw_plot(folder / names.back(), diagram.series, diagram.options);
  }
  return names;
}

}  // namespace mesamis::detail::study
