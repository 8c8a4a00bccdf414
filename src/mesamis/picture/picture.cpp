// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/picture/annotation.h"
#include "mesamis/picture/color_scale.h"
#include "mesamis/picture/scene.h"
#include "mesamis/picture/shaded_surface.h"
#include "mesamis/surface/crease_normals.h"

namespace mesamis {

namespace {

constexpr double kCreaseAngleInDegrees = 40;  // sharper edges are not smoothed by the shading

constexpr Colour kBone{242, 230, 207};
constexpr Colour kInside{179, 143, 125};  // the back faces of an open surface
constexpr Colour kCell{189, 207, 230};
constexpr Colour kNoNumber{255, 0, 255};

void require_drawable(std::span<const Vec3> points, std::size_t cells) {
  if (cells == 0) throw InputError("picture: nothing to draw, there are no cells");
  for (const Vec3& p : points) {
    if (!std::isfinite(p.x + p.y + p.z)) throw InputError("picture: a point is not finite");
  }
}

/// "181 x 207 x 155 mm"
std::string size_label(const Box& box) {
  const Vec3 e = box.extent();
  return short_number(e.x) + " × " + short_number(e.y) + " × " + short_number(e.z) + " mm";
}

/// The points that triangles use, once per corner.
std::vector<Vec3> used_points(const TriMesh& surface) {
  std::vector<Vec3> points;
  points.reserve(3 * surface.triangles.size());
  for (const Triangle& t : surface.triangles) {
    for (const Index p : t) points.push_back(surface.points[static_cast<std::size_t>(p)]);
  }
  return points;
}

/// Decides which cells the clip plane hides: whole cells whose centre is on the viewer's side, so
/// that the cut is always visible.
class Clipper {
 public:
  Clipper(const std::optional<Clip>& clip, const CameraAxes& axes)
      : clip_(clip), viewer_above_(clip && axes.forward[clip->axis] < 0) {}
  template <class Corners>
  bool keeps(const std::vector<Vec3>& points, const Corners& corners) const {
    if (!clip_) return true;
    double sum = 0;
    for (const Index p : corners) sum += points[static_cast<std::size_t>(p)][clip_->axis];
    const double center = sum / static_cast<double>(corners.size());
    return viewer_above_ ? center <= clip_->position : center >= clip_->position;
  }

 private:
  std::optional<Clip> clip_;
  bool viewer_above_;
};

[[noreturn]] void refuse_empty(const Clip& clip, const Box& box) {
  throw InputError("picture: nothing is left beyond the clip plane " +
                   std::string(1, "xyz"[clip.axis]) + " = " + short_number(clip.position) +
                   " mm, the object reaches from " + short_number(box.lo[clip.axis]) + " to " +
                   short_number(box.hi[clip.axis]) + " mm");
}

// ---------------------------------------------------------------- colours

/// The colours of a bar at its 256 steps, and one for what is no number.
class ColorTable {
 public:
  explicit ColorTable(const ColorBar& bar) : range_(bar.range) {
    for (std::size_t i = 0; i < kSteps; ++i) {
      colours_[i] = bar.color((static_cast<double>(i) + 0.5) / kSteps);
    }
  }
  Colour at(double value) const {
    if (std::isnan(value)) return kNoNumber;
    const double step = kSteps * (value - range_.lo) / (range_.hi - range_.lo);
    return colours_[static_cast<std::size_t>(std::clamp(step, 0.0, kSteps - 1.0))];
  }

