// SPDX-License-Identifier: Apache-2.0
// Decimation, and how far it moved the surface.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "mesamis/base/single_precision.h"
#include "mesamis/decimate/decimate_part.h"
#include "mesamis/decimate/patch.h"
#include "mesamis/slabs/surface_files.h"
#include "mesamis/surface/distance.h"

namespace mesamis::detail::slabs {
namespace {

/// Rings of points around those that a slab's own task has held: the border's task may remove them.
constexpr int kRings = 4;

/// A part of a slab's surface on its way, and what it stands for.
struct CoverPiece {
  SurfacePiece piece;                                ///< decimated
  SurfacePiece originals;                            ///< as extracted
  std::vector<std::vector<Index>> stands_for;        ///< as Cover::originals
  std::vector<double> to_originals, from_originals;  ///< as Cover's
};

void write_cover(const Scratch& scratch, const std::string& name, const CoverPiece& cover) {
  std::vector<Index> counts, all;
  for (const std::vector<Index>& originals : cover.stands_for) {
    counts.push_back(static_cast<Index>(originals.size()));
    all.insert(all.end(), originals.begin(), originals.end());
  }
  ArchiveWriter archive;
  add_surface(archive, cover.piece);
  add_surface(archive, cover.originals);
  archive.add(counts);
  archive.add(all);
  archive.add(cover.to_originals);
  archive.add(cover.from_originals);
  scratch.write(name, archive);
}

CoverPiece read_cover(const Scratch& scratch, const std::string& name, SlabWork* work) {
  ArchiveReader archive = scratch.read(name);
  if (work != nullptr) work->bytes += static_cast<std::int64_t>(archive.size());
  CoverPiece cover;
  cover.piece = next_surface(archive);
  cover.originals = next_surface(archive);
  const auto counts = archive.next<Index>();
  const auto all = archive.next<Index>();
  auto next = all.begin();
  for (const Index count : counts) {
    cover.stands_for.emplace_back(next, next + count);
    next += count;
  }
  cover.to_originals = archive.next<double>();
  cover.from_originals = archive.next<double>();
  return cover;
}

DecimateOptions decimate_options(const SurfaceRun& run) {
  DecimateOptions options;
  options.tolerance = *run.parameters.tolerance - run.parts.shift;
  return options;
}

/// Above what lies below a slab's surface, and below what lies above it, as rounded as it may be.
HeightRange free_range(const SurfaceRun& run, Index s) {
  HeightRange range{-kInfinity, kInfinity};
  for (Index t = 0; t < run.count(); ++t) {
    for (const auto* ranges : {&run.parts.core, &run.parts.border}) {
      const HeightRange& other = (*ranges)[static_cast<std::size_t>(t)];
      if (t < s) range.low = std::max(range.low, other.high);
      if (t > s) range.high = std::min(range.high, other.low);
    }
  }
  const double spare = 2 * run.parts.shift / run.mesh.input.parameters.unit_mm;
  return {range.low + spare, range.high - spare};
}

bool lies_in(const SurfacePiece& piece, const Triangle& t, const HeightRange& range) {
  return std::all_of(t.begin(), t.end(), [&](Index p) {
    return range.low < piece.points[p].at.z && piece.points[p].at.z < range.high;
  });
}

/// Of each triangle of a cover 1 if it, and what it stands for, lie strictly between two heights.
/// @param now  the cover, as a piece.
std::vector<char> triangles_in(const SurfacePiece& original, const SurfacePiece& now,
                               const Cover& cover, const HeightRange& range) {
  std::vector<char> lies;  // of each original
  lies.reserve(original.triangles.size());
  for (const Triangle& t : original.triangles) lies.push_back(lies_in(original, t, range) ? 1 : 0);
  std::vector<char> in;
  in.reserve(cover.triangles.size());
  for (std::size_t t = 0; t < cover.triangles.size(); ++t) {
    const auto& originals = cover.originals[t];
    in.push_back(
        lies_in(now, cover.triangles[t], range) &&
        std::all_of(originals.begin(), originals.end(), [&](Index o) { return lies[o] != 0; }));
  }
  return in;
}

/// Of each point 1 if all its triangles are chosen.
std::vector<char> points_within(std::size_t points, const Cover& cover,
                                const std::vector<char>& chosen) {
  std::vector<char> within(points, 1);
  for (std::size_t t = 0; t < cover.triangles.size(); ++t) {
    if (chosen[t] != 0) continue;
    for (const Index p : cover.triangles[t]) within[p] = 0;
  }
  return within;
}

/// Of each point 1 if the slab's own task leaves it to those on the borders.
std::vector<char> held_by_slab(const SurfacePiece& piece, const HeightRange& free) {
  std::vector<char> held(piece.points.size(), 0);
  for (const Triangle& t : piece.triangles) {
    if (lies_in(piece, t, free)) continue;
    for (const Index p : t) held[p] = 1;
  }
  return held;
}

/// The heights that the tasks on the borders of a slab may work at: none where nothing lies beyond.
struct Sides {
  HeightRange low{kInfinity, -kInfinity}, high{kInfinity, -kInfinity};
};

/// @param free  of free_range().
Sides sides_of(const HeightRange& free) {
  if (free.low > free.high) return {};
  const bool below = std::isfinite(free.low), above = std::isfinite(free.high);
  const double middle = (free.low + free.high) / 2;
  Sides sides;
  if (below) sides.low = {-kInfinity, above ? middle : kInfinity};
  if (above) sides.high = {below ? middle : -kInfinity, kInfinity};
  return sides;
}

/// Of each triangle 1 if any corner is chosen.
std::vector<char> triangles_at(const std::vector<Triangle>& triangles,
                               const std::vector<char>& chosen) {
  std::vector<char> at;
  at.reserve(triangles.size());
  for (const Triangle& t : triangles) at.push_back(chosen[t[0]] | chosen[t[1]] | chosen[t[2]]);
  return at;
}

/// A slab's surface, and what is left of it.
struct Decimated {
  const SurfacePiece& original;
  const Cover& cover;
  const SurfacePiece& now;  ///< the cover, as a piece
};

/// The points of a piece where they have moved to in the world.
/// @param before, now  mm.
std::vector<SurfacePoint> moved(const SurfaceRun& run, std::vector<SurfacePoint> points,
                                const std::vector<Vec3>& before, const std::vector<Vec3>& now) {
  const RunInput& input = run.mesh.input;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (before[p] == now[p]) continue;
    points[p].at = (1 / input.parameters.unit_mm) * input.grey.to_grid(now[p]);
  }
  return points;
}

/// What of a slab's cover goes to the task on one border.
struct BorderShare {
  std::vector<char> open;       ///< of each point 1 if it may be removed
  std::vector<char> triangles;  ///< 1 for those at such points, and for a ring around them
};

/// Open are the points that the slab's own task has held, and some around them, on the border's
/// side of the slab's middle.
BorderShare share_of(const Decimated& slab, const std::vector<char>& held,
                     const HeightRange& side) {
  const Cover& cover = slab.cover;
  const std::size_t points = slab.now.points.size();
  const std::vector<char> in = triangles_in(slab.original, slab.now, cover, side);
  const std::vector<char> within = points_within(points, cover, in);
  std::vector<char> open(points, 0);
  for (std::size_t p = 0; p < points; ++p) {
    open[p] =
        held[p] != 0 && side.low < slab.now.points[p].at.z && slab.now.points[p].at.z < side.high;
  }
  choose_rings(cover.triangles, kRings, open);
  for (std::size_t p = 0; p < points; ++p) open[p] &= within[p];
  std::vector<char> ring = open;
  choose_rings(cover.triangles, 1, ring);
  std::vector<char> triangles = triangles_at(cover.triangles, ring);
  for (std::size_t t = 0; t < triangles.size(); ++t) triangles[t] &= in[t];
  return {std::move(open), std::move(triangles)};
}

/// Numbers points and triangles of a whole as they are needed.
class Numbering {
 public:
  explicit Numbering(std::size_t count) : number_(count, kNoIndex) {}
  Index of(Index item) {
    if (number_[item] == kNoIndex) {
      number_[item] = static_cast<Index>(items_.size());
      items_.push_back(item);
    }
    return number_[item];
  }
  const std::vector<Index>& items() const { return items_; }

