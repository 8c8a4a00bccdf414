// SPDX-License-Identifier: Apache-2.0
// The parts of the surface, over all slabs: which there are, and which stay.
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/base/single_precision.h"
#include "mesamis/method/expected_error.h"
#include "mesamis/slabs/point_numbers.h"
#include "mesamis/slabs/surface_files.h"
#include "mesamis/surface/disjoint_sets.h"
#include "mesamis/surface/measure.h"

namespace mesamis::detail::slabs {
namespace {

/// What is known of a slab's surface as a whole.
struct SurfaceFacts {
  HeightRange core, border;    ///< of its points
  double error = 0, area = 0;  ///< the mean expected error, mm, and over what area, mm^2
  double shift = 0;            ///< as SurfaceParts
};

HeightRange heights_of(const SurfacePiece& piece) {
  HeightRange range{kInfinity, -kInfinity};
  for (const SurfacePoint& p : piece.points) {
    range = {std::min(range.low, p.at.z), std::max(range.high, p.at.z)};
  }
  return range;
}

/// Volumes of open surfaces add up where all cones have one apex.
void measure_from(const Vec3& apex, const TriMesh& surface, SurfaceComponents& components) {
  for (SurfaceComponents::Size& size : components.sizes) size.volume = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Index c = components.of_triangle[t];
    if (c != kNoIndex) components.sizes[c].volume += cone_volume(surface, t, apex);
  }
}

/// What list_parts() leaves of a slab.
struct PartList {
  SurfaceFacts facts;
  std::vector<SurfaceComponents::Size> sizes;
  std::vector<Vec3> feet;
  std::vector<Vec3> rim;      ///< keys of the points that other slabs may have too
  std::vector<Index> of_rim;  ///< the component of each
};

PartList read_parts(const SurfaceRun& run, Index s) {
  ArchiveReader archive = run.mesh.slabs.scratch.read(surface_file("parts", s));
  PartList list;
  list.facts = archive.next_one<SurfaceFacts>();
  list.sizes = archive.next<SurfaceComponents::Size>();
  list.feet = archive.next<Vec3>();
  list.rim = archive.next<Vec3>();
  list.of_rim = archive.next<Index>();
  return list;
}

SurfaceComponents::Size operator+(const SurfaceComponents::Size& a,
                                  const SurfaceComponents::Size& b) {
  return {a.triangles + b.triangles, a.volume + b.volume, a.area + b.area};
}

/// The components of the slabs, joined where they have points in common.
/// @return the set of each, numbered through all slabs.
DisjointSets::Numbers joined_components(const std::vector<PartList>& lists) {
  std::size_t count = 0;
  for (const PartList& list : lists) count += list.sizes.size();
  DisjointSets sets(count);
  PointNumbers numbers;
  std::vector<std::size_t> owner;  // of each point the first component
  std::size_t first = 0;
  for (const PartList& list : lists) {
    for (std::size_t n = 0; n < list.rim.size(); ++n) {
      const std::size_t component = first + static_cast<std::size_t>(list.of_rim[n]);
      const auto [number, is_new] = numbers.of(list.rim[n]);
      if (is_new) owner.push_back(component);
      sets.unite(owner[number], component);
    }
    first += list.sizes.size();
  }
  return sets.numbers();
}

/// The parts of the whole surface, the largest first.
void join_parts(const std::vector<PartList>& lists, SurfaceParts& parts) {
  const DisjointSets::Numbers joined = joined_components(lists);
  std::vector<SurfaceComponents::Size> sizes(static_cast<std::size_t>(joined.count));
  std::vector<Vec3> feet(sizes.size());
  std::size_t n = joined.of_item.size();
  for (auto list = lists.rbegin(); list != lists.rend(); ++list) {
    for (std::size_t c = list->sizes.size(); c-- > 0;) {
      const Index part = joined.of_item[--n];
      sizes[part] = sizes[part] + list->sizes[c];
      feet[part] = list->feet[c];  // in the end that of the first
    }
  }
  const std::vector<Index> order = largest_first(sizes);
  std::vector<Index> place(sizes.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = static_cast<Index>(i);
    parts.sizes.push_back(sizes[order[i]]);
    parts.feet.push_back(feet[order[i]]);
  }
  auto part = joined.of_item.begin();
  for (const PartList& list : lists) {
    std::vector<Index>& of_slab = parts.of_slab.emplace_back();
    for (std::size_t c = 0; c < list.sizes.size(); ++c) of_slab.push_back(place[*part++]);
  }
}

/// The part of the whole that each triangle of slab s belongs to; kNoIndex: none.
std::vector<Index> parts_of(const SurfaceRun& run, Index s) {
  auto parts = run.mesh.slabs.scratch.read(surface_file("components", s)).next<Index>();
  const std::vector<Index>& of_slab = run.parts.of_slab[static_cast<std::size_t>(s)];
  for (Index& part : parts) part = part == kNoIndex ? kNoIndex : of_slab[part];
  return parts;
}

/// How often a ray crosses a part.
struct Crossing {
  Index ray, part;
  int count;
};

}  // namespace

