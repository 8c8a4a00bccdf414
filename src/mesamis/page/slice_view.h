// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesamis/image/grey_values.h"
#include "mesamis/image/slice_plane.h"
#include "mesamis/page/cross_section.h"
#include "mesamis/picture/raster.h"

namespace mesamis::detail::page {

/// A surface with its name and colour.
struct ShownSurface {
  const TriMesh* surface;  ///< LPS, mm
  std::string name;
  Colour colour;                    ///< in space
  Colour outline;                   ///< on slices
  std::span<const double> error{};  ///< expected at its points, mm; empty: not known
};

/// A rectangle of a page, mm.
struct PageBox {
  double left = 0, right = 0, bottom = 0, top = 0;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

/// A slice of a scan with what surfaces leave on it.
struct SliceView {
  std::string name;  ///< "axial"
  SlicePlane plane;
  PageBox box;    ///< of the whole slice, with the voxels' halves at its border
  Raster voxels;  ///< grey, a pixel per voxel or block of voxels
  std::vector<std::vector<PageLine>> outlines;  ///< one list per surface
};

/// The plane across an axis on which surfaces show most, or the middle one where they lie
/// elsewhere.
/// @param axis  0 sagittal, 1 coronal, 2 axial.
SlicePlane plane_through(const VoxelGrid& grid, std::span<const ShownSurface> surfaces, int axis);

/// The rectangle of a slice of the grid, with the voxels' halves at its border.
PageBox box_of(const VoxelGrid& grid, const SlicePlane& plane);

/// Cuts a scan and surfaces.
/// @param scan    usable, see require_usable().
/// @param axis    as for plane_through().
/// @param window  native values that are black and white.
SliceView slice_view(const VolumeView& scan, std::span<const ShownSurface> surfaces, int axis,
                     const Window& window);

/// A line with fewer points: those that lie within a step of the one kept before go, but for the
/// ends. No point of the line is farther than the step from the thinned one.
/// @param step  mm, >= 0.
/// @return empty for a closed line that is no larger than the step.
PageLine thin_line(const PageLine& line, double step);

/// The part of the slice around its outlines, or the whole where it has none, as an SVG that fits
/// its container, with the sides of the body and a scale bar. Its
/// outlines are thinned, to half a pixel of a picture of 1000 pixels, farther where that is still
/// more than 60 000 points.
std::string slice_svg(const SliceView& view, std::span<const ShownSurface> surfaces);

/// The slice with its outlines as a picture of about so many pixels along its longer side.
Raster slice_picture(const SliceView& view, std::span<const ShownSurface> surfaces, int pixels);

/// A length for a scale bar: 1, 2 or 5 times a power of ten, about a quarter of the width.
/// @param width  mm, > 0.
double bar_length(double width);

}  // namespace mesamis::detail::page