 private:
  std::vector<Index> number_;
  std::vector<Index> items_;  // in the order of their numbers
};

/// Some triangles of a slab's cover, with what they stand for.
CoverPiece part_of(const Decimated& slab, const BorderShare& share) {
  const Cover& cover = slab.cover;
  CoverPiece part;
  Numbering points(slab.now.points.size()), original_points(slab.now.points.size()),
      originals(slab.original.triangles.size());
  const auto over = [](Numbering& numbers, Triangle t) {
    for (Index& p : t) p = numbers.of(p);
    return t;
  };
  for (std::size_t t = 0; t < cover.triangles.size(); ++t) {
    if (share.triangles[t] == 0) continue;
    part.piece.triangles.push_back(over(points, cover.triangles[t]));
    part.to_originals.push_back(cover.to_originals[t]);
    part.from_originals.push_back(cover.from_originals[t]);
    std::vector<Index>& list = part.stands_for.emplace_back();
    for (const Index original : cover.originals[t]) list.push_back(originals.of(original));
    std::sort(list.begin(), list.end());
  }
  for (const Index t : originals.items()) {
    part.originals.triangles.push_back(over(original_points, slab.original.triangles[t]));
  }
  for (const Index p : original_points.items()) {
    part.originals.points.push_back(slab.original.points[p]);
  }
  for (const Index p : points.items()) {
    part.piece.points.push_back(slab.now.points[p]);
    part.piece.points.back().settled = share.open[p] == 0;
  }
  return part;
}

/// Joins what the slabs below and above a border have left for it.
CoverPiece join(const CoverPiece& below, const CoverPiece& above) {
  CoverPiece both{mesamis::join({below.piece, above.piece}),
                  mesamis::join({below.originals, above.originals}),
                  {},
                  {},
                  {}};
  for (const CoverPiece* part : {&below, &above}) {
    const Index first = part == &below ? 0 : static_cast<Index>(below.originals.triangles.size());
    for (std::vector<Index> list : part->stands_for) {
      for (Index& original : list) original += first;
      both.stands_for.push_back(std::move(list));
    }
    both.to_originals.insert(both.to_originals.end(), part->to_originals.begin(),
                             part->to_originals.end());
    both.from_originals.insert(both.from_originals.end(), part->from_originals.begin(),
                               part->from_originals.end());
  }
  return both;
}

std::vector<char> settled_points(const SurfacePiece& piece) {
  std::vector<char> settled;
  settled.reserve(piece.points.size());
  for (const SurfacePoint& p : piece.points) settled.push_back(p.settled ? 1 : 0);
  return settled;
}

/// Triangles of few corners in common: known by these, in any order.
class KnownTriangles {
 public:
  explicit KnownTriangles(std::span<const Triangle> triangles) {
    for (const Triangle& t : triangles) known_.push_back(sorted(t));
    std::sort(known_.begin(), known_.end());
  }
  bool has(const Triangle& t) const {
    return std::binary_search(known_.begin(), known_.end(), sorted(t));
  }

