// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/image/volume.h"
#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/object_files.h"
#include "mesamis/surface/tri_mesh.h"

/// Pictures of surfaces, meshes and slices as PNG, in parallel projection. They are drawn here, by the
/// processor: no display and no graphics library is needed, and the same input gives the same
/// bytes.
namespace mesamis {

/// A plane across one of the axes.
struct Clip {
  int axis = 2;         ///< 0 x, 1 y, 2 z
  double position = 0;  ///< mm along the axis, in the coordinates of the object
};

struct PictureOptions {
  std::array<int, 2> pixels{1000, 800};  ///< width and height, 64 to 8192 each
  std::string view = "oblique";  ///< front back left right top bottom oblique, anatomical in LPS
  double zoom = 1;               ///< magnification of the view that shows the whole object, > 0
  std::optional<Vec3> focus;     ///< centre of the picture, mm; default: the centre of the object
  bool edges = false;            ///< draw the edges of triangles or cells
  std::optional<Clip> clip;      ///< hides the whole cells on the viewer's side of the plane;
                                 ///< volumes: selects the nearest slice
  std::string color;             ///< meshes: name of the point or cell array to colour by;
                                 ///< surfaces: title of their values; empty: one colour
  /// Volumes: native values that are black and white; default: from the samples.
  std::optional<Window> window{};
};

/// Predicts what drawing takes, so that a caller can refuse what does not fit. Measured: 250 bytes per
/// triangle, 10 per pixel.
/// @param cells    triangles of surfaces or cells of a mesh.
/// @param options  their pixels count.
/// @return bytes, above what was measured. O(1) time and memory.
double drawing_memory(std::size_t cells, const PictureOptions& options) noexcept;

/// Draws a surface with a scale bar and its size.
///
/// Without options.edges the shading is smooth except across edges sharper than 40 degrees. With
/// options.color a colour bar shows the range of the values from their 0.5 to their 99.5
/// percentile.
///
/// @param png      appears whole or not at all; its folder must exist.
/// @param surface  at least one triangle, finite points, LPS mm.
/// @param options  see there.
/// @param values   one per point of the surface if options.color is set, else not used.
/// @throws InputError  if the surface is empty or not finite, the view is
///                     unknown, the number of values is wrong, a number of the options is out of
///                     range, the clip plane leaves nothing, or the file cannot be written.
///
/// O(triangles), and the memory of drawing_memory().
void draw_surface(const std::filesystem::path& png, const TriMesh& surface,
                  const PictureOptions& options = {}, std::span<const double> values = {});

/// Draws several objects, each in its colour, with a scale bar and the size of all. Shading as of
/// draw_surface().
///
/// @param png      appears whole or not at all; its folder must exist.
/// @param objects  at least one triangle in all, finite points, LPS mm.
/// @param options  see there; `color` is not used.
/// @throws InputError  as draw_surface().
///
/// O(triangles), and the memory of drawing_memory().
void draw_objects(const std::filesystem::path& png, std::span<const NamedSurface> objects,
                  const PictureOptions& options = {});

/// Draws the boundary of a mesh, or of what the clip plane leaves of it, with a scale bar, its size
/// and the number of its cells.
///
/// @param png      appears whole or not at all; its folder must exist.
/// @param mesh     at least one cell, finite points, LPS mm; options.color names one of its
///                 point or cell arrays, of one component.
/// @param options  see there.
/// @throws InputError  as draw_surface(), or if there is no array of that name or it has more than
///                     one component.
///
/// O(cells), and the memory of drawing_memory().
void draw_mesh(const std::filesystem::path& png, const MeshWithArrays& mesh,
               const PictureOptions& options = {});

/// Draws one slice of the voxel grid in grey values, with a scale bar, ticks of its LPS coordinates
/// in mm along the bottom and the left side, and the letters of the body's sides.
///
/// Grey values run over options.window, or from the 0.5 to the 99.5 percentile of the volume, where
/// samples of -1500 HU and less do not count: padding beyond what the scanner saw.
///
/// The slice is that of the grid axis nearest to options.clip's axis, laid on the page as
/// radiologists do: axial from the feet, coronal from the front, both with the patient's left on
/// the right; sagittal from the patient's left. Without a clip it is the middle axial slice.
/// View, zoom, focus, edges and color are not used.
///
/// @param png      appears whole or not at all; its folder must exist.
/// @param volume   as require_usable() wants it.
/// @param surface  LPS mm; where it crosses the slice, an outline is drawn. nullptr: none.
/// @param options  see there.
/// @throws InputError  if the volume is not usable or does not reach the clip
///                     plane, the window's low end is not below its high one, the size is out of
///                     range, or the file cannot be written.
///
/// O(voxels + triangles), and the memory of drawing_memory().
void draw_slice(const std::filesystem::path& png, const Volume& volume, const TriMesh* surface,
                const PictureOptions& options = {});

}  // namespace mesamis
