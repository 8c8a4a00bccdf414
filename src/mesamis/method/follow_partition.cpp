// SPDX-License-Identifier: Apache-2.0
#include "mesamis/method/follow_partition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/fit/bending.h"
#include "mesamis/fit/keep_volumes.h"
#include "mesamis/fit/smooth_surface.h"
#include "mesamis/fit/split_bends.h"
#include "mesamis/fit/surface_moves.h"
#include "mesamis/method/sheet_links.h"

namespace mesamis::detail::method {
namespace {

constexpr int kRounds = 2;            // a flow of labels ends up to a voxel from the level set
constexpr double kLeastContrast = 4;  // standard deviations of the noise
constexpr double kLeastGrey = 10;     // grey values: a contrast that means something

/// How much firmer labels are smoothed where an image gives back what they lose.
constexpr double kFirmer = 3;

constexpr double kMuchLost = 0.9;  // of a volume: what is left of it

constexpr int kFairingSweeps = 10;  // pairs of steps of Taubin's filter
constexpr double kShrink = 0.5, kGrow = -0.53;
constexpr double kMostFairing = 0.7;  // voxels

/// What the image tells at the points that have a guide.
Offsets measure(const FollowSpace& space, const TriMesh& surface, const std::vector<Vec3>& normals,
                const std::vector<BoundaryGuide>& guides, double noise) {
  Offsets offsets(surface.points.size());
  parallel_for(surface.points.size(), [&](std::size_t p) {
    const BoundaryGuide& guide = guides[p];
    if (guide.contrast == 0 || space.on_box(surface.points[p])) return;
    const double sign = guide.contrast > 0 ? 1 : -1;
    const ImageValue here = space.at(surface.points[p]);
    const double slope = space.per_voxel(-sign * dot(here.gradient, normals[p]));
    const auto offset = image_offset(sign * (here.value - guide.level), slope, noise);
    if (offset) offsets.set(p, *offset, slope);
  });
  return offsets;
}

/// Points without a guide go with those beside them that have one, by the mean of their moves.
void carry_others(const Neighbors& neighbors, const std::vector<BoundaryGuide>& guides,
                  std::vector<Vec3>& shifts) {
  for (std::size_t p = 0; p < shifts.size(); ++p) {
    if (guides[p].contrast != 0) continue;
    Vec3 sum;
    int count = 0;
    for (std::size_t n = neighbors.start[p]; n < neighbors.start[p + 1]; ++n) {
      const auto other = static_cast<std::size_t>(neighbors.points[n]);
      if (guides[other].contrast == 0) continue;
      sum += shifts[other];
      ++count;
    }
    if (count > 0) shifts[p] = (1.0 / count) * sum;
  }
}

/// How far Taubin's filter moves the points, at most so far; those on the box stay.
std::vector<Vec3> faired(const FollowSpace& space, const std::vector<Vec3>& start,
                         const Umbrella& umbrella, double most) {
  std::vector<Vec3> points = start;
  for (int step = 0; step < 2 * kFairingSweeps; ++step) {
    const double factor = step % 2 == 0 ? kShrink : kGrow;
    const std::vector<Vec3> bent = umbrella.bent(points);
    parallel_for(points.size(), [&](std::size_t p) {
      if (!space.on_box(start[p])) points[p] = points[p] - factor * bent[p];
    });
  }
  parallel_for(points.size(), [&](std::size_t p) {
    const Vec3 shift = points[p] - start[p];
    const double length = norm(shift);
    points[p] = (length > most ? most / length : 1) * shift;
  });
  return points;
}

/// Between thick slices two boundaries that both go on fold too often.
Through through_curves(const VoxelGrid& grid) {
  constexpr double kMostThickness = 2;
  const bool is_thick = grid.longest_side() > kMostThickness * grid.shortest_side();
  return is_thick ? Through::kSmoothest : Through::kBoth;
}

/// Smooth boundaries; parts that would lose much of their volume get it back.
TriMesh smoothed(const RoughBoundaries& rough, const std::vector<char>& on_curve,
                 const VoxelGrid& grid, const SmoothingOptions& options) {
  TriMesh smooth{smooth_places(rough, grid, options), rough.surface.triangles};
  const BoundaryParts& parts = *rough.parts;
  std::vector<double> volumes = enclosed_volumes(smooth, parts.sides);
  bool any = false;
  for (std::size_t p = 1; p < parts.volumes.size(); ++p) {
    if (!(volumes[p] < kMuchLost * parts.volumes[p])) continue;
    volumes[p] = parts.volumes[p];
    any = true;
  }
  if (any) {
    const std::vector<Vec3> shifts = keep_volumes({smooth, parts.sides, on_curve, volumes}, grid);
    parallel_for(shifts.size(), [&](std::size_t p) { smooth.points[p] += shifts[p]; });
  }
  return moved_to(rough.surface, grid, smooth.points);
}

/// Boundaries of parts as those of their materials.
PartitionSurface of_materials(PartitionSurface boundaries, const BoundaryParts& parts) {
  for (auto& sides : boundaries.sides) {
    for (Index& side : sides) {
      if (side > 0) side = parts.material[side];
    }
  }
  return boundaries;
}

/// Marks the ends of edges amid which a new point is a corner of a pair.
/// @param whole  of each point of the surface before edges were split.
/// @return whether there are any.
bool mark_ends(const SplitBoundaries& split, const std::vector<TrianglePair>& pairs,
               std::vector<char>& whole) {
  bool any = false;
  for (const TrianglePair& pair : pairs) {
    for (const Index t : pair) {
      for (const Index p : split.surface.triangles[t]) {
        if (p < std::ssize(whole)) continue;
        for (const Index end : split.edges[static_cast<std::size_t>(p) - whole.size()]) {
          whole[end] = 1;
        }
        any = true;
      }
    }
  }
  return any;
}

/// Splits edges where boundaries bend, and moves points; edges stay whole where a new point, once it
/// is in a file, would make boundaries meet even where it is not moved.
/// @param shifts_of  the shift of each point of the boundaries that were split.
/// @return its sides are the parts.
template <class Shifts>
PartitionSurface split_and_moved(const TriMesh& surface, const BoundaryParts& parts,
                                 const std::vector<char>& on_curve, const VoxelGrid& grid,
                                 Shifts&& shifts_of) {
  const SurfaceSpace space(grid, 1);
  std::vector<char> whole(surface.points.size(), 0);
  while (true) {
    SplitBoundaries split = split_bends({surface, parts.sides, on_curve, whole}, grid);
    std::vector<Vec3> shifts = shifts_of(split);
    SurfaceMover mover(space, split.surface, Unfolded::kInFile);
    mover.move(split.surface.points, std::move(shifts));
    if (mark_ends(split, mover.pairs_left(), whole)) continue;
    TriMesh moved = mover.take_surface();
    return {std::move(moved.points), std::move(moved.triangles), std::move(split.sides)};
  }
}

}  // namespace

bool shows_edge(const PairLevel& pair, double noise) {
  return std::abs(pair.contrast) >= std::max(kLeastGrey, kLeastContrast * noise);
}

std::vector<BoundaryGuide> guides_of_points(const PartitionSurface& partition,
                                            const std::vector<PairLevel>& pairs, double noise) {
  const std::vector<Index> pair_of = pairs_of_points(partition, pairs);
  std::vector<BoundaryGuide> guides(pair_of.size());
  for (std::size_t p = 0; p < guides.size(); ++p) {
    if (pair_of[p] == kNoIndex) continue;
    const PairLevel& pair = pairs[static_cast<std::size_t>(pair_of[p])];
    if (shows_edge(pair, noise)) guides[p] = {pair.level, pair.contrast};
  }
  return guides;
}

PartitionSurface only_chosen(const PartitionSurface& all, const std::vector<char>& chosen,
                             std::vector<BoundaryGuide>& guides) {
  const auto seen = [&](Index m) {
    return m > 0 && chosen[static_cast<std::size_t>(m)] != 0 ? m : 0;
  };
  PartitionSurface kept;
  std::vector<BoundaryGuide> guides_kept;
  std::vector<Index> number(all.points.size(), kNoIndex);
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    std::array<Index, 2> sides{seen(all.sides[t][0]), seen(all.sides[t][1])};
    if (sides[0] == sides[1]) continue;
    Triangle triangle = all.triangles[t];
    const bool flips = sides[0] > sides[1];
    if (flips) {
      std::swap(sides[0], sides[1]);
      std::swap(triangle[1], triangle[2]);
    }
    for (Index& p : triangle) {
      Index& n = number[static_cast<std::size_t>(p)];
      if (n == kNoIndex) {
        n = static_cast<Index>(kept.points.size());
        kept.points.push_back(all.points[p]);
        BoundaryGuide guide = guides[static_cast<std::size_t>(p)];
        if (flips) guide.contrast = -guide.contrast;
        guides_kept.push_back(guide);
      }
      p = n;
    }
    kept.triangles.push_back(triangle);
    kept.sides.push_back(sides);
  }
  guides = std::move(guides_kept);
  return kept;
}