 private:
  static Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  }
  std::vector<Triangle> known_;
};

/// What measure_slab() leaves.
struct Measured {
  std::int64_t triangles = 0;  ///< before decimation, of the parts that stay
  double original_to_result = 0, result_to_original = 0;
};

Measured read_measured(const SurfaceRun& run, Index s) {
  return run.mesh.slabs.scratch.read(surface_file("measured", s)).next_one<Measured>();
}

}  // namespace

SlabWork decimate_slab(const SurfaceRun& run, Index s) {
  const Scratch& scratch = run.mesh.slabs.scratch;
  const SurfacePiece piece = chosen_surface_of(run, s);
  const HeightRange free = free_range(run, s);
  const TriMesh surface = rounded_in_world(run, piece);
  std::vector<char> held = held_by_slab(piece, free);
  const Cover cover = decimate_part(surface, cover_of(surface), held, decimate_options(run));
  const SurfacePiece now{moved(run, piece.points, surface.points, cover.points), cover.triangles};
  const Decimated slab{piece, cover, now};
  const Sides sides = sides_of(free);
  std::vector<char> stays(cover.triangles.size(), 1);
  for (const auto& [name, side] : {std::pair{"cover low", sides.low}, {"cover high", sides.high}}) {
    const BorderShare share = share_of(slab, held, side);
    write_cover(scratch, surface_file(name, s), part_of(slab, share));
    for (std::size_t t = 0; t < stays.size(); ++t) {
      if (share.triangles[t] != 0) stays[t] = 0;
    }
  }
  SurfacePiece own = select(now, stays);
  settle_all(own);
  write_surface(scratch, surface_file("decimated", s), own);
  return {};
}

