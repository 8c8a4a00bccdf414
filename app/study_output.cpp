// SPDX-License-Identifier: Apache-2.0
#include "study_output.h"

#include <algorithm>
#include <cstdio>

#include "log.h"
#include "mesamis/base/error.h"
#include "mesamis/io/atomic_file.h"
#include "mesamis/io/plot.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using Pointer = ordered_json::json_pointer;

/// A column of a table, and where study.json has its values.
struct Column {
  const char* name;
  const char* place;
};

constexpr Column kRunColumns[] = {
    {"run", "/name"},
    {"s", "/s"},
    {"slices", "/size/2"},
    {"spacing_z_mm", "/spacing_mm/2"},
    {"tets", "/mesh/tets"},
    {"nodes", "/mesh/nodes"},
    {"triangles_extracted", "/surface/triangles_extracted"},
    {"triangles", "/surface/triangles"},
    {"triangle_reduction_percent", "/compared/triangle_reduction_percent"},
    {"energy_mm3", "/energy_mm3"},
    {"aspect_max", "/aspect_max"},
    {"aspect_mean", "/aspect_mean"},
    {"adaptations", "/adaptations"},
    {"converged", "/converged"},
    {"seconds", "/seconds"},
    {"reference_to_surface_mean_mm", "/distances/reference_to_surface/mean"},
    {"reference_to_surface_area_mean_mm", "/distances/reference_to_surface/by_area/mean"},
    {"surface_to_reference_mean_mm", "/distances/surface_to_reference/mean"},
    {"surface_to_reference_area_mean_mm", "/distances/surface_to_reference/by_area/mean"},
    {"hausdorff_mm", "/distances/paper/hausdorff"},
    {"distance_variation_percent", "/compared/distance_variation_percent"}};

constexpr Column kIterationColumns[] = {{"tets", "/tets"},
                                        {"nodes", "/nodes"},
                                        {"energy", "/energy"},
                                        {"energy_change", "/energy_change"},
                                        {"mesh_change", "/mesh_change"},
                                        {"estimator", "/estimator"}};

/// What stands at a place; nothing there, or null, is an empty cell.
std::string cell(const ordered_json& object, const char* place) {
  const Pointer pointer(place);
  if (!object.contains(pointer) || object[pointer].is_null()) return "";
  const ordered_json& value = object[pointer];
  return value.is_string() ? value.get<std::string>() : value.dump();
}

template <std::size_t N>
std::string names_of(const Column (&columns)[N]) {
  std::string line;
  for (const Column& column : columns) line += (line.empty() ? "" : ",") + std::string(column.name);
  return line;
}

template <std::size_t N>
std::string cells_of(const Column (&columns)[N], const ordered_json& object) {
  std::string line;
  for (const Column& column : columns) {
    line += (&column == columns ? "" : ",") + cell(object, column.place);
  }
  return line;
}

std::string runs_csv(const std::vector<StudyRun>& runs) {
  std::string text = names_of(kRunColumns) + "\n";
  for (const StudyRun& run : runs) text += cells_of(kRunColumns, run.json) + "\n";
  return text;
}

std::string convergence_csv(const std::vector<StudyRun>& runs) {
  std::string text = "run,s,iteration," + names_of(kIterationColumns) + "\n";
  for (const StudyRun& run : runs) {
    int number = 0;
    for (const auto& iteration : run.json.value("iterations", ordered_json::array())) {
      text += run.plan.name + "," + std::to_string(run.plan.s) + "," + std::to_string(++number) +
              "," + cells_of(kIterationColumns, iteration) + "\n";
    }
  }
  return text;
}

std::vector<Direction> measured(const std::vector<StudyRun>& runs) {
  std::vector<Direction> directions;
  for (const StudyRun& run : runs) {
    if (!run.reference_to_surface.from_vertices.empty()) {
      directions.push_back(run.reference_to_surface);
    }
  }
  return directions;
}

/// A mean distance over s, of the runs that have one; of a region, without the run on all voxels.
PlotSeries distance_series(const std::vector<StudyRun>& runs, const std::string& name,
                           const char* place) {
  PlotSeries series{name, {}, {}};
  const Pointer pointer(place);
  for (const StudyRun& run : runs) {
    if (run.plan.name == "region_full" || !run.json.contains(pointer)) continue;
    series.x.push_back(run.plan.s);
    series.y.push_back(run.json[pointer].get<double>());
  }
  return series;
}

std::vector<PlotSeries> distance_curves(const std::vector<StudyRun>& runs) {
  return {distance_series(runs, "reference to surface, vertices (15)",
                          "/distances/reference_to_surface/mean"),
          distance_series(runs, "reference to surface, by area",
                          "/distances/reference_to_surface/by_area/mean"),
          distance_series(runs, "surface to reference, vertices",
                          "/distances/surface_to_reference/mean"),
          distance_series(runs, "surface to reference, by area",
                          "/distances/surface_to_reference/by_area/mean")};
}

