// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesamis/image/spline_image.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/tri_mesh.h"

/// How the points of a surface are moved towards the level set of an image: the steps of
/// follow_image() that hold for the boundaries of several objects, too.
namespace mesamis::detail::fit {

/// Voxels by which filtered_moves() moves a point at most.
inline constexpr double kMostMove = 0.7;

/// Sweeps that normals are smoothed by, if nothing else is said.
inline constexpr int kSweepsOfNormals = 3;

/// A surface's coordinates and the grid that it is moved in.
class SurfaceSpace {
 public:
  /// @param grid         must live longer than this.
  /// @param point_scale  mm per unit of the surface's coordinates, > 0.
  SurfaceSpace(const VoxelGrid& grid, double point_scale);

  /// The length of a voxel, in the surface's unit.
  double voxel() const noexcept { return voxel_; }
  /// The shortest side of a voxel, in the surface's unit.
  double shortest_side() const noexcept { return grid_.shortest_side() / point_scale_; }
  /// The longest one.
  double longest_side() const noexcept { return grid_.longest_side() / point_scale_; }
  /// Whether a side of the voxels exceeds the shortest one by more than a twentieth.
  bool has_thick_slices() const noexcept;
  /// How far a point lies from the planes of thick slices, seen along a normal of unit length: f of
  /// without_terraces(), shortest sides.
  double between_slices(const Vec3& p, const Vec3& normal) const;
  /// The length of a way in steps of the grid.
  double in_steps(const Vec3& way) const;
  /// Whether a point lies on the grid's box, to a millionth of a voxel.
  bool on_box(const Vec3& p) const;
  /// A move, shortened to at most half the way to the box where it would leave it.
  Vec3 within_box(const Vec3& p, const Vec3& move) const;
  /// The move from a point towards a goal, of at most so many voxels, within_box().
  Vec3 step_to(const Vec3& goal, const Vec3& p, double most_voxels) const;
  /// A point of the surface in the world, in single precision.
  Vec3 as_in_a_file(const Vec3& p) const;

 protected:
  const VoxelGrid& grid() const noexcept { return grid_; }
  double point_scale() const noexcept { return point_scale_; }

 private:
  const VoxelGrid& grid_;
  double point_scale_, voxel_;
  Box box_;
};

/// The same with an image on the grid.
class FollowSpace : public SurfaceSpace {
 public:
  /// @param image        must live longer than this.
  /// @param point_scale  mm per unit of the surface's coordinates, > 0.
  FollowSpace(const SplineImage& image, double point_scale)
      : SurfaceSpace(image.grid, point_scale), image_(image) {}

  /// The image at a point of the surface; the gradient is per mm.
  ImageValue at(const Vec3& p) const { return spline_at(image_, point_scale() * p); }
  /// The value alone, in less time.
  double value_at(const Vec3& p) const { return spline_value_at(image_, point_scale() * p); }
  /// Slopes per mm to slopes per voxel.
  double per_voxel(double slope) const noexcept { return slope * grid().voxel_size(); }

 private:
  const SplineImage& image_;
};

/// The neighbours of each point of a surface, each once: those of point p from start[p] to before
/// start[p + 1]. Edges may belong to any number of triangles; the points of an edge are neighbours
/// of each other.
struct Neighbors {
  explicit Neighbors(const TriMesh& surface);
  /// Where a neighbour stands in the list of a point; start[point + 1] if it is none.
  std::size_t place_of(Index neighbor, Index point) const;
  bool has(Index point, Index neighbor) const;

  std::vector<std::size_t> start;
  std::vector<Index> points;