PartitionSurface follow_image(PartitionSurface partition, const SplineImage& image,
                              const std::vector<BoundaryGuide>& guides, double noise) {
  const FollowSpace space(image, 1);
  const std::vector<char> on_curve = curve_points(partition);
  TriMesh surface = taken_from(partition);
  const Neighbors neighbors(surface);
  const Umbrella umbrella(neighbors, links_along_curves(neighbors, on_curve));
  surface = moved_without_folds(
      space, surface, faired(space, surface.points, umbrella, kMostFairing * space.voxel()));
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Vec3> normals = smoothed_normals(surface, neighbors, on_curve);
    const Offsets offsets = measure(space, surface, normals, guides, noise);
    if (!count_told(offsets).is_worthwhile()) break;
    const std::vector<double> moves = filtered_moves(space, offsets, neighbors);
    std::vector<Vec3> shifts(moves.size());
    for (std::size_t p = 0; p < moves.size(); ++p) shifts[p] = moves[p] * normals[p];
    carry_others(neighbors, guides, shifts);
    for (std::size_t p = 0; p < moves.size(); ++p) {
      shifts[p] = space.within_box(surface.points[p], shifts[p]);
    }
    surface = moved_without_folds(space, surface, std::move(shifts));
  }
  return put_back(std::move(surface), std::move(partition));
}

