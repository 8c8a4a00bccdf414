// SPDX-License-Identifier: Apache-2.0
#include "summary.h"

#include <fmt/format.h>

#include <algorithm>

#include "log.h"
#include "mesamis/base/written_number.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/method/expected_error.h"

namespace mesamis {
namespace {

/// "105 158"
std::string grouped(std::int64_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, " ");
  return digits;
}

std::string plural(std::int64_t count, const std::string& what) {
  return grouped(count) + " " + what + (count == 1 ? "" : "s");
}

/// "0.30 mm"
std::string error_text(double mm) { return significant_text(mm, 2) + " mm"; }

/// "320 x 219 x 98.4 mm, 803 cm³"
std::string size_text(const Vec3& size, double mm3) {
  constexpr int kDigits = 3;
  return significant_text(size.x, kDigits) + " x " + significant_text(size.y, kDigits) + " x " +
         significant_text(size.z, kDigits) + " mm, " + significant_text(mm3 / 1000, kDigits) +
         " cm³";
}

std::string closed_text(const SurfaceCheck& check) {
  return check.closed() ? "closed" : "not closed";
}

/// "1 part, 13 cavities": only of a closed surface is it known which skins enclose holes.
std::string parts_text(const SurfaceCheck& check) {
  if (!check.closed()) return plural(check.components, "part");
  const std::string parts = plural(check.islands, "part");
  if (check.cavities == 0) return parts;
  return parts + ", " + grouped(check.cavities) + (check.cavities == 1 ? " cavity" : " cavities");
}

/// One of several.
std::string object_text(const ObjectFigures& object) {
  if (object.triangles == 0) return object.name + ": no surface";
  std::string text = object.name + ": " + plural(object.triangles, "triangle") + ", " +
                     size_text(object.size, object.check.volume);
  if (object.expected_error) text += ", error " + error_text(*object.expected_error);
  return text + ", " + closed_text(object.check);
}

/// The only one, whose figures follow in lines of their own.
std::string single_text(const ObjectFigures& object) {
  if (object.triangles == 0) return object.name + ": no surface";
  return object.name + ", " + parts_text(object.check) + ", " + closed_text(object.check);
}

/// The lines that name the objects, without their heads.
std::vector<std::string> object_texts(const RunFigures& run) {
  constexpr std::size_t kMost = 12;
  if (run.objects.empty()) return {"none"};
  if (run.objects.size() == 1) return {single_text(run.objects.front())};
  std::vector<ObjectFigures> sorted = run.objects;
  if (sorted.size() > kMost) {
    std::stable_partition(sorted.begin(), sorted.end(),
                          [](const ObjectFigures& o) { return !o.check.closed(); });
  }
  std::vector<std::string> texts;
  for (std::size_t n = 0; n < std::min(kMost, sorted.size()); ++n) {
    texts.push_back(object_text(sorted[n]));
  }
  if (sorted.size() > kMost) {
    texts.push_back("and " + std::to_string(sorted.size() - kMost) + " more");
  }
  return texts;
}

std::string whole_size(const RunFigures& run) {
  double volume = 0;
  for (const ObjectFigures& object : run.objects) volume += object.check.volume;
  return run.objects.empty() ? "none" : size_text(run.size, volume);
}

std::string surface_text(const RunFigures& run) {
  std::int64_t triangles = 0;
  for (const ObjectFigures& object : run.objects) triangles += object.triangles;
  std::string text = plural(triangles, "triangle");
  if (run.shared > 0) text += " (" + grouped(run.shared) + " that two objects share count twice)";
  if (!run.level) return text;
  const std::string level =
      text + fmt::format(", level {} {}", significant_text(*run.level, 4), run.unit);
  if (!run.level_range) return level;
  const auto [low, high] = *run.level_range;
  return level + fmt::format(" ({} to {} from place to place)", significant_text(low, 3),
                             significant_text(high, 3));
}

std::string expected_text(const RunFigures& run) {
  if (!run.expected_error) return "not known";
  const std::string text = error_text(*run.expected_error) + " expected in the mean";
  return run.largest_error ? text + ", 95 % below " + error_text(*run.largest_error) : text;
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

/// The one object, and its level.
void name_object(const OutcomeDetails& outcome, RunFigures& figures) {
  const Result& result = *outcome.one;
  const bool named = outcome.object && !outcome.object->tissue.empty();
  if (!figures.objects.empty()) {
    figures.objects.front().name = named ? outcome.object->tissue : "all that is bright";
  }
  const bool solid = result.parameters.surface == SurfaceKind::kSolid;
  if (solid && !outcome.is_of_range()) figures.level = result.parameters.level;
  if (result.image.has_local_levels()) figures.level_range = result.image.level_range;
  // Of the object's image only a bright one is called CT.
  const bool is_ct =
      outcome.grid.modality == "CT" || (outcome.object && outcome.object->hounsfield);
  figures.unit = is_ct ? "HU" : "native units";
}

}  // namespace

RunFigures figures_of(const OutcomeDetails& outcome) {
  RunFigures figures;
  std::vector<Vec3> points;
  double area = 0, error = 0;
  const std::vector<FoundObject> objects = outcome.objects();
  for (std::size_t n = 0; n < objects.size(); ++n) {
    const TriMesh& surface = objects[n].surface;
    ObjectFigures& object = figures.objects.emplace_back();
    object.name = objects[n].segment.name;
    object.triangles = std::ssize(surface.triangles);
    object.check = outcome.checks[n];
    if (surface.points.empty()) continue;
    object.size = bounding_box(surface.points).extent();
    points.insert(points.end(), surface.points.begin(), surface.points.end());
    const std::vector<double>& expected = outcome.expected_error(n);
    if (expected.empty()) continue;
    const ErrorSummary summary = summarize_error(surface, expected);
    if (!summary.is_known()) continue;
    object.expected_error = summary.mean;
    figures.largest_error = summary.percentile95;
    error += summary.mean * summary.area;
    area += summary.area;
  }
  if (!points.empty()) figures.size = bounding_box(points).extent();
  if (area > 0) figures.expected_error = error / area;
  if (objects.size() > 1) {
    figures.largest_error.reset();
    figures.shared = shared_triangles(objects);
  }
  if (outcome.one) name_object(outcome, figures);
  return figures;
}

std::vector<std::string> summary_lines(const RunFigures& run) {
  std::vector<std::string> lines;
  for (const std::string& text : object_texts(run)) lines.push_back("object   " + text);
  lines.push_back("size     " + whole_size(run));
  lines.push_back("surface  " + surface_text(run));
  lines.push_back("error    " + expected_text(run));
  lines.push_back("files    " + files_line(run));
  return lines;
}

void show_summary(const RunFigures& run) {
  for (const std::string& line : summary_lines(run)) log_info(line);
}

}  // namespace mesamis