 private:
  static constexpr std::size_t kSteps = 256;
  ValueRange range_;
  std::array<Colour, kSteps> colours_{};
};

/// Mostly ambient light, so that the colours agree with those of the bar.
constexpr Reflectance kMeasured{0.58, 0.44, 0};

/// Colours a surface by values of its points; they must outlive it.
void color_by_points(ShadedSurface& shown, std::span<const double> values, const ColorBar& bar) {
  shown.reflectance = kMeasured;
  shown.paint = [&triangles = shown.surface.triangles, values,
                 table = ColorTable(bar)](const Fragment& fragment) {
    double value = 0;
    for (std::size_t n = 0; n < 3; ++n) {
      const Index point = triangles[fragment.triangle][n];
      value += fragment.weights[n] * values[static_cast<std::size_t>(point)];
    }
    return table.at(value);
  };
}

// ---------------------------------------------------------------- surfaces

TriMesh clipped(const TriMesh& surface, const PictureOptions& options, const CameraAxes& axes) {
  const Clipper clipper(options.clip, axes);
  TriMesh kept{surface.points, {}};
  for (const Triangle& t : surface.triangles) {
    if (clipper.keeps(surface.points, t)) kept.triangles.push_back(t);
  }
  if (kept.triangles.empty()) refuse_empty(*options.clip, bounding_box(surface.points));
  return kept;
}

/// Flat triangles with their edges, or smooth ones with a gloss.
void set_relief(ShadedSurface& shown, bool edges) {
  shown.edges = edges;
  if (edges) return;
  shown.normals = crease_normals(shown.surface, kCreaseAngleInDegrees);
  shown.reflectance.specular = 0.12;
}

/// Where a surface is seen from, and what stands beside it.
struct View {
  CameraAxes axes;
  std::string label;
  std::optional<ColorBar> bar;

  Margins margins() const {
    Margins margins;
    if (bar) margins.right = kColorBarMargin;
    return margins;
  }
};

void save_view(const std::filesystem::path& png, const View& view, const ShadedSurface& shown,
               const PictureOptions& options) {
  Scene scene(options.pixels);
  scene.fit(view.axes, used_points(shown.surface), view.margins());
  scene.zoom_in(options.zoom, options.focus);
  draw_shaded(scene, shown);
  if (view.bar) add_color_bar(scene, *view.bar);
  add_scale_bar(scene);
  add_corner_label(scene, view.label);
  scene.save(png);
}

// ---------------------------------------------------------------- objects

/// The triangles of all objects, each in the colour of its object.
struct ColouredTriangles {
  TriMesh surface;  ///< with the points of the hidden triangles too
  std::vector<Colour> colours;
};

ColouredTriangles visible_triangles(std::span<const NamedSurface> objects,
                                    const PictureOptions& options, const CameraAxes& axes) {
  const Clipper clipper(options.clip, axes);
  JoinedObjects all = joined(objects);
  require_drawable(all.surface.points, all.surface.triangles.size());
  ColouredTriangles shown;
  for (std::size_t t = 0; t < all.object_of.size(); ++t) {
    const Triangle& corners = all.surface.triangles[t];
    if (!clipper.keeps(all.surface.points, corners)) continue;
    shown.surface.triangles.push_back(corners);
    shown.colours.push_back(objects[all.object_of[t]].colour);
  }
  shown.surface.points = std::move(all.surface.points);
  if (shown.colours.empty()) refuse_empty(*options.clip, bounding_box(shown.surface.points));
  return shown;
}

// ---------------------------------------------------------------- meshes

/// An array to colour by; nullptr: none.
struct ColorArray {
  const MeshArray* array = nullptr;
  bool on_points = false;
};

ColorArray find_array(const MeshWithArrays& mesh, const std::string& name) {
  std::string known;
  for (const bool on_points : {true, false}) {
    for (const MeshArray& array : on_points ? mesh.point_arrays : mesh.cell_arrays) {
      if (array.name == name && array.components != 1) {
        throw InputError("picture: array '" + name + "' has " + std::to_string(array.components) +
                         " components, colours need one");
      }
      if (array.name == name) return {&array, on_points};
      if (array.components == 1) known += (known.empty() ? "" : ", ") + array.name;
    }
  }
  throw InputError("picture: no array '" + name + "' to colour by, there is " +
                   (known.empty() ? "none" : known));
}

/// The boundary of cells.
struct Boundary {
  TriMesh surface;                   ///< with all points of the mesh
  std::vector<std::size_t> cell_of;  ///< of each triangle
};

/// The boundary of the cells that the clip plane does not hide.
Boundary visible_boundary(const TetMesh& mesh, const PictureOptions& options,
                          const CameraAxes& axes) {
  const Clipper clipper(options.clip, axes);
  TetMesh kept{mesh.points, {}};
  std::vector<std::size_t> number;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    if (!clipper.keeps(mesh.points, mesh.cells[c])) continue;
    kept.cells.push_back(mesh.cells[c]);
    number.push_back(c);
  }
  if (kept.cells.empty()) refuse_empty(*options.clip, bounding_box(mesh.points));
  const auto neighbours = cell_neighbors(kept);
  Boundary boundary;
  for (std::size_t c = 0; c < kept.cells.size(); ++c) {
    for (std::size_t face = 0; face < 4; ++face) {
      if (neighbours[c][face] != kNoIndex) continue;
      Triangle corners{};
      for (std::size_t n = 0; n < 3; ++n)
        corners[n] = kept.cells[c][static_cast<std::size_t>(kCellFaces[face][n])];
      boundary.surface.triangles.push_back(corners);
      boundary.cell_of.push_back(number[c]);
    }
  }
  boundary.surface.points = std::move(kept.points);
  return boundary;
}

/// Colours the boundary of a mesh by an array; both must outlive it.
void color_by_array(ShadedSurface& shown, const ColorArray& color, const Boundary& boundary,
                    const ColorBar& bar) {
  if (color.on_points) return color_by_points(shown, color.array->values, bar);
  shown.reflectance = kMeasured;
  shown.paint = [&cell_of = boundary.cell_of, &values = color.array->values,
                 table = ColorTable(bar)](const Fragment& fragment) {
    return table.at(values[cell_of[fragment.triangle]]);
  };
}

}  // namespace

