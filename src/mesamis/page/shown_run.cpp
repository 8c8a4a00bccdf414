// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/shown_run.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "mesamis/base/error.h"
#include "mesamis/page/figures.h"

namespace mesamis::detail::page {
namespace {

/// Of one object; stands out from grey.
constexpr Colour kBone{242, 192, 128}, kOutline{255, 140, 26};

std::vector<ShownSurface> surfaces_of(const RunPage& page) {
  std::vector<ShownSurface> shown;
  for (const PageSurface& s : page.surfaces) {
    if (s.surface == nullptr) continue;
    require_sound(*s.surface);
    if (s.surface->triangles.empty()) continue;
    if (!s.error.empty() && s.error.size() != s.surface->points.size()) {
      throw InputError("page: expected an error per point of the surface, " +
                       std::to_string(s.surface->points.size()) + ", found " +
                       std::to_string(s.error.size()));
    }
    shown.push_back({s.surface, s.name, s.colour, s.colour, s.error});
  }
  if (shown.size() == 1) {
    shown[0].colour = kBone;
    shown[0].outline = kOutline;
  }
  return shown;
}

std::optional<ShownMesh> mesh_of(const RunPage& page) {
  if (page.mesh == nullptr || page.mesh->cells.empty()) return {};
  if (page.grey.size() != page.mesh->points.size()) {
    throw InputError("page: expected a grey value per node of the mesh, " +
                     std::to_string(page.mesh->points.size()) + ", found " +
                     std::to_string(page.grey.size()));
  }
  return ShownMesh{page.mesh, page.grey};
}

/// A grid around points, fine enough to name a plane.
VoxelGrid grid_around(const std::vector<Vec3>& points) {
  constexpr Index kPlanes = 201;
  const Box box = bounding_box(points);
  VoxelGrid grid;
  grid.size = {kPlanes, kPlanes, kPlanes};
  grid.origin = box.lo;
  for (int a = 0; a < 3; ++a) grid.spacing[a] = std::max(box.extent()[a], 1e-6) / (kPlanes - 1);
  return grid;
}

VoxelGrid grid_of(const RunPage& page, const ShownRun& run) {
  if (page.scan != nullptr) return *page.scan;
  std::vector<Vec3> points;
  if (run.mesh) points = run.mesh->mesh->points;
  for (const ShownSurface& s : run.surfaces) {
    points.insert(points.end(), s.surface->points.begin(), s.surface->points.end());
  }
  return points.empty() ? VoxelGrid{} : grid_around(points);
}

Window window_of(const RunPage& page) {
  const nlohmann::json& given = entry(page.report, "/grey/window_native");
  if (given.is_array() && given.size() == 2 && given[0].is_number() && given[1].is_number()) {
    const Window window{given[0].get<double>(), given[1].get<double>()};
    if (window.low < window.high) return window;
  }
  const auto ends = quantiles(page.scan->samples, {0.005, 0.995});
  return {ends[0], ends[1] > ends[0] ? ends[1] : ends[0] + 1};
}

}  // namespace

ShownRun shown_run(const RunPage& page) {
  ShownRun run;
  run.surfaces = surfaces_of(page);
  run.mesh = mesh_of(page);
  run.grid = grid_of(page, run);
  if (page.scan == nullptr) return run;
  require_usable(*page.scan);
  run.window = window_of(page);
  for (const int axis : {2, 1, 0}) {
    run.slices.push_back(slice_view(*page.scan, run.surfaces, axis, run.window));
  }
  return run;
}

Raster cut_picture(const ShownRun& run, int pixels) {
  const SlicePlane plane = plane_through(run.grid, run.surfaces, 2);
  std::vector<std::vector<PageLine>> outlines;
  for (const ShownSurface& s : run.surfaces) {
    outlines.push_back(cross_section(*s.surface, run.grid, plane));
  }
  const PageBox box = region_around(outlines, box_of(run.grid, plane));
  Raster picture = mesh_cut(*run.mesh, run.grid, plane, {box, pixels});
  const double scale = picture.width / box.width();
  for (std::size_t n = 0; n < outlines.size(); ++n) {
    for (const PageLine& line : outlines[n]) {
      for (std::size_t p = 1; p < line.size(); ++p) {
        const auto at = [&](std::size_t i) {
          return std::array{scale * (line[i][0] - box.left), scale * (box.top - line[i][1])};
        };
        draw_line(picture, {at(p - 1), at(p)}, 1.6, run.surfaces[n].outline);
      }
    }
  }
  return picture;
}

}  // namespace mesamis::detail::page
