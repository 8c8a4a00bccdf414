// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "arrays.h"
#include "binding.h"
#include "mesamis/base/error.h"
#include "mesamis/files/output_set.h"
#include "mesamis/report/label_surface_files.h"
#include "mesamis/run/decimate_objects.h"
#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/surface_files.h"
#include "request.h"
#include "volume.h"

namespace mesamis::python {
namespace {

using namespace py::literals;
using Arrays = std::map<std::string, Doubles>;

py::object frame_name_of(const std::optional<Frame>& frame) {
  if (!frame) return py::none();
  return py::str(*frame == Frame::kRas ? "ras" : "lps");
}

py::tuple read_surface_file(const std::string& path) {
  SurfaceFile file;
  {
    const py::gil_scoped_release lock_released;
    file = mesamis::read_surface_file(path);
  }
  return py::make_tuple(array_of<double>(std::move(file.surface.points)),
                        array_of<Index>(std::move(file.surface.triangles)),
                        frame_name_of(file.frame));
}

/// @return the objects of a file, points as they are in it, and the frame that it states.
py::tuple read_objects(const std::string& path) {
  ObjectFile file;
  {
    const py::gil_scoped_release lock_released;
    file = read_object_file(path);
  }
  return py::make_tuple(dicts_of(std::move(file.objects)), frame_name_of(file.frame));
}

/// @return closed objects, points in LPS where the file states a frame; that frame; warnings.
py::tuple read_closed(const std::string& path) {
  ObjectFile file;
  std::vector<std::string> warnings;
  {
    const py::gil_scoped_release lock_released;
    file = read_closed_objects(path, {}, warnings);
  }
  return py::make_tuple(dicts_of(std::move(file.objects)), frame_name_of(file.frame), warnings);
}

/// Objects of several layers may share labels: all are then numbered 1, 2, ...
void number_apart(std::vector<NamedSurface>& objects) {
  std::vector<Segment> segments;
  segments.reserve(objects.size());
  for (const NamedSurface& o : objects) segments.push_back({o.name, o.label, 0, o.colour});
  const std::vector<NamedSurface> numbered = named_segments(segments);
  for (std::size_t n = 0; n < objects.size(); ++n) objects[n].label = numbered[n].label;
}

/// @param dicts  objects, points in LPS where a frame is given.
void write_object_files(const std::string& path, const py::list& dicts, const std::string& frame,
                        const std::string& name) {
  std::vector<NamedSurface> objects = named_surfaces_of(dicts);
  SurfaceWriteOptions as{.frame = std::nullopt, .name = name};
  if (!frame.empty()) as.frame = frame_of(frame);
  const py::gil_scoped_release lock_released;
  number_apart(objects);
  OutputSet set;
  write_named_surfaces(set.file(path), objects, as);
  set.commit();
}

std::vector<double> flat(const Doubles& array) {
  return {array.data(), array.data() + array.size()};
}

/// What goes into the file, points as they are in the frame that it states.
/// @param patient  a scan to whose patient and study it belongs (.dcm); or none.
void write_surface_file(const std::string& path, const std::pair<Doubles, Indices>& shape,
                        const std::string& frame, const std::pair<std::string, Arrays>& content,
                        const std::shared_ptr<Scan>& patient) {
  TriMesh surface = surface_of(shape.first, shape.second);
  const auto& [name, arrays] = content;
  SurfaceWriteOptions as{.frame = std::nullopt, .name = name};
  if (patient) as.subject = subject_of(patient, path);
  if (!frame.empty()) as.frame = frame_of(frame);
  if (as.frame == Frame::kRas) surface = turned(std::move(surface));  // the writer takes LPS
  for (const auto& [key, values] : arrays) as.point_arrays.push_back({key, flat(values)});
  const py::gil_scoped_release lock_released;
  write_surface(path, surface, as);
}

std::vector<MeshArray> mesh_arrays(const Arrays& arrays) {
  std::vector<MeshArray> list;
  for (const auto& [name, values] : arrays) {
    const int components = values.ndim() == 1 ? 1 : static_cast<int>(values.shape(1));
    list.push_back({name, components, flat(values)});
  }
  return list;
}

/// @param nodes  LPS; vectors and tensors too. The file states the frame, and has them in it.
void write_mesh_file(const std::string& path, const Doubles& nodes, const Indices& tets,
                     const std::string& frame_name,
                     const std::pair<Arrays, Arrays>& point_and_cell_arrays) {
  const Frame frame = frame_of(frame_name);
  MeshWithArrays grid{{points_of(nodes, "nodes"), cells_of(tets, "tets")},
                      mesh_arrays(point_and_cell_arrays.first),
                      mesh_arrays(point_and_cell_arrays.second)};
  for (const Cell& cell : grid.mesh.cells) {
    for (const Index node : cell) {
      if (static_cast<std::size_t>(node) < grid.mesh.points.size()) continue;
      throw InputError("tets: expected indices of " + std::to_string(grid.mesh.points.size()) +
                       " nodes, found " + std::to_string(node));
    }
  }
  const std::string extension = path.substr(std::min(path.size(), path.rfind('.')));
  const py::gil_scoped_release lock_released;
  if (extension == ".vtu") {
    write_vtu(path, grid.mesh, {grid.point_arrays, grid.cell_arrays, frame});
  } else if (extension == ".mesh") {
    write_medit_mesh(path, grid.mesh, frame);
  } else {
    throw InputError(path + ": expected .vtu or .mesh, found '" + extension + "'");
  }
}

py::dict dict_of(const std::vector<MeshArray>& arrays) {
  py::dict dict;
  for (const MeshArray& array : arrays) {
    py::array values = array_of<double>(array.values);
    if (array.components > 1) values = values.attr("reshape")(-1, array.components);
    dict[py::str(array.name)] = values;
  }
  return dict;
}

py::tuple read_mesh_file(const std::string& path) {
  MeshWithArrays grid;
  {
    const py::gil_scoped_release lock_released;
    const bool medit = path.size() > 5 && path.compare(path.size() - 5, 5, ".mesh") == 0;
    grid = medit ? MeshWithArrays{read_medit_mesh(path), {}, {}} : read_vtu(path);
  }
  const py::dict points = dict_of(grid.point_arrays), cells = dict_of(grid.cell_arrays);
  return py::make_tuple(array_of<double>(std::move(grid.mesh.points)),
                        array_of<Index>(std::move(grid.mesh.cells)), points, cells);
}

}  // namespace

void bind_files(py::module_& module) {
  module.def("surface_formats", &written_surface_formats);
  module.def("read_surface", &read_surface_file, "path"_a);
  module.def("write_surface", &write_surface_file, "path"_a, "shape"_a, "frame"_a, "content"_a,
             "patient"_a.none(true));
  module.def("read_objects", &read_objects, "path"_a);
  module.def("read_closed_objects", &read_closed, "path"_a);
  module.def("write_objects", &write_object_files, "path"_a, "objects"_a, "frame"_a, "name"_a);
  module.def("read_mesh", &read_mesh_file, "path"_a);
  module.def("write_mesh", &write_mesh_file, "path"_a, "nodes"_a, "tets"_a, "frame"_a, "arrays"_a);
}

}  // namespace mesamis::python
