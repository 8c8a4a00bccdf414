// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/picture.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkLookupTable.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/picture/annotation.h"
#include "mesamis/picture/color_scale.h"
#include "mesamis/picture/scene.h"
#include "mesamis/picture/vtk_data.h"

namespace mesamis {

using namespace detail;

namespace {

constexpr double kCreaseAngleInDegrees = 40;  // sharper edges are not smoothed by the shading

constexpr Paint kBone{0.95, 0.90, 0.81};
constexpr Paint kInside{0.70, 0.56, 0.49};  // the back faces of an open surface
constexpr Paint kCell{0.74, 0.81, 0.90};
constexpr Paint kEdge{0.12, 0.13, 0.18};

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

/// The points that polygons of a data set use.
std::vector<Vec3> used_points(vtkPolyData& data) {
  std::vector<Vec3> points;
  vtkDataArray& corners = *data.GetPolys()->GetConnectivityArray();
  for (vtkIdType i = 0; i < corners.GetNumberOfValues(); ++i) {
    double p[3];
    data.GetPoint(static_cast<vtkIdType>(corners.GetComponent(i, 0)), p);
    points.push_back({p[0], p[1], p[2]});
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

void show_edges(Scene& scene, vtkActor& actor) {
  vtkProperty& property = *actor.GetProperty();
  property.EdgeVisibilityOn();
  property.SetEdgeColor(kEdge.r, kEdge.g, kEdge.b);
  property.SetLineWidth(static_cast<float>(std::max(1.0, 0.75 * scene.unit())));
}

// ---------------------------------------------------------------- colours

vtkSmartPointer<vtkLookupTable> lookup_table(const ColorBar& bar) {
  constexpr int kSteps = 256;
  const auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(kSteps);
  table->SetTableRange(bar.range.lo, bar.range.hi);
  for (int i = 0; i < kSteps; ++i) {
    const Rgb rgb = bar.color((i + 0.5) / kSteps);
    table->SetTableValue(i, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
  }
  table->SetNanColor(1, 0, 1, 1);
  return table;
}

void color_by(vtkActor& actor, bool on_points, const ColorBar& bar) {
  vtkMapper& mapper = *actor.GetMapper();
  mapper.ScalarVisibilityOn();
  if (on_points) {
    mapper.SetScalarModeToUsePointData();
  } else {
    mapper.SetScalarModeToUseCellData();
  }
  mapper.SetLookupTable(lookup_table(bar));
  mapper.UseLookupTableScalarRangeOn();
  mapper.InterpolateScalarsBeforeMappingOn();
  // Mostly ambient light, so that the colours agree with those of the bar.
  actor.GetProperty()->SetAmbient(0.58);
  actor.GetProperty()->SetDiffuse(0.44);
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

vtkSmartPointer<vtkPolyData> with_normals(vtkPolyData* data) {
  const auto normals = vtkSmartPointer<vtkPolyDataNormals>::New();
  normals->SetInputData(data);
  normals->SetFeatureAngle(kCreaseAngleInDegrees);
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

/// @param data  triangles; the colours that it has, if any, are shown by the caller.
vtkSmartPointer<vtkActor> add_surface(Scene& scene, vtkPolyData* data, bool edges, bool coloured) {
  const auto actor = add_actor(scene, edges ? data : with_normals(data).Get(), kBone);
  vtkProperty& property = *actor->GetProperty();
  const auto inside = vtkSmartPointer<vtkProperty>::New();
  if (edges) {
    show_edges(scene, *actor);
    property.SetInterpolationToFlat();
  } else {
    property.SetSpecular(0.12);
    property.SetSpecularPower(18);
  }
  inside->DeepCopy(&property);
  inside->SetColor(kInside.r, kInside.g, kInside.b);
  inside->SetSpecular(0);
  if (!coloured) actor->SetBackfaceProperty(inside);
  return actor;
}

/// @param values  one per point to colour by, or none for one colour.
vtkSmartPointer<vtkPolyData> with_values(const TriMesh& surface, std::span<const double> values) {
  auto data = vtk_surface(surface);
  if (!values.empty()) {
    add_array(*data->GetPointData(), {"color", 1, {values.begin(), values.end()}},
              surface.points.size(), "point");
    data->GetPointData()->SetActiveScalars("color");
  }
  return data;
}

/// What is drawn, and how it is shown.
struct View {
  CameraAxes axes;
  std::vector<Vec3> points;  ///< that fill the picture
  Margins margins;
  std::string label;
};

void save_view(const std::filesystem::path& png, Scene& scene, const View& view,
               const PictureOptions& options) {
  scene.add_lights();
  scene.fit(view.axes, view.points, view.margins);
  scene.zoom_in(options.zoom, options.focus);
  add_scale_bar(scene);
  add_corner_label(scene, view.label);
  scene.save(png);
}

// ---------------------------------------------------------------- objects

/// The triangles of all objects, each in the colour of its object.
struct ColouredTriangles {
  TriMesh surface;  ///< with the points of the hidden triangles too
  std::vector<Rgb> colours;
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

vtkSmartPointer<vtkPolyData> with_colours(const ColouredTriangles& triangles) {
  auto data = vtk_surface(triangles.surface);
  const auto colours = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colours->SetNumberOfComponents(3);
  for (const Rgb& rgb : triangles.colours) colours->InsertNextTypedTuple(rgb.data());
  data->GetCellData()->SetScalars(colours);
  return data;
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

/// The boundary of the cells that the clip plane does not hide, with the values to colour by.
vtkSmartPointer<vtkPolyData> visible_boundary(const MeshWithArrays& mesh,
                                              const PictureOptions& options, const CameraAxes& axes,
                                              const ColorArray& color) {
  const Clipper clipper(options.clip, axes);
  TetMesh kept{mesh.mesh.points, {}};
  MeshArray cell_values{"color", 1, {}};
  for (std::size_t c = 0; c < mesh.mesh.cells.size(); ++c) {
    if (!clipper.keeps(mesh.mesh.points, mesh.mesh.cells[c])) continue;
    kept.cells.push_back(mesh.mesh.cells[c]);
    if (color.array && !color.on_points) cell_values.values.push_back(color.array->values[c]);
  }
  if (kept.cells.empty()) refuse_empty(*options.clip, bounding_box(mesh.mesh.points));
  const auto grid = vtk_grid(kept);
  if (color.array && color.on_points) {
    add_array(*grid->GetPointData(), {"color", 1, color.array->values}, kept.points.size(),
              "point");
    grid->GetPointData()->SetActiveScalars("color");
  } else if (color.array) {
    add_array(*grid->GetCellData(), cell_values, kept.cells.size(), "cell");
    grid->GetCellData()->SetActiveScalars("color");
  }
  const auto filter = vtkSmartPointer<vtkDataSetSurfaceFilter>::New();
  filter->SetInputData(grid);
  filter->Update();
  return filter->GetOutput();
}

}  // namespace

double drawing_memory(std::size_t cells, const PictureOptions& options) noexcept {
  constexpr double kOfVtk = 3e8, kPerCell = 600, kPerPixel = 180;
  const double pixels = double{1} * options.pixels[0] * options.pixels[1];
  return kOfVtk + kPerCell * static_cast<double>(cells) + kPerPixel * pixels;
}

void draw_surface(const std::filesystem::path& png, const TriMesh& surface,
                  const PictureOptions& options, std::span<const double> values) {
  require_drawable(surface.points, surface.triangles.size());
  if (!options.color.empty() && values.size() != surface.points.size()) {
    throw InputError("picture: a surface of " + std::to_string(surface.points.size()) +
                     " points has no array '" + options.color + "' to colour by, found " +
                     std::to_string(values.size()) + " values");
  }
  if (options.color.empty()) values = {};
  const CameraAxes axes = camera_axes(options.view);
  const TriMesh shown = clipped(surface, options, axes);
  Scene scene(options.pixels, options.display);
  const auto data = with_values(shown, values);
  const auto actor = add_surface(scene, data, options.edges, !values.empty());
  Margins margins;
  if (!values.empty()) {
    const ColorBar bar{options.color, percentile_range(values, 0.005, 0.995)};
    color_by(*actor, true, bar);
    add_color_bar(scene, bar);
    margins.right = kColorBarMargin;
  }
  const std::string label = size_label(bounding_box(surface.points));
  save_view(png, scene, {axes, used_points(*data), margins, label}, options);
}

void draw_objects(const std::filesystem::path& png, std::span<const NamedSurface> objects,
                  const PictureOptions& options) {
  const CameraAxes axes = camera_axes(options.view);
  const ColouredTriangles shown = visible_triangles(objects, options, axes);
  Scene scene(options.pixels, options.display);
  const auto data = with_colours(shown);
  vtkMapper& mapper = *add_surface(scene, data, options.edges, true)->GetMapper();
  mapper.ScalarVisibilityOn();
  mapper.SetScalarModeToUseCellData();
  mapper.SetColorModeToDirectScalars();
  const std::string label = size_label(bounding_box(shown.surface.points));
  save_view(png, scene, {axes, used_points(*data), {}, label}, options);
}

void draw_mesh(const std::filesystem::path& png, const MeshWithArrays& mesh,
               const PictureOptions& options) {
  require_drawable(mesh.mesh.points, mesh.mesh.cells.size());
  const CameraAxes axes = camera_axes(options.view);
  const ColorArray color = options.color.empty() ? ColorArray{} : find_array(mesh, options.color);
  const auto shown = visible_boundary(mesh, options, axes, color);
  Scene scene(options.pixels, options.display);
  const auto actor = add_actor(scene, shown, kCell);
  actor->GetProperty()->SetInterpolationToFlat();
  if (options.edges) show_edges(scene, *actor);
  Margins margins;
  if (color.array) {
    const std::span<const double> values = color.array->values;
    const ColorBar bar{options.color, percentile_range(values, 0.005, 0.995)};
    color_by(*actor, color.on_points, bar);
    add_color_bar(scene, bar);
    margins.right = kColorBarMargin;
  }
  const std::string label = size_label(bounding_box(mesh.mesh.points)) + "   " +
                            std::to_string(mesh.mesh.cells.size()) + " cells";
  save_view(png, scene, {axes, used_points(*shown), margins, label}, options);
}

}  // namespace mesamis