/// The share of the reference's vertices in each bin, as stairs.
std::vector<PlotSeries> histogram_stairs(const std::vector<Direction>& directions) {
  const DistanceHistogram histogram = histogram_of(directions);
  std::vector<PlotSeries> stairs;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    const auto& counts = histogram.columns[2 * d].counts;  // of the vertices
    const double all = static_cast<double>(directions[d].from_vertices.size());
    PlotSeries series{directions[d].name, {}, {}, false};
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
      const double from = static_cast<double>(bin) * histogram.width;
      const double percent = 100 * static_cast<double>(counts[bin]) / all;
      series.x.insert(series.x.end(), {from, from + histogram.width});
      series.y.insert(series.y.end(), {percent, percent});
    }
    stairs.push_back(std::move(series));
  }
  return stairs;
}

/// A figure of every iteration, times a factor of the run's.
template <class Factor>
std::vector<PlotSeries> iteration_curves(const std::vector<StudyRun>& runs, const char* figure,
                                         const Factor& factor) {
  std::vector<PlotSeries> curves;
  for (const StudyRun& run : runs) {
    PlotSeries series{run.plan.name, {}, {}};
    for (const auto& iteration : run.json.value("iterations", ordered_json::array())) {
      series.x.push_back(static_cast<double>(series.x.size() + 1));
      series.y.push_back(factor(run) * iteration[figure].template get<double>());
    }
    if (!series.x.empty()) curves.push_back(std::move(series));
  }
  return curves;
}

double cubic_unit(const StudyRun& run) {
  const auto unit = run.json["grey"]["length_unit_mm"].get<double>();
  return unit * unit * unit;
}

struct Plot {
  std::string name;
  std::vector<PlotSeries> series;
  PlotOptions options;
};

std::vector<Plot> plots_of(const std::vector<StudyRun>& runs) {
  const auto plot = [](const std::string& title, const std::string& x, const std::string& y) {
    PlotOptions options;
    options.title = title;
    options.x_label = x;
    options.y_label = y;
    return options;
  };
  std::vector<Plot> plots{
      {"distance.png", distance_curves(runs),
       plot("Mean distance between reference and surface", "s (every s-th slice is kept)",
            "mean distance, mm")},
      {"histogram.png", histogram_stairs(measured(runs)),
       plot("Distances (16) from the reference's vertices to the surface", "distance, mm",
            "share of the vertices, %")},
      {"energy.png", iteration_curves(runs, "energy", cubic_unit),
       plot("Energy after each minimisation", "iteration", "energy, grey value² mm³")},
      {"cells.png", iteration_curves(runs, "tets", [](const StudyRun&) { return 1.0; }),
       plot("Cells of the mesh minimised on", "iteration", "tetrahedra")}};
  plots[1].options.log_y = true;
  plots[3].options.log_y = true;
  return plots;
}

bool has_points(const Plot& plot) {
  return std::any_of(plot.series.begin(), plot.series.end(),
                     [](const PlotSeries& series) { return !series.x.empty(); });
}

}  // namespace

void write_tables(const fs::path& folder, const std::string& prefix,
                  const std::vector<StudyRun>& runs) {
  write_file(folder / (prefix + "runs.csv"), runs_csv(runs));
  write_file(folder / (prefix + "convergence.csv"), convergence_csv(runs));
  write_file(folder / (prefix + "histogram.csv"), to_csv(histogram_of(measured(runs))));
}

std::vector<std::string> draw_pictures(const fs::path& folder, const std::string& prefix,
                                       const std::vector<StudyRun>& runs) {
  std::vector<std::string> drawn;
  try {
    for (const Plot& plot : plots_of(runs)) {
      if (!has_points(plot)) continue;
      draw_plot(folder / (prefix + plot.name), plot.series, plot.options);
      drawn.push_back(prefix + plot.name);
    }
  } catch (const InputError& error) {
    log_warning(std::string("no diagrams, tables only: ") + error.what());
  }
  return drawn;
}

void print_table(const std::vector<StudyRun>& runs) {
  std::printf("%-12s %7s %9s %9s %8s %9s %9s %9s %9s\n", "run", "slices", "tets", "triangles",
              "seconds", "ref->surf", "by area", "surf->ref", "by area");
  for (const StudyRun& run : runs) {
    const auto text = [&run](const char* place, const char* format) {
      const Pointer pointer(place);
      if (!run.json.contains(pointer)) return std::string("-");
      char number[32];
      std::snprintf(number, sizeof number, format, run.json[pointer].get<double>());
      return std::string(number);
    };
    std::printf("%-12s %7s %9s %9s %8s %9s %9s %9s %9s\n", run.plan.name.c_str(),
                text("/size/2", "%.0f").c_str(), text("/mesh/tets", "%.0f").c_str(),
                text("/surface/triangles", "%.0f").c_str(), text("/seconds", "%.1f").c_str(),
                text("/distances/reference_to_surface/mean", "%.4f").c_str(),
                text("/distances/reference_to_surface/by_area/mean", "%.4f").c_str(),
                text("/distances/surface_to_reference/mean", "%.4f").c_str(),
                text("/distances/surface_to_reference/by_area/mean", "%.4f").c_str());
  }
}

}  // namespace mesamis
