// SPDX-License-Identifier: Apache-2.0
// Extraction, and following the image.
#include "mesamis/slabs/surface_tasks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "mesamis/method/deliver.h"
#include "mesamis/method/follow_image.h"
#include "mesamis/slabs/mesh_files.h"
#include "mesamis/slabs/point_numbers.h"
#include "mesamis/slabs/surface_files.h"
#include "mesamis/surface/extract.h"
#include "mesamis/surface/split_edges.h"

namespace mesamis::detail::slabs {
namespace {

/// How near to a border a task on a slab leaves the surface as it is, in overlaps.
constexpr double kBand = 0.5;
/// How far the surface is seen by the task on a border, in overlaps.
constexpr double kAround = 2;

/// Points in the order of their places: an edge that two slabs share has the same first end in
/// both, so that both cut it at the same place, to the bit.
Piece in_order_of_place(const Piece& piece) {
  const std::vector<Vec3>& points = piece.mesh.points;
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    const Vec3 &p = points[a], &q = points[b];
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
  });
  Piece sorted;
  std::vector<Index> number(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    number[order[n]] = static_cast<Index>(n);
    sorted.mesh.points.push_back(points[order[n]]);
    sorted.nodes.push_back(piece.nodes[order[n]]);
  }
  for (Cell cell : piece.mesh.cells) {
    for (Index& corner : cell) corner = number[corner];
    sorted.mesh.cells.push_back(cell);
  }
  return sorted;
}

double level_of(const SurfaceRun& run) {
  const Parameters& p = run.mesh.input.parameters;
  return p.grey.to_grey(p.level);
}

FollowOptions follow_options(const SurfaceRun& run) {
  const RunInput& input = run.mesh.input;
  const Parameters& p = input.parameters;
  return {level_of(run), input.noise, p.unit_mm, run.follows, p.fit};
}

/// The heights that a slab's own task keeps within: away from rims, which lie at its borders, and
/// from what is near these.
HeightRange range_between_rims(const SurfacePiece& piece, const SlabPlan& plan, Index s) {
  const std::vector<char> rim = rim_of(piece);
  const double width = kBand * plan.overlap;
  HeightRange range{-kInfinity, kInfinity};
  for (std::size_t p = 0; p < rim.size(); ++p) {
    if (rim[p] == 0) continue;
    const double height = piece.points[p].key.z;
    if (height < middle_of(plan, s)) {
      range.low = std::max(range.low, height + width);
    } else {
      range.high = std::min(range.high, height - width);
    }
  }
  return range;
}

/// Moves the points of a piece that are not settled.
void follow(const SurfaceRun& run, SurfacePiece& piece) {
  FollowedPart part{mesh_of(piece, &SurfacePoint::key), {}, {}};
  for (const SurfacePoint& p : piece.points) {
    part.moved.push_back(p.at);
    part.held.push_back(!p.settled ? kFree : p.at == p.key ? kHeld : kFixed);
  }
  follow_part(part, run.mesh.input.image, follow_options(run));
  piece.triangles = std::move(part.extracted.triangles);
  piece.points.resize(part.moved.size());
  for (std::size_t p = 0; p < part.moved.size(); ++p) {
    piece.points[p].key = part.extracted.points[p];
    piece.points[p].at = part.moved[p];
  }
}

/// Where a triangle of a slab goes on: to the border that a settled corner is near, else nowhere.
enum class Goes : char { kNowhere, kLow, kHigh };

std::vector<Goes> sides_of(const SurfacePiece& piece, double middle) {
  std::vector<Goes> sides;
  sides.reserve(piece.triangles.size());
  for (const Triangle& t : piece.triangles) {
    Goes side = Goes::kNowhere;
    for (const Index p : t) {
      if (!piece.points[p].settled || side == Goes::kLow) continue;
      side = piece.points[p].key.z < middle ? Goes::kLow : Goes::kHigh;
    }
    sides.push_back(side);
  }
  return sides;
}

SurfacePiece part_of(const SurfacePiece& piece, const std::vector<Goes>& sides, Goes wanted) {
  std::vector<char> chosen(sides.size());
  std::transform(sides.begin(), sides.end(), chosen.begin(),
                 [&](Goes side) { return side == wanted ? 1 : 0; });
  return select(piece, chosen);
}

HeightRange heights_of(const SurfacePiece& piece, const Triangle& t) {
  const auto [low, high] =
      std::minmax({piece.points[t[0]].key.z, piece.points[t[1]].key.z, piece.points[t[2]].key.z});
  return {low, high};
}

/// Settles the points whose triangles do not all lie between two heights.
void settle_beyond(const HeightRange& range, SurfacePiece& piece) {
  for (const Triangle& t : piece.triangles) {
    const HeightRange heights = heights_of(piece, t);
    if (range.low < heights.low && heights.high < range.high) continue;
    for (const Index p : t) piece.points[p].settled = true;
  }
}

/// The heights of the triangles that may change.
HeightRange reach_of(const SurfacePiece& piece) {
  HeightRange reach{kInfinity, -kInfinity};
  for (const Triangle& t : piece.triangles) {
    if (std::all_of(t.begin(), t.end(), [&](Index p) { return piece.points[p].settled; })) continue;
    const HeightRange heights = heights_of(piece, t);
    reach = {std::min(reach.low, heights.low), std::max(reach.high, heights.high)};
  }
  return reach;
}

/// What of a piece a border sees beside what it works on: it stays.
SurfacePiece seen_of(const SurfacePiece& piece, const HeightRange& seen) {
  std::vector<char> chosen;
  chosen.reserve(piece.triangles.size());
  for (const Triangle& t : piece.triangles) {
    const HeightRange heights = heights_of(piece, t);
    chosen.push_back(seen.low < heights.high && heights.low < seen.high);
  }
  SurfacePiece some = select(piece, chosen);
  settle_all(some);
  return some;
}

}  // namespace