SlabWork decimate_border(const SurfaceRun& run, Index s) {
  const Scratch& scratch = run.mesh.slabs.scratch;
  SlabWork work;
  CoverPiece near = join(read_cover(scratch, surface_file("cover high", s), nullptr),
                         read_cover(scratch, surface_file("cover low", s + 1), &work));
  settle_rim(near.piece);
  // What is around stays, and keeps what changes from running into it.
  SurfacePiece all = join({near.piece, read_surface(scratch, surface_file("decimated", s)),
                           read_surface(scratch, surface_file("decimated", s + 1), &work)});
  const TriMesh surface = rounded_in_world(run, all);
  Cover cover{surface.points, surface.triangles, std::move(near.stands_for),
              std::move(near.to_originals), std::move(near.from_originals)};
  cover.originals.resize(cover.triangles.size());
  cover.to_originals.resize(cover.triangles.size(), 0);
  cover.from_originals.resize(cover.triangles.size(), 0);
  cover = decimate_part(rounded_in_world(run, near.originals), std::move(cover),
                        settled_points(all), decimate_options(run));
  const KnownTriangles around(std::span(all.triangles).subspan(near.piece.triangles.size()));
  std::vector<char> chosen;
  for (const Triangle& t : cover.triangles) chosen.push_back(around.has(t) ? 0 : 1);
  write_surface(
      scratch, surface_file("decimated border", s),
      select({moved(run, all.points, surface.points, cover.points), cover.triangles}, chosen));
  return work;
}

SlabWork measure_slab(const SurfaceRun& run, Index s) {
  SlabWork work;
  Measured measured;
  std::vector<SurfacePiece> originals{chosen_surface_of(run, s)};
  std::vector<SurfacePiece> delivered = decimated_by(run, s);
  measured.triangles = std::ssize(originals[0].triangles);
  const auto distance = [&](const TriMesh& from, const TriMesh& to) {
    if (from.triangles.empty()) return 0.0;
    return max_distance(from, to, fine_enough(from, *run.parameters.tolerance));
  };
  const TriMesh own = rounded_in_world(run, join(delivered));
  // A border's piece is delivered by the slab below, and stands for parts of both.
  for (const Index t : {s - 1, s + 1}) {
    if (t < 0 || t == run.count()) continue;
    for (SurfacePiece& piece : decimated_by(run, t, &work)) delivered.push_back(std::move(piece));
  }
  measured.original_to_result =
      distance(in_world(run, originals[0]), rounded_in_world(run, join(delivered)));
  if (s + 1 < run.count()) originals.push_back(chosen_surface_of(run, s + 1, &work));
  measured.result_to_original = distance(own, in_world(run, join(originals)));
  ArchiveWriter archive;
  archive.add_one(measured);
  run.mesh.slabs.scratch.write(surface_file("measured", s), archive);
  return work;
}

bool decimates_in_slabs(const SurfaceRun& run) {
  const Parameters& p = run.parameters;
  return p.triangles == 0 && std::isfinite(*p.tolerance) && *p.tolerance > run.parts.shift;
}

std::vector<SurfacePiece> decimated_by(const SurfaceRun& run, Index s, SlabWork* work) {
  const Scratch& scratch = run.mesh.slabs.scratch;
  std::vector<SurfacePiece> pieces{read_surface(scratch, surface_file("decimated", s), work)};
  if (s + 1 < run.count()) {
    pieces.push_back(read_surface(scratch, surface_file("decimated border", s), work));
  }
  return pieces;
}

SurfacePiece decimated_piece(const SurfaceRun& run) {
  std::vector<SurfacePiece> pieces;
  for (Index s = 0; s < run.count(); ++s) {
    for (SurfacePiece& piece : decimated_by(run, s)) pieces.push_back(std::move(piece));
  }
  return join(pieces);
}

TriMesh rounded_in_world(const SurfaceRun& run, const SurfacePiece& piece) {
  TriMesh mesh = in_world(run, piece);
  for (Vec3& p : mesh.points) p = rounded(p);
  return mesh;
}

TriMesh decimated_surface(const SurfaceRun& run) {
  return rounded_in_world(run, decimated_piece(run));
}

PrintableReport printable_report(const SurfaceRun& run) {
  PrintableReport report;
  report.parts = run.choice.report;
  for (Index s = 0; s < run.count(); ++s) {
    const Measured measured = read_measured(run, s);
    report.triangles_extracted += measured.triangles;
    report.extracted_to_result = std::max(report.extracted_to_result, measured.original_to_result);
    report.result_to_extracted = std::max(report.result_to_extracted, measured.result_to_original);
  }
  return report;
}

}  // namespace mesamis::detail::slabs