 private:
  /// Of edges of one triangle, where a surface is open.
  void add_way_back();
};

/// What the image tells at a place; voxels.
struct ImageOffset {
  double distance = 0;  ///< to the level set, outwards along the normal
  double noise = 0;     ///< standard deviation of the distance
};

/// @param above  the image's value less the level, grey values.
/// @param slope  of the image inwards, grey values per voxel.
/// @param noise  standard deviation in the image, grey values.
/// @return nothing where the image is flat.
std::optional<ImageOffset> image_offset(double above, double slope, double noise);

/// What the image tells at the points of a surface; voxels.
struct Offsets {
  explicit Offsets(std::size_t points) : distance(points), noise(points), weight(points) {}
  /// Sets those of a point; the weight grows with the slope.
  void set(std::size_t point, const ImageOffset& offset, double slope);

  std::vector<double> distance;  ///< to the level set, outwards along the normal
  std::vector<double> noise;     ///< standard deviation of the distance
  std::vector<double> weight;    ///< 0: the image tells nothing
};

/// At how many points the image tells anything, and at how many of them little noise does. Those of
/// the parts of a surface add up.
struct FollowCounts {
  std::int64_t told = 0, clear = 0;

  /// Whether noise leaves anything to be told of the surface.
  bool is_worthwhile() const noexcept { return 2 * clear > told; }
};
FollowCounts count_told(const Offsets& offsets);

/// Normals, smoothed along the surface: each sweep goes half the way to the neighbours' mean.
std::vector<Vec3> smoothed_normals(const TriMesh& surface, const Neighbors& neighbors,
                                   int sweeps = kSweepsOfNormals);
/// The same of boundaries of several objects, whose triangles may be turned against each other where
/// they meet: points on curves say nothing to those beside them.
std::vector<Vec3> smoothed_normals(const TriMesh& surface, const Neighbors& neighbors,
                                   const std::vector<char>& on_curve);

/// The least, and the greatest, of a value at each point and at its neighbours.
std::vector<double> least_around(const Neighbors& neighbors, const std::vector<double>& values);
std::vector<double> greatest_around(const Neighbors& neighbors, const std::vector<double>& values);

/// What of the distances is not noise, as follow_image() says; in the surface's unit.
std::vector<double> filtered_moves(const FollowSpace& space, const Offsets& offsets,
                                   const Neighbors& neighbors);

/// Where triangles must not meet: as they are, and once they are in a file, which holds single
/// precision; or in a file alone, which is found in half the time.
enum class Unfolded { kHereAndInFile, kInFile };

/// Moves the points of a surface, and takes moves back where triangles meet.
class SurfaceMover {
 public:
  /// @param space  must live as long.
  SurfaceMover(const SurfaceSpace& space, TriMesh surface, Unfolded where);
  SurfaceMover(const SurfaceMover&) = delete;  // searches read the surface where it is
  SurfaceMover& operator=(const SurfaceMover&) = delete;

  /// Moves all points, then takes moves back, first half, then whole, where triangles meet; all
  /// where that does not help.
  /// @param start   where the points are moved from, one each.
  /// @param shifts  one each.
  /// @return whether none was taken back.
  bool move(std::vector<Vec3> start, std::vector<Vec3> shifts);

  const std::vector<Vec3>& points() const noexcept { return moved_.points; }
  /// Pairs of triangles that meet where the last move left them, though it moved no corner of theirs.
  const std::vector<TrianglePair>& pairs_left() const noexcept { return left_; }
  /// The surface; the end of the mover.
  TriMesh take_surface() { return std::move(moved_); }

 private:
  bool move_and_take_back(std::vector<Vec3> start, std::vector<Vec3> shifts);
  std::vector<char> moved_corners(const std::vector<Vec3>& shifts,
                                  const std::vector<TrianglePair>& pairs);
  void file_points();

  const SurfaceSpace& space_;
  TriMesh moved_, filed_;  // the second as in a file
  std::optional<SelfIntersections> here_, in_file_;
  std::vector<TrianglePair> left_;
};

/// The same with a surface's own points as the start.
TriMesh moved_without_folds(const SurfaceSpace& space, const TriMesh& surface,
                            std::vector<Vec3> shifts, Unfolded where = Unfolded::kHereAndInFile);

}  // namespace mesamis::detail::fit
