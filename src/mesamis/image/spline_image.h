// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

/// An image between its voxels: scanners deliver band-limited images, and a cubic spline through
/// the samples is much nearer to those than a linear interpolant is.
namespace mesamis::detail::image {

/// The cubic B-spline that interpolates the samples of an image. Its second derivative is zero at
/// the outermost voxels, so that a linear image is reproduced. Values are bounded after they are
/// interpolated, so that an edge at a bound keeps its place between the voxels.
struct SplineImage {
  VoxelGrid grid;
  std::span<const float> coefficients{};  ///< one per voxel, in the unit of the samples; i fastest
  float low = 0, high = 0;                ///< bounds of the values, in the unit of the samples
  /// What the coefficients belong to, such as a vector or a file in memory. Copies share it.
  std::shared_ptr<const void> owner{};
};

/// Value and gradient of an image at a point.
struct ImageValue {
  double value = 0;  ///< in the image's unit
  Vec3 gradient;     ///< in the image's unit per mm, along the grid's own axes
};

/// Finds the spline through the samples of an image, by a tridiagonal system per line and axis.
/// @param volume  at least 2 voxels along each axis; taken over, pass it with std::move() to save
///                the copy.
/// @return bounded by the least and the largest sample.
/// O(voxels), in threads; the same bits for any number of them.
SplineImage interpolating_spline(Volume volume);

/// Evaluates the spline and its gradient, unbounded, at one point. O(1): 64 coefficients.
/// @param p  in the grid's own axes, mm; clamped to the box of the voxel centres.
ImageValue spline_at(const SplineImage& image, const Vec3& p);

/// Evaluates the spline alone, unbounded: the value of spline_at() to the bit, in less time.
/// @param p  in the grid's own axes, mm; clamped to the box of the voxel centres.
/// @return in the image's unit; never beyond the coefficients around.
double spline_value_at(const SplineImage& image, const Vec3& p);

/// The bounded spline along one line in the direction of i: what depends on j and k alone is
/// computed once, and what neighbouring points share is kept.
class SplineLine {
 public:
  /// Finds the four slices of coefficients around lines, which move_to() chooses from.
  /// @param image  must live longer than this.
  /// @param z      of the lines, voxels; clamped to the grid.
  SplineLine(const SplineImage& image, double z);
  /// The same, at one line.
  /// @param y  voxels; clamped to the grid.
  SplineLine(const SplineImage& image, double y, double z);

  /// Goes to another line in the same slices.
  /// @param y  voxels; clamped to the grid.
  void move_to(double y);

  /// The value at a point of the line, in the image's unit. Fastest for ascending x.
  /// @param x  voxels; clamped to the grid.
  double at(double x);

 private:
  void find_columns(Index first, double* columns) const;

  const SplineImage& image_;
  std::array<const float*, 4> slices_{};
  std::array<double, 4> slice_weights_{};
  std::array<const float*, 16> row_{};  // the first rows_ of them, with their weights
  std::array<double, 16> weight_{};
  std::size_t rows_ = 0;
  std::array<double, 8> columns_{};  // from first_ on: sums over the rows
  Index first_ = 0, known_ = 0;
};

/// The bounded spline at points that lie near each other: the 64 coefficients around the last one
/// are kept.
class SplinePatch {
 public:
  /// @param image  must live longer than this.
  explicit SplinePatch(const SplineImage& image) : image_(image) {}

  /// The value at a point, in the image's unit: that of SplineLine, to the bit.
  /// @param p  voxels; clamped to the grid.
  double at(const Vec3& p);

 private:
  void move_to(const std::array<Index, 3>& cell);

  const SplineImage& image_;
  std::array<Index, 3> cell_{-1, -1, -1};
  std::array<double, 64> coefficients_;  // i runs fastest
};

}  // namespace mesamis::detail::image
