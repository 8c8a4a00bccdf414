// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"
#include "mesamis/shape_files/object_formats.h"
#include "mesamis/shape_files/vtk_xml_writer.h"
#include "mesamis/shape_files/vtp_names.h"

namespace mesamis::detail::shape_files {
namespace {

VtkArray array_of(std::string name, const std::vector<double>& values) {
  return vtk_array<double>(std::move(name), 1, values.size(),
                           [&values](std::size_t i) { return values[i]; });
}

std::vector<VtkArray> field_data(const SurfaceWriteOptions& options) {
  std::vector<VtkArray> fields;
  if (options.frame) fields.push_back(vtk_text(kFrameField, frame_name(*options.frame)));
  fields.push_back(vtk_text("LengthUnit", "mm"));
  if (!options.name.empty()) fields.push_back(vtk_text(kNameField, options.name));
  return fields;
}

VtkArrayGroup point_data(const SurfaceWriteOptions& options) {
  VtkArrayGroup group{"PointData", {}};
  if (!options.grey.empty()) group.arrays.push_back(array_of("grey", options.grey));
  for (const auto& [name, values] : options.point_arrays) {
    group.arrays.push_back(array_of(name, values));
  }
  return group;
}

VtkArrayGroup no_cells(const char* element) {
  constexpr auto kNothing = [](std::size_t) { return 0; };
  return {element,
          {vtk_array<std::int64_t>("connectivity", 1, 0, kNothing),
           vtk_array<std::int64_t>("offsets", 1, 0, kNothing)}};
}

VtkArrayGroup triangle_cells(const std::vector<Triangle>& triangles) {
  if (triangles.size() > std::numeric_limits<std::int32_t>::max() / 3) {
    throw InputError(message("mesh: ", triangles.size(), " cells are too many for a VTK file"));
  }
  auto corner = [&triangles](std::size_t i) { return triangles[i / 3][i % 3]; };
  auto end_of_triangle = [](std::size_t t) { return 3 * (t + 1); };
  return {"Polys",
          {vtk_array<std::int32_t>("connectivity", 1, 3 * triangles.size(), corner),
           vtk_array<std::int32_t>("offsets", 1, triangles.size(), end_of_triangle)}};
}

std::string polygon_bytes(const TriMesh& surface, const std::vector<VtkArray>& fields,
                          const VtkArrayGroup& point_data, const VtkArrayGroup& cell_data) {
  const std::vector<Vec3>& points = surface.points;
  auto coordinate = [&points](std::size_t i) { return points[i / 3][static_cast<int>(i % 3)]; };
  return vtk_xml_bytes(
      {"PolyData",
       fields,
       {{"NumberOfPoints", points.size()},
        {"NumberOfVerts", 0},
        {"NumberOfLines", 0},
        {"NumberOfStrips", 0},
        {"NumberOfPolys", surface.triangles.size()}},
       {point_data,
        cell_data,
        {"Points", {vtk_array<double>("Points", 3, 3 * points.size(), coordinate)}},
        no_cells("Verts"),
        no_cells("Lines"),
        no_cells("Strips"),
        triangle_cells(surface.triangles)}});
}

/// Labels and names of the objects, in their order.
std::vector<VtkArray> object_fields(std::span<const NamedSurface> objects) {
  std::vector<std::string> names;
  for (const NamedSurface& object : objects) names.push_back(object.name);
  VtkArray labels = vtk_array<std::int32_t>(kLabelsField, 1, objects.size(),
                                            [objects](std::size_t i) { return objects[i].label; });
  labels.tuples = objects.size();
  return {std::move(labels), vtk_texts(kNamesField, names)};
}

}  // namespace

std::string vtp_bytes(const TriMesh& surface, const SurfaceWriteOptions& options) {
  return polygon_bytes(surface, field_data(options), point_data(options), {"CellData", {}});
}

std::string vtp_object_bytes(std::span<const NamedSurface> objects,
                             const SurfaceWriteOptions& options) {
  const JoinedObjects all = joined(objects);
  const std::vector<Index>& object_of = all.object_of;
  std::vector<VtkArray> fields = field_data(options);
  for (VtkArray& array : object_fields(objects)) fields.push_back(std::move(array));
  const VtkArrayGroup cell_data{
      "CellData",
      {vtk_array<std::int32_t>(kLabelArray, 1, object_of.size(),
                               [&](std::size_t t) { return objects[object_of[t]].label; }),
       vtk_array<std::uint8_t>(
           kColourArray, 3, 3 * object_of.size(),
           [&](std::size_t i) { return objects[object_of[i / 3]].colour[i % 3]; })},
      kColourArray};
  return polygon_bytes(all.surface, fields, {"PointData", {}}, cell_data);
}

}  // namespace mesamis::detail::shape_files