Piece final_mesh(const SurfaceRun& run, Index s, SlabWork& work) {
  const Scratch& scratch = run.mesh.slabs.scratch;
  Piece piece = read_final(run.mesh, run.last, s);
  PointNumbers numbers;
  for (const Vec3& p : piece.mesh.points) (void)numbers.of(p);
  std::vector<char> known(piece.nodes.size(), 0);
  const double lowest = bounding_box(piece.mesh.points).lo.z;
  for (Index lower = 0; lower < s; ++lower) {
    if (top_of_mesh(run.mesh, run.last, lower) < lowest) continue;
    ArchiveReader archive = scratch.read(shared_nodes_file(run.last, lower));
    work.bytes += static_cast<std::int64_t>(archive.size());
    const auto points = archive.next<Vec3>();
    const auto u = archive.next<double>();
    for (std::size_t n = 0; n < points.size(); ++n) {
      const Index node = numbers.find(points[n]);
      if (node == kNoIndex || known[node] != 0) continue;
      known[node] = 1;
      piece.nodes[node].u = u[n];
    }
  }
  return in_order_of_place(piece);
}

SlabWork extract_slab(const SurfaceRun& run, Index s) {
  SlabWork work;
  const Piece own = final_mesh(run, s, work);
  TriMesh surface = extract_solid(own.mesh, values_of(own, &NodeValues::u), level_of(run),
                                  solid_options(run.mesh.input));
  FollowCounts counts;
  if (run.mesh.input.parameters.follow) {
    counts = look_along(surface, run.mesh.input.image, follow_options(run));
  }
  SurfacePiece piece;
  for (const Vec3& p : surface.points) piece.points.push_back({p, p});
  piece.triangles = std::move(surface.triangles);
  ArchiveWriter told;
  told.add_one(counts);
  run.mesh.slabs.scratch.write(surface_file("told", s), told);
  write_surface(run.mesh.slabs.scratch, surface_file("extracted", s), piece);
  return work;
}

void learn_follows(SurfaceRun& run) {
  FollowCounts sum;
  for (Index s = 0; s < run.count(); ++s) {
    const auto counts =
        run.mesh.slabs.scratch.read(surface_file("told", s)).next_one<FollowCounts>();
    sum.told += counts.told;
    sum.clear += counts.clear;
  }
  run.follows = sum.is_worthwhile();
}

SlabWork follow_slab(const SurfaceRun& run, Index s) {
  const Scratch& scratch = run.mesh.slabs.scratch;
  const SlabPlan& plan = run.mesh.plan(run.last);
  SurfacePiece piece = read_surface(scratch, surface_file("extracted", s));
  settle_beyond(range_between_rims(piece, plan, s), piece);
  follow(run, piece);
  const std::vector<Goes> sides = sides_of(piece, middle_of(plan, s));
  for (SurfacePoint& p : piece.points) p.settled = !p.settled;  // those that were left are next
  write_surface(scratch, surface_file("core", s), part_of(piece, sides, Goes::kNowhere));
  write_surface(scratch, surface_file("low", s), part_of(piece, sides, Goes::kLow));
  write_surface(scratch, surface_file("high", s), part_of(piece, sides, Goes::kHigh));
  return {};
}

SlabWork follow_border(const SurfaceRun& run, Index s) {
  const Scratch& scratch = run.mesh.slabs.scratch;
  const SlabPlan& plan = run.mesh.plan(run.last);
  SlabWork work;
  std::vector<SurfacePiece> all{join({read_surface(scratch, surface_file("high", s)),
                                      read_surface(scratch, surface_file("low", s + 1), &work)})};
  SurfacePiece& near = all[0];
  settle_rim(near);
  // The tasks on the borders below and above keep to the other sides of the slabs' middles, with
  // more than a move between.
  const double apart =
      std::max(plan.whole.voxel_size() / plan.unit_mm, most_followed(plan.whole, plan.unit_mm));
  settle_beyond({middle_of(plan, s) + apart, middle_of(plan, s + 1) - apart}, near);
  const HeightRange reach = reach_of(near);
  const HeightRange seen{reach.low - kAround * plan.overlap, reach.high + kAround * plan.overlap};
  const std::size_t own = near.triangles.size();
  for (const Index t : {s, s + 1}) {
    SlabWork* const of_others = t == s ? nullptr : &work;
    for (const char* what : {"core", t == s ? "low" : "high"}) {
      all.push_back(seen_of(read_surface(scratch, surface_file(what, t), of_others), seen));
    }
  }
  SurfacePiece whole = join(all);
  const std::size_t others = whole.triangles.size() - own;
  follow(run, whole);
  whole.triangles.resize(whole.triangles.size() - others);  // they were not cut, and come last
  write_surface(scratch, surface_file("border", s),
                select(whole, std::vector<char>(whole.triangles.size(), 1)));
  return work;
}

SurfacePiece surface_of(const SurfaceRun& run, Index s, SlabWork* work) {
  const Scratch& scratch = run.mesh.slabs.scratch;
  std::vector<SurfacePiece> pieces{read_surface(scratch, surface_file("core", s), work)};
  if (s + 1 < run.count()) {
    pieces.push_back(read_surface(scratch, surface_file("border", s), work));
  }
  return join(pieces);
}

TriMesh followed_surface(const SurfaceRun& run) {
  std::vector<SurfacePiece> pieces;
  pieces.reserve(static_cast<std::size_t>(run.count()));
  for (Index s = 0; s < run.count(); ++s) pieces.push_back(surface_of(run, s));
  return in_world(run, join(pieces));
}

}  // namespace mesamis::detail::slabs
