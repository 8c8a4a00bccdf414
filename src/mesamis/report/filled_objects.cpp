// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/filled_objects.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "mesamis/base/error.h"

namespace mesamis::detail::report {
namespace {

constexpr double kVoxelsPerElement = 3;

bool mirrors(const VoxelGrid& grid) { return determinant(grid.direction) < 0; }

/// A left-handed grid mirrors what goes through it.
void turn_inside_out(TriMesh& surface) {
  for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
}

/// A point that rounding has moved off the border of the scan is put back. Surfaces come in single
/// precision of the world.
Vec3 snapped(Vec3 p, const VoxelGrid& grid) {
  constexpr double kRounding = std::numeric_limits<float>::epsilon();
  const Box scan = grid.box();
  const double near = kRounding * (norm(scan.extent()) + norm(grid.origin));
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(p[axis] - scan.lo[axis]) < near) p[axis] = scan.lo[axis];
    if (std::abs(p[axis] - scan.hi[axis]) < near) p[axis] = scan.hi[axis];
  }
  return p;
}

TriMesh in_grid(TriMesh surface, const VoxelGrid& grid) {
  for (Vec3& p : surface.points) p = snapped(grid.to_grid(p), grid);
  if (mirrors(grid)) turn_inside_out(surface);
  return surface;
}

TriMesh in_world(TriMesh surface, const VoxelGrid& grid) {
  for (Vec3& p : surface.points) p = grid.to_world(p);
  if (mirrors(grid)) turn_inside_out(surface);
  return surface;
}

/// Around all surfaces; where one ends at the border of the scan, that border.
Box box_around(std::span<const TriMesh> surfaces, const Box& scan, double margin) {
  Box around = bounding_box(surfaces);
  for (int axis = 0; axis < 3; ++axis) {
    if (around.lo[axis] != scan.lo[axis]) around.lo[axis] -= margin;
    if (around.hi[axis] != scan.hi[axis]) around.hi[axis] += margin;
  }
  return around;
}

void require_skin(const TriMesh& skin, const FoundObject& object, double element_size) {
  if (!skin.triangles.empty()) return;
  throw InputError(
      "'" + object.segment.name +
      "': expected elements of its size at most, found none left of it with those of " +
      std::to_string(element_size) + " mm");
}

}  // namespace

double element_size(const BodyOptions& options, const VoxelGrid& grid) {
  return options.element_size > 0 ? options.element_size : kVoxelsPerElement * grid.voxel_size();
}

FilledObjects fill_objects(std::span<const FoundObject> objects, const VoxelGrid& grid,
                           const BodyOptions& options) {
  BodyOptions sized = options;
  sized.element_size = element_size(options, grid);
  std::vector<TriMesh> surfaces;
  surfaces.reserve(objects.size());
  for (const FoundObject& object : objects) surfaces.push_back(in_grid(object.surface, grid));
  const Box box = box_around(surfaces, grid.box(), sized.element_size);
  FilledObjects filled{make_body(surfaces, box, sized), {}};
  for (TriMesh& skin : filled.body.skins) {
    require_skin(skin, objects[filled.skins.size()], sized.element_size);
    filled.skins.push_back(in_world(std::move(skin), grid));
  }
  filled.body.skins.clear();
  return filled;
}

}  // namespace mesamis::detail::report
