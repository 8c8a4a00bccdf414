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
#include "mesamis/body/missed_places.h"
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
/// @param parts  of each cell its part.
void drop_small_parts(MeshedBody& body, const std::vector<Index>& parts, double share) {
  BodyMesh& elements = body.elements;
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

/// Progress of work of unknown length at the end.
Progress end_of(const Progress& whole) {
  if (!whole) return {};
  return [whole](std::string_view stage, double) { return whole(stage, 1); };
}

/// The greatest distance between skin and surfaces, either way.
double distance_of(const MeshedBody& body) {
  return std::max(body.fit.skin_to_surface, body.fit.surface_to_skin);
}

/// Makes a body, and again with smaller elements where it misses its surfaces: tips and pits that
/// lie between the edges of the start are lost when it is cut.
class BodyMaker {
 public:
  BodyMaker(std::span<const TriMesh> surfaces, const Box& box, const BodyOptions& options)
      : surfaces_(surfaces),
        box_(box),
        options_(options),
        rules_(size_rules(options, longest_side(surfaces))),
        shape_(surfaces, box, rules_.tolerance),
        sizes_(size_field(surfaces, shape_, box, rules_)),
        start_(coarse_box_mesh(box)) {
    require_elements_fit(sizes_, box, options, rules_.target);
    seconds_.sizes = watch_.lap();
  }

  MeshedBody make() {
    constexpr int kMostTimes = 4;
    const double most = most_cells();
    MeshedBody best = make_once(half_of(options_.progress, 0), half_of(options_.progress, 0.5));
    std::vector<WantedSize> wanted = wanted_sizes(best);
    for (int time = 2; !wanted.empty(); ++time) {
      sizes_ = refined(sizes_, box_, wanted, rules_);
      for (const WantedSize& place : wanted) least_ = std::min(least_, place.size);
      seconds_.sizes += watch_.lap();
      if (cells_for_metric(sizes_, box_) > most) break;
      MeshedBody next = make_once(end_of(options_.progress), end_of(options_.progress));
      wanted = time < kMostTimes ? wanted_sizes(next) : std::vector<WantedSize>{};
      if (distance_of(next) < distance_of(best)) best = std::move(next);
    }
    if (!options_.skins) best.skins.clear();
    best.narrow_share = narrow_share(surfaces_, shape_, best.least_size);
    seconds_.fit += watch_.lap();
    seconds_.total = seconds_.sizes + seconds_.start + seconds_.body + seconds_.fit;
    best.seconds = seconds_;
    return best;
  }

 private:
  static double longest_side(std::span<const TriMesh> surfaces) {
    const Vec3 extent = bounding_box(surfaces).extent();
    return std::max({extent.x, extent.y, extent.z});
  }

  /// Of which a mesh that is made again may consist: small ones may grow more.
  double most_cells() const {
    constexpr double kMostGrowth = 3, kFew = 200'000;
    return std::min(std::max(kMostGrowth * cells_for_metric(sizes_, box_), kFew),
                    static_cast<double>(options_.most_elements));
  }

  /// @return with the skins of all parts, if they are delivered or parts may have been dropped.
  MeshedBody make_once(const Progress& of_start, const Progress& of_body) {
    RemeshOptions remeshing;
    remeshing.draft = true;
    remeshing.progress = of_start;
    start_ = remesh::remesh(start_, sizes_, remeshing);
    seconds_.start += watch_.lap();
    remeshing.draft = false;
    remeshing.balanced = !options_.quadratic;  // whose mid-side nodes follow the surface
    remeshing.progress = of_body;
    MeshedBody body;
    body.element_size = rules_.target;
    body.least_size = least_;
    body.elements = remesh_body(start_, sizes_, shape_, remeshing);
    const std::vector<Index> parts = face_parts(body.elements.mesh);
    body.parts = *std::ranges::max_element(parts) + 1;
    if (options_.skins || body.parts > 1) {
      body.skins = body_skins(body.elements, surfaces_.size());
    }
    drop_small_parts(body, parts, options_.part_share);
    if (options_.quadratic) body.middles = mid_nodes(body.elements, shape_, box_);
    body.quality = element_quality(body.elements.mesh);
    seconds_.body += watch_.lap();
    body.fit = measure_fit(body.elements, surfaces_, options_.tolerance);
    seconds_.fit += watch_.lap();
    return body;
  }

  /// Half the sizes that there are, where skins and surfaces are too far apart; none where that
  /// would be below the least size that is allowed.
  std::vector<WantedSize> wanted_sizes(const MeshedBody& body) const {
    constexpr double kSmaller = 0.5;
    std::vector<WantedSize> wanted;
    if (distance_of(body) <= options_.tolerance) return wanted;
    const bool anew = body.skins.empty() || has_broken(body);
    const auto skins = anew ? body_skins(body.elements, surfaces_.size()) : body.skins;
    Index hint = 0;
    for (std::size_t k = 0; k < surfaces_.size(); ++k) {
      if (skins[k].triangles.empty()) continue;
      for (const bool from_skin : {false, true}) {
        const TriMesh& from = from_skin ? skins[k] : surfaces_[k];
        const TriMesh& to = from_skin ? surfaces_[k] : skins[k];
        for (const Vec3& p : missed_places(from, to, options_.tolerance)) {
          const double size = kSmaller * size_at(sizes_, p, hint);
          if (size >= least_allowed()) wanted.push_back({p, size});
        }
      }
    }
    return wanted;
  }

  /// Whether a part was dropped that the surfaces hold by a neck, which was lost.
  bool has_broken(const MeshedBody& body) const {
    if (body.parts_dropped == 0) return false;
    std::int64_t pieces = 0;
    for (const TriMesh& surface : surfaces_) pieces += check_surface(surface).components;
    return body.parts + body.parts_dropped > pieces;
  }

  /// That of the options is kept.
  double least_allowed() const {
    constexpr double kShare = 0.1;
    return options_.least_size > 0 ? rules_.least : kShare * rules_.least;
  }

  std::span<const TriMesh> surfaces_;
  const Box& box_;
  const BodyOptions& options_;
  Stopwatch watch_;
  MeshedBody::Seconds seconds_;
  SizeRules rules_;
  double least_ = rules_.least;  ///< size asked for
  BodySurface shape_;
  GridMetricField sizes_;
  TetMesh start_;
};

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
  return BodyMaker(surfaces, box, options).make();
}

}  // namespace mesamis::detail::body
