// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/make_body.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/body/body_surface.h"
#include "mesamis/body/size_field.h"
#include "mesamis/mesh/region.h"

namespace mesamis {
namespace {

/// What the operations are held to, as a share of the tolerance: they look at four points of a
/// triangle, and others lie further away. The volume, too, errs by half as much.
constexpr double kAimed = 0.5;

Box box_of(std::span<const TriMesh> surfaces) {
  std::vector<Vec3> corners;
  for (const TriMesh& surface : surfaces) {
    const Box box = bounding_box(surface.points);
    corners.insert(corners.end(), {box.lo, box.hi});
  }
  return bounding_box(corners);
}

SizeRules size_rules(const BodyOptions& options, double longest) {
  constexpr double kElementsAlong = 30, kSmaller = 4;
  SizeRules rules;
  rules.target = options.element_size > 0 ? options.element_size : longest / kElementsAlong;
  if (rules.target > longest) {
    throw InputError("body: expected an element size of at most " + std::to_string(longest) +
                     " mm, the longest side of the body, found " + std::to_string(rules.target));
  }
  rules.least =
      options.least_size > 0 ? std::min(options.least_size, rules.target) : rules.target / kSmaller;
  rules.tolerance = kAimed * options.tolerance;
  rules.gradation = options.gradation;
  rules.through_wall = options.through_wall;
  return rules;
}

/// Progress of one of two halves of the work.
Progress half_of(const Progress& whole, double begin) {
  if (!whole) return {};
  return [whole, begin](std::string_view stage, double fraction) {
    return whole(stage, begin + 0.5 * fraction);
  };
}

double volume_of(const TetMesh& mesh) {
  double volume = 0;
  for (Index c = 0; c < std::ssize(mesh.cells); ++c) volume += cell_volume(mesh, c);
  return volume;
}

/// Leaves out the parts that hang on nothing.
void drop_small_parts(MeshedBody& body, double share) {
  BodyMesh& elements = body.elements;
  body.parts = count_face_parts(elements.mesh);
  if (body.parts == 1 || share <= 0) return;
  std::vector<Index> all(elements.mesh.cells.size());
  std::iota(all.begin(), all.end(), 0);
  const CellSelection large{.volume_min = share * volume_of(elements.mesh)};
  const auto kept = select_cells(elements.mesh, all, large);
  std::vector<Material> materials;
  materials.reserve(kept.size());
  for (const Index c : kept) materials.push_back(elements.materials[c]);
  elements = {restrict_mesh(elements.mesh, kept).mesh, std::move(materials)};
  const std::int64_t before = body.parts;
  body.parts = count_face_parts(elements.mesh);
  body.parts_dropped = before - body.parts;
}

}  // namespace

MeshedBody make_body(std::span<const TriMesh> surfaces, const Box& box,
                     const BodyOptions& options) {
  Stopwatch watch;
  const Vec3 extent = box_of(surfaces).extent();
  const SizeRules rules = size_rules(options, std::max({extent.x, extent.y, extent.z}));
  MeshedBody body;
  body.element_size = rules.target;
  const BodySurface shape(surfaces, box, rules.tolerance);
  const GridMetricField sizes = size_field(surfaces, shape, box, rules);
  body.seconds.sizes = watch.lap();
  RemeshOptions remeshing;
  remeshing.draft = true;
  remeshing.progress = half_of(options.progress, 0);
  const TetMesh start = remesh(coarse_box_mesh(box), sizes, remeshing);
  body.seconds.start = watch.lap();
  remeshing.draft = false;
  remeshing.progress = half_of(options.progress, 0.5);
  body.elements = remesh_body(start, sizes, shape, remeshing);
  body.remeshing = body.elements.report;
  drop_small_parts(body, options.part_share);
  if (options.quadratic) body.middles = mid_nodes(body.elements, shape, box);
  body.quality = element_quality(body.elements.mesh);
  body.seconds.body = watch.lap();
  body.seconds.total = body.seconds.sizes + body.seconds.start + body.seconds.body;
  return body;
}

TriMesh body_skin(const BodyMesh& body, Material object) {
  auto is_in = [&](Index cell) {
    if (cell == kNoIndex) return false;
    return object == kOutside || body.materials[cell] == object;
  };
  const auto neighbors = cell_neighbors(body.mesh);
  std::vector<Index> number(body.mesh.points.size(), kNoIndex);
  TriMesh skin;
  for (std::size_t c = 0; c < neighbors.size(); ++c) {
    if (!is_in(static_cast<Index>(c))) continue;
    for (std::size_t f = 0; f < 4; ++f) {
      if (is_in(neighbors[c][f])) continue;
      Triangle triangle;
      for (std::size_t i = 0; i < 3; ++i) {
        triangle[i] = body.mesh.cells[c][static_cast<std::size_t>(kCellFaces[f][i])];
        number[triangle[i]] = 0;
      }
      skin.triangles.push_back(triangle);
    }
  }
  for (std::size_t p = 0; p < number.size(); ++p) {
    if (number[p] == kNoIndex) continue;
    number[p] = static_cast<Index>(skin.points.size());
    skin.points.push_back(body.mesh.points[p]);
  }
  for (Triangle& t : skin.triangles) {
    for (Index& p : t) p = number[p];
  }
  return skin;
}

}  // namespace mesamis
