// SPDX-License-Identifier: Apache-2.0
// The grey values below the surface as it is delivered.
#include <algorithm>
#include <limits>

#include "mesamis/slabs/point_numbers.h"
#include "mesamis/slabs/surface_files.h"
#include "mesamis/surface/depth_maximum.h"

namespace mesamis::detail {
namespace {

/// As surface_grey().
constexpr double kVoxels = 2;
constexpr int kSamples = 4;

std::vector<SurfacePiece> delivered_by(const SurfaceRun& run, Index s, SlabWork* work) {
  const Scratch& scratch = run.mesh.slabs.scratch;
  std::vector<SurfacePiece> pieces{read_surface(scratch, surface_file("decimated", s), work)};
  if (s + 1 < run.count()) {
    pieces.push_back(read_surface(scratch, surface_file("decimated border", s), work));
  }
  return pieces;
}

/// The last mesh of slab s and its neighbours, as far as it is nearer to a surface than a distance.
Piece mesh_around(const SurfaceRun& run, Index s, const TriMesh& surface, double distance,
                  SlabWork& work) {
  const Box box = bounding_box(surface.points);
  std::vector<Piece> pieces;
  for (Index t = std::max(0, s - 1); t <= std::min(run.count() - 1, s + 1); ++t) {
    const Piece piece = read_final(run.mesh, run.last, t, t == s ? nullptr : &work);
    pieces.push_back(select(piece, [&](const Cell& cell) {
      return is_near(piece.mesh, cell, (box.lo.z + box.hi.z) / 2, box.extent().z / 2 + distance);
    }));
  }
  return join(pieces);
}

/// The place of a point among others; of the nearest if it is none of them.
class Places {
 public:
  explicit Places(const std::vector<Vec3>& points) : points_(points) {
    for (const Vec3& p : points) (void)numbers_.of(p);
  }
  std::size_t of(const Vec3& p) const {
    const Index number = numbers_.find(p);
    if (number != kNoIndex) return static_cast<std::size_t>(number);
    const auto nearer = [&p](const Vec3& a, const Vec3& b) { return norm(a - p) < norm(b - p); };
    return static_cast<std::size_t>(std::min_element(points_.begin(), points_.end(), nearer) -
                                    points_.begin());
  }

 private:
  const std::vector<Vec3>& points_;
  PointNumbers numbers_;
};

}  // namespace

SlabWork find_grey(const SurfaceRun& run, Index s) {
  SlabWork work;
  std::vector<SurfacePiece> pieces = delivered_by(run, s, nullptr);
  const std::size_t own = join(pieces).points.size();
  // The triangles around own points that are others'.
  for (const Index t : {s - 1, s + 1}) {
    if (t < 0 || t == run.count()) continue;
    for (SurfacePiece& piece : delivered_by(run, t, &work)) pieces.push_back(std::move(piece));
  }
  const SurfacePiece piece = join(pieces);
  std::vector<double> grey;
  if (own > 0) {
    const TriMesh surface = mesh_of(piece, &SurfacePoint::at);
    const double depth =
        kVoxels * run.mesh.slabs.plan.whole.voxel_size() / run.mesh.input.parameters.unit_mm;
    const Piece mesh = mesh_around(run, s, surface, depth, work);
    grey = max_below_surface(mesh.mesh, values_of(mesh, &NodeValues::u), surface,
                             {.depth = depth, .samples = kSamples});
  }
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
  const std::vector<Vec3> points = decimated_surface(run).points;
  const Places places(points);
  std::vector<double> found;
  found.reserve(surface.points.size());
  for (const Vec3& p : surface.points) found.push_back(values[places.of(p)]);
  return found;
}

}  // namespace mesamis::detail
