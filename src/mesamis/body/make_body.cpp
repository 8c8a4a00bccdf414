// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/make_body.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/base/written_number.h"
#include "mesamis/body/body_surface.h"
#include "mesamis/body/size_field.h"
#include "mesamis/mesh/region.h"
#include "mesamis/surface/measure.h"

namespace mesamis::detail::body {
namespace {

/// What the operations are held to, as a share of the tolerance: they look at four points of a
/// triangle, and others lie further away. The volume, too, errs by half as much.
constexpr double kAimed = 0.5;

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

/// The cells of the parts that are kept: of one object at least they hold more than a share of its
/// elements' volume.
std::vector<Index> cells_kept(const BodyMesh& body, const std::vector<Index>& parts, double share) {
  std::map<Material, double> whole;
  std::map<std::pair<Index, Material>, double> pieces;  // of a part and an object
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const double volume = cell_volume(body.mesh, static_cast<Index>(c));
    whole[body.materials[c]] += volume;
    pieces[{parts[c], body.materials[c]}] += volume;
  }
  std::set<Index> kept;
  for (const auto& [of, volume] : pieces) {
    if (volume >= share * whole[of.second]) kept.insert(of.first);
  }
  std::vector<Index> cells;
  for (std::size_t c = 0; c < parts.size(); ++c) {
    if (kept.contains(parts[c])) cells.push_back(static_cast<Index>(c));
  }
  return cells;
}

/// Leaves out the parts that hang on nothing.
void drop_small_parts(MeshedBody& body, double share) {
  BodyMesh& elements = body.elements;
  const std::vector<Index> parts = face_parts(elements.mesh);
  body.parts = *std::ranges::max_element(parts) + 1;
  if (body.parts == 1 || share <= 0) return;
  const std::vector<Index> kept = cells_kept(elements, parts, share);
  std::vector<Material> materials;
  materials.reserve(kept.size());
  for (const Index c : kept) materials.push_back(elements.materials[c]);
  elements.mesh = restrict_mesh(elements.mesh, kept).mesh;
  elements.materials = std::move(materials);
  const std::int64_t before = body.parts;
  body.parts = count_face_parts(elements.mesh);
  body.parts_dropped = before - body.parts;
}

/// Of the surfaces' area, where a wall or a gap is narrower than a width.
double narrow_share(std::span<const TriMesh> surfaces, const BodySurface& shape, double width) {
  double narrow = 0, whole = 0;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const auto object = static_cast<Material>(k + 1);
    const auto &thickness = shape.thickness(object), &gap = shape.gap(object);
    for (std::size_t t = 0; t < surfaces[k].triangles.size(); ++t) {
      const double area = triangle_area(surfaces[k], t);
      whole += area;
      const bool is_narrow = std::ranges::any_of(surfaces[k].triangles[t], [&](Index p) {
        return std::min(thickness[p], gap[p]) < width;
      });
      if (is_narrow) narrow += area;
    }
  }
  return narrow / whole;
}

/// Refuses sizes that ask for more elements than may be made, before they are.
void require_elements_fit(const MetricField& sizes, const Box& box, const BodyOptions& options,
                          double size) {
  const double asked = cells_for_metric(sizes, box);
  const auto most = static_cast<double>(options.most_elements);
  if (asked <= most) return;
  throw InputError("body: elements of " + rounded_text(size) + " mm would be about " +
                   rounded_text(asked) + ", of which " + std::to_string(options.most_elements) +
                   " may be made; expected an element size of at least " +
                   number_text(std::ceil(100 * size * std::cbrt(asked / most)) / 100) + " mm");
}

}  // namespace

Box bounding_box(std::span<const TriMesh> surfaces) {
  std::vector<Vec3> corners;
  for (const TriMesh& surface : surfaces) {
    const Box box = bounding_box(surface.points);
    corners.insert(corners.end(), {box.lo, box.hi});
  }
  return bounding_box(corners);
}

MeshedBody make_body(std::span<const TriMesh> surfaces, const Box& box,
                     const BodyOptions& options) {
  Stopwatch watch;
  const Vec3 extent = bounding_box(surfaces).extent();
  const SizeRules rules = size_rules(options, std::max({extent.x, extent.y, extent.z}));
  MeshedBody body;
  body.element_size = rules.target;
  const BodySurface shape(surfaces, box, rules.tolerance);
  body.least_size = rules.least;
  body.narrow_share = narrow_share(surfaces, shape, rules.least);
  const GridMetricField sizes = size_field(surfaces, shape, box, rules);
  require_elements_fit(sizes, box, options, rules.target);
  body.seconds.sizes = watch.lap();
  RemeshOptions remeshing;
  remeshing.draft = true;
  remeshing.progress = half_of(options.progress, 0);
  const TetMesh start = remesh::remesh(coarse_box_mesh(box), sizes, remeshing);
  body.seconds.start = watch.lap();
  remeshing.draft = false;
  remeshing.balanced = !options.quadratic;  // whose mid-side nodes follow the surface
  remeshing.progress = half_of(options.progress, 0.5);
  body.elements = remesh_body(start, sizes, shape, remeshing);
  if (options.skins) body.skins = body_skins(body.elements, surfaces.size());
  drop_small_parts(body, options.part_share);
  if (options.quadratic) body.middles = mid_nodes(body.elements, shape, box);
  body.quality = element_quality(body.elements.mesh);
  body.seconds.body = watch.lap();
  body.fit = measure_fit(body.elements, surfaces, options.tolerance);
  body.seconds.fit = watch.lap();
  body.seconds.total =
      body.seconds.sizes + body.seconds.start + body.seconds.body + body.seconds.fit;
  return body;
}

}  // namespace mesamis::detail::body
