// SPDX-License-Identifier: Apache-2.0
// The grey values below the surface as it is delivered.
#include <algorithm>
#include <limits>

#include "mesamis/slabs/point_numbers.h"
#include "mesamis/slabs/surface_files.h"
#include "mesamis/surface/depth_maximum.h"

namespace mesamis::detail::slabs {
namespace {

/// As surface_grey().
constexpr double kVoxels = 2;
constexpr int kSamples = 4;

/// The last mesh of slab s and its neighbours, between two heights.
Piece mesh_between(const SurfaceRun& run, Index s, const HeightRange& range, SlabWork& work) {
  std::vector<Piece> pieces;
  for (Index t = std::max(0, s - 1); t <= std::min(run.count() - 1, s + 1); ++t) {
    const Piece piece = read_final(run.mesh, run.last, t, t == s ? nullptr : &work);
    pieces.push_back(select(piece, [&](const Cell& cell) {
      return is_near(piece.mesh, cell, (range.low + range.high) / 2, (range.high - range.low) / 2);
    }));
  }
  return join(pieces);
}

/// The triangles at the first points.
SurfacePiece around_first(const SurfacePiece& piece, std::size_t points) {
  std::vector<char> chosen;
  chosen.reserve(piece.triangles.size());
  for (const Triangle& t : piece.triangles) {
    chosen.push_back(std::any_of(
        t.begin(), t.end(), [points](Index p) { return static_cast<std::size_t>(p) < points; }));
  }
  return select(piece, chosen);
}

/// The grey values below the points of a surface.
std::vector<double> grey_below(const SurfaceRun& run, Index s, const SurfacePiece& piece,
                               SlabWork& work) {
  const TriMesh surface = mesh_of(piece, &SurfacePoint::at);
  const double depth =
      kVoxels * run.mesh.slabs.plan.whole.voxel_size() / run.mesh.input.parameters.unit_mm;
  const Box box = bounding_box(surface.points);
  const Piece mesh = mesh_between(run, s, {box.lo.z - depth, box.hi.z + depth}, work);
  return max_below_surface(mesh.mesh, values_of(mesh, &NodeValues::u), surface,
                           {.depth = depth, .samples = kSamples});
}

/// The place of a point among others, of which some may be equal: the first. Of the nearest if it
/// is none of them.
class Places {
 public:
  explicit Places(const std::vector<Vec3>& points) : points_(points) {
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (numbers_.of(points[p]).is_new) first_.push_back(p);
    }
  }
  std::size_t of(const Vec3& p) const {
    const Index number = numbers_.find(p);
    if (number != kNoIndex) return first_[static_cast<std::size_t>(number)];
    const auto nearer = [&p](const Vec3& a, const Vec3& b) { return norm(a - p) < norm(b - p); };
    return static_cast<std::size_t>(std::min_element(points_.begin(), points_.end(), nearer) -
                                    points_.begin());
  }

 private:
  const std::vector<Vec3>& points_;
  PointNumbers numbers_;
  std::vector<std::size_t> first_;  // by number
};

}  // namespace

SlabWork find_grey(const SurfaceRun& run, Index s) {
  SlabWork work;
  std::vector<SurfacePiece> pieces = decimated_by(run, s);
  const std::size_t own = join(pieces).points.size();
  // The triangles around own points that are others'.
  for (const Index t : {s - 1, s + 1}) {
    if (t < 0 || t == run.count()) continue;
    for (SurfacePiece& piece : decimated_by(run, t, &work)) pieces.push_back(std::move(piece));
  }
  const SurfacePiece piece = around_first(join(pieces), own);
  std::vector<double> grey;
  if (own > 0) grey = grey_below(run, s, piece, work);
  grey.resize(own);
  std::vector<Vec3> keys;
  for (std::size_t p = 0; p < own; ++p) keys.push_back(piece.points[p].key);
  ArchiveWriter archive;
  archive.add(keys);
  archive.add(grey);
  run.mesh.slabs.scratch.write(surface_file("grey", s), archive);
  return work;
}

std::vector<double> grey_of(const SurfaceRun& run, const TriMesh& surface) {
  const SurfacePiece whole = decimated_piece(run);
  PointNumbers numbers;
  for (const SurfacePoint& p : whole.points) (void)numbers.of(p.key);
  std::vector<double> values(whole.points.size());
  for (Index s = run.count(); s-- > 0;) {  // of a point of several slabs the first one's stays
    ArchiveReader archive = run.mesh.slabs.scratch.read(surface_file("grey", s));
    const auto keys = archive.next<Vec3>();
    const auto grey = archive.next<double>();
    for (std::size_t n = 0; n < keys.size(); ++n) values[numbers.find(keys[n])] = grey[n];
  }
  const std::vector<Vec3> points = rounded_in_world(run, whole).points;
  const Places places(points);
  std::vector<double> found;
  found.reserve(surface.points.size());
  for (const Vec3& p : surface.points) found.push_back(values[places.of(p)]);
  return found;
}

}  // namespace mesamis::detail::slabs