PartitionSurface fit_boundaries(PartitionSurface partition, const SplineImage& image,
                                const BoundaryAims& aims) {
  FitPoints points{{}, curve_points(partition), {}};
  const TriMesh start = taken_from(partition);
  const VoxelGrid& grid = image.grid;
  points.links = sheet_links(start, partition.sides, points.on_curve, through_curves(grid));
  for (const BoundaryGuide& guide : aims.guides) points.contrast.push_back(guide.contrast);
  SmoothingOptions smoothing = smoothing_of_labels(grid);
  smoothing.bending *= kFirmer;
  BoundaryParts parts = parts_of_boundaries(start, partition.sides);
  parts.scale_to(aims.volumes);
  const TriMesh smooth = smoothed({start, points.links, &parts}, points.on_curve, grid, smoothing);
  const TriMesh fitted =
      fit_surface(smooth, image, points, {.reach = aims.reach, .sheets = aims.sheets});
  return of_materials(split_and_moved(fitted, parts, points.on_curve, grid,
                                      [](const SplitBoundaries& split) { return split.shifts; }),
                      parts);
}

PartitionSurface smooth_boundaries(PartitionSurface partition, const VoxelGrid& grid,
                                   std::span<const double> volumes) {
  const std::vector<char> on_curve = curve_points(partition);
  const TriMesh start = taken_from(partition);
  const Links links = sheet_links(start, partition.sides, on_curve, through_curves(grid));
  BoundaryParts parts = parts_of_boundaries(start, partition.sides);
  parts.scale_to(volumes);
  const TriMesh smooth =
      smoothed({start, links, &parts}, on_curve, grid, smoothing_of_labels(grid));
  const auto shifts_of = [&](const SplitBoundaries& split) {
    std::vector<char> curve = on_curve;
    curve.resize(split.surface.points.size(), 0);
    return keep_volumes({split.surface, split.sides, curve, parts.volumes, split.shifts}, grid);
  };
  return of_materials(split_and_moved(smooth, parts, on_curve, grid, shifts_of), parts);
}

}  // namespace mesamis::detail::method
