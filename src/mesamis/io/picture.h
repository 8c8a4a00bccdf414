// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "mesamis/image/volume.h"
#include "mesamis/io/mesh_files.h"
#include "mesamis/surface/tri_mesh.h"

/// Off-screen pictures, so that anyone can look at a result without another program.
namespace mesamis {

struct Clip {
  int axis = 2;         ///< 0 x, 1 y, 2 z
  double position = 0;  ///< mm along the axis, in the coordinates of what is drawn
};

struct PictureOptions {
  std::array<int, 2> pixels{1000, 800};
  std::string view = "oblique";  ///< front back left right top bottom oblique, anatomical in LPS
  double zoom = 1;               ///< > 0; times larger than what fills the picture
  std::optional<Vec3> focus;     ///< what is in the middle, in the coordinates of what is drawn;
                                 ///< default: its own middle
  bool edges = false;            ///< draw the edges of triangles or cells
  std::optional<Clip> clip;      ///< what lies on the viewer's side of it is taken away, cells
                                 ///< whole; volumes: the slice nearest to it
  std::string color;             ///< meshes: the point or cell array to colour by; surfaces:
                                 ///< what their values are called; empty: plain
};

/// Parallel projection with a scale bar; the file appears whole or not at all.
///
/// Needs a display: VTK of the distribution renders through X. Where DISPLAY names none that works,
/// an Xvfb of its own is started and ended. While drawing, stderr of the process goes nowhere: the
/// software renderer would write to it. Not to be called from two threads at once.
/// @throws InputError  if there is no display and no Xvfb, nothing to draw, an array or a view that
///                     does not exist, or the file cannot be written.
///
/// @param values  with options.color: one per point of the surface, what to colour it by.
void draw_surface(const std::filesystem::path& png, const TriMesh& surface,
                  const PictureOptions& options = {}, std::span<const double> values = {});
void draw_mesh(const std::filesystem::path& png, const MeshWithArrays& mesh,
               const PictureOptions& options = {});
/// One slice of the voxel grid in grey values, laid on the page as radiologists do, with the
/// outline of a surface (LPS mm) over it if given.
void draw_slice(const std::filesystem::path& png, const Volume& volume, const TriMesh* surface,
                const PictureOptions& options = {});

}  // namespace mesamis
