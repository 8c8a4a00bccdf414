// SPDX-License-Identifier: Apache-2.0
#include "summary.h"

#include <fmt/format.h>

#include <algorithm>

#include "log.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/method/expected_error.h"

namespace mesamis {
namespace {

std::string plural(std::int64_t count, const std::string& what) {
  std::string digits = std::to_string(count);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, " ");
  return digits + " " + what + (count == 1 ? "" : "s");
}

std::string level_line(const RunFigures& run) {
  std::string line = run.level ? fmt::format("{:.4g} {}", *run.level, run.unit) : "none";
  if (run.expected_error) line += fmt::format(", expected error {:.3g} mm", *run.expected_error);
  return line;
}

std::string size_line(const RunFigures& run) {
  std::vector<Vec3> points;
  double volume = 0;
  for (const TriMesh* surface : run.surfaces) {
    points.insert(points.end(), surface->points.begin(), surface->points.end());
  }
  for (const SurfaceCheck& check : run.checks) volume += check.volume;
  if (points.empty()) return "none";
  const Vec3 size = bounding_box(points).extent();
  return fmt::format("{:.4g} x {:.4g} x {:.4g} mm, {:.4g} cm^3", size.x, size.y, size.z,
                     volume / 1000);
}

std::string surface_line(const RunFigures& run) {
  std::int64_t triangles = 0, parts = 0;
  bool closed = true;
  for (const TriMesh* surface : run.surfaces) {
    triangles += static_cast<std::int64_t>(surface->triangles.size());
  }
  for (const SurfaceCheck& check : run.checks) {
    parts += check.components;
    closed &= check.closed();
  }
  return plural(triangles, "triangle") + ", " + plural(parts, "part") +
         (closed ? ", closed" : ", not closed");
}

/// Those of one folder together.
std::string files_line(const RunFigures& run) {
  std::string line, folder = "?";
  for (const auto& file : run.files) {
    const std::string parent = file.parent_path().string();
    if (parent != folder && !parent.empty()) line += (line.empty() ? "" : "; ") + parent + ":";
    folder = parent;
    line += (line.empty() ? "" : " ") + file.filename().string();
  }
  return line.empty() ? "none" : line;
}

}  // namespace

RunFigures figures_of(const OutcomeDetails& outcome) {
  RunFigures figures;
  figures.checks = outcome.checks;
  for (const FoundObject& object : outcome.objects()) {
    figures.object += (figures.object.empty() ? "" : ", ") + object.segment.name;
    figures.surfaces.push_back(&object.surface);
  }
  if (!outcome.one) return figures;
  const Result& result = *outcome.one;
  const bool named = outcome.object && !outcome.object->tissue.empty();
  figures.object = named ? outcome.object->tissue : "all that is bright";
  if (result.parameters.surface == SurfaceKind::kSolid) figures.level = result.parameters.level;
  figures.unit = outcome.grid.modality == "CT" ? "HU" : "native units";
  if (!result.expected_error.empty()) {
    figures.expected_error = summarize_error(result.surface, result.expected_error).mean;
  }
  return figures;
}

std::vector<std::string> summary_lines(const RunFigures& run) {
  return {"object   " + run.object, "level    " + level_line(run), "size     " + size_line(run),
          "surface  " + surface_line(run), "files    " + files_line(run)};
}

void show_summary(const RunFigures& run) {
  if (!log_allows_bar()) return;
  for (const std::string& line : summary_lines(run)) log_info(line);
}

}  // namespace mesamis
