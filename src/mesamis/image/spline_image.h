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
  /// Finds the sixteen rows of coefficients around a line.
  /// @param image  must live longer than this.
  /// @param y, z   of the line, voxels; clamped to the grid.
  SplineLine(const SplineImage& image, double y, double z);

  /// The value at a point of the line, in the image's unit. Fastest for ascending x.
  /// @param x  voxels; clamped to the grid.
  double at(double x);

 private:
  double column(Index i) const;

  const SplineImage& image_;
  std::array<const float*, 16> rows_{};
  std::array<double, 16> weights_{};
  std::array<double, 4> columns_{};  // at cell_ - 1 to cell_ + 2
  Index cell_ = -100;
};

}  // namespace mesamis::detail::image