double drawing_memory(std::size_t cells, const PictureOptions& options) noexcept {
  constexpr double kAtLeast = 3e7, kPerCell = 320, kPerPixel = 12;
  const double pixels = double{1} * options.pixels[0] * options.pixels[1];
  return kAtLeast + kPerCell * static_cast<double>(cells) + kPerPixel * pixels;
}

void draw_surface(const std::filesystem::path& png, const TriMesh& surface,
                  const PictureOptions& options, std::span<const double> values) {
  require_drawable(surface.points, surface.triangles.size());
  if (!options.color.empty() && values.size() != surface.points.size()) {
    throw InputError("picture: a surface of " + std::to_string(surface.points.size()) +
                     " points has no array '" + options.color + "' to colour by, found " +
                     std::to_string(values.size()) + " values");
  }
  View view{camera_axes(options.view), size_label(bounding_box(surface.points)), {}};
  ShadedSurface shown;
  shown.surface = clipped(surface, options, view.axes);
  shown.paint = [](const Fragment&) { return kBone; };
  if (!options.color.empty()) {
    view.bar = ColorBar{options.color, percentile_range(values, 0.005, 0.995)};
    color_by_points(shown, values, *view.bar);
  } else {
    shown.inside = kInside;
  }
  set_relief(shown, options.edges);
  save_view(png, view, shown, options);
}

void draw_objects(const std::filesystem::path& png, std::span<const NamedSurface> objects,
                  const PictureOptions& options) {
  const CameraAxes axes = camera_axes(options.view);
  ColouredTriangles visible = visible_triangles(objects, options, axes);
  ShadedSurface shown;
  shown.surface = std::move(visible.surface);
  shown.paint = [&visible](const Fragment& fragment) { return visible.colours[fragment.triangle]; };
  set_relief(shown, options.edges);
  save_view(png, {axes, size_label(bounding_box(shown.surface.points)), {}}, shown, options);
}

void draw_mesh(const std::filesystem::path& png, const MeshWithArrays& mesh,
               const PictureOptions& options) {
  require_drawable(mesh.mesh.points, mesh.mesh.cells.size());
  const ColorArray color = options.color.empty() ? ColorArray{} : find_array(mesh, options.color);
  View view{camera_axes(options.view),
            size_label(bounding_box(mesh.mesh.points)) + "   " +
                std::to_string(mesh.mesh.cells.size()) + " cells",
            {}};
  const Boundary boundary = visible_boundary(mesh.mesh, options, view.axes);
  ShadedSurface shown;
  shown.surface = boundary.surface;
  shown.paint = [](const Fragment&) { return kCell; };
  shown.edges = options.edges;
  if (color.array != nullptr) {
    const std::span<const double> values = color.array->values;
    view.bar = ColorBar{options.color, percentile_range(values, 0.005, 0.995)};
    color_by_array(shown, color, boundary, *view.bar);
  }
  save_view(png, view, shown, options);
}

}  // namespace mesamis