SlabWork list_parts(const SurfaceRun& run, Index s) {
  const Scratch& scratch = run.mesh.slabs.scratch;
  const RunInput& input = run.mesh.input;
  PartList list;
  list.facts.core = heights_of(read_surface(scratch, surface_file("core", s)));
  list.facts.border = {kInfinity, -kInfinity};
  if (s + 1 < run.count()) {
    list.facts.border = heights_of(read_surface(scratch, surface_file("border", s)));
  }
  const SurfacePiece piece = surface_of(run, s);
  const TriMesh surface = in_world(run, piece);
  const ErrorSummary error = expected_shape_error(input, surface);
  list.facts.error = error.mean;
  list.facts.area = error.area;
  for (const Vec3& p : surface.points) {
    list.facts.shift = std::max(list.facts.shift, norm(base::rounded(p) - p));
  }
  SurfaceComponents components = find_components(surface);
  const VoxelGrid& grid = run.mesh.slabs.plan.whole;
  measure_from(grid.to_world(0.5 * grid.box().extent()), surface, components);
  const std::vector<char> rim = rim_of(piece);
  std::vector<char> listed(rim.size(), 0);
  for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
    for (const Index p : piece.triangles[t]) {
      if (rim[p] == 0 || listed[p] != 0) continue;
      listed[p] = 1;
      list.rim.push_back(piece.points[p].key);
      list.of_rim.push_back(components.of_triangle[t]);
    }
  }
  ArchiveWriter archive;
  archive.add_one(list.facts);
  archive.add(components.sizes);
  archive.add(component_feet(surface, components));
  archive.add(list.rim);
  archive.add(list.of_rim);
  scratch.write(surface_file("parts", s), archive);
  ArchiveWriter of_triangles;
  of_triangles.add(components.of_triangle);
  scratch.write(surface_file("components", s), of_triangles);
  return {};
}

void learn_parts(SurfaceRun& run) {
  std::vector<PartList> lists;
  double error = 0, area = 0;
  run.parts = {};
  for (Index s = 0; s < run.count(); ++s) {
    const SurfaceFacts& facts = lists.emplace_back(read_parts(run, s)).facts;
    run.parts.core.push_back(facts.core);
    run.parts.border.push_back(facts.border);
    run.parts.shift = std::max(run.parts.shift, facts.shift);
    error += facts.error * facts.area;
    area += facts.area;
  }
  run.parts.mean_error = area > 0 ? error / area : 0;
  join_parts(lists, run.parts);
}

SlabWork cross_rays(const SurfaceRun& run, Index s) {
  const RayCrossings crossings =
      ray_crossings(run.parts.feet, in_world(run, surface_of(run, s)), parts_of(run, s));
  std::vector<Crossing> list;
  for (std::size_t ray = 0; ray < crossings.size(); ++ray) {
    for (const auto& [part, count] : crossings[ray]) {
      list.push_back({static_cast<Index>(ray), part, count});
    }
  }
  ArchiveWriter archive;
  archive.add(list);
  run.mesh.slabs.scratch.write(surface_file("crossings", s), archive);
  return {};
}

void learn_choice(SurfaceRun& run, const PartSelection& selection) {
  RayCrossings crossings(run.parts.feet.size());
  for (Index s = 0; s < run.count(); ++s) {
    ArchiveReader archive = run.mesh.slabs.scratch.read(surface_file("crossings", s));
    for (const Crossing& crossing : archive.next<Crossing>()) {
      crossings[crossing.ray][crossing.part] += crossing.count;
    }
  }
  run.choice = choose_parts(run.parts.sizes, nesting_of(std::move(crossings)), selection);
}

TriMesh in_world(const SurfaceRun& run, const SurfacePiece& piece) {
  TriMesh mesh = mesh_of(piece, &SurfacePoint::at);
  bring_to_world(run.mesh.input, mesh.points);
  return mesh;
}

SurfacePiece chosen_surface_of(const SurfaceRun& run, Index s, SlabWork* work) {
  std::vector<char> stays;
  for (const Index part : parts_of(run, s)) {
    stays.push_back(part != kNoIndex && run.choice.goes[part] == 0);
  }
  return select(surface_of(run, s, work), stays);
}

}  // namespace mesamis::detail::slabs
