// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "mesamis/base/error.h"
#include "mesamis/delivery/label_output.h"
#include "mesamis/label_files/write_labels.h"
#include "mesamis/record/label_report.h"
#include "mesamis/record/label_surface_files.h"
#include "run.h"

namespace mesamis::python {
namespace {

using Shared = std::shared_ptr<LabelRun>;

std::string report_of(const LabelRun& run) {
  nlohmann::ordered_json report = run.report_head();
  report.update(label_run_json(run.result, run.checks));
  if (run.scan) report["object"].update(run.chosen);
  report["seconds"] = run.seconds;
  return json_text(report);
}

py::dict object_of(const Shared& run, std::size_t n) {
  using namespace py::literals;
  const LabelledObject& o = run->result.objects.at(n);
  return py::dict(
      "name"_a = o.segment.name, "label"_a = o.segment.label, "layer"_a = o.segment.layer,
      "colour"_a = py::make_tuple(o.segment.colour[0], o.segment.colour[1], o.segment.colour[2]),
      "points"_a = view_of<double>(o.surface.points, run),
      "triangles"_a = view_of<Index>(o.surface.triangles, run),
      "expected_error"_a = view_of<double>(o.expected_error, run));
}

const Result& mesh_of(const LabelRun& run) {
  if (run.result.mesh) return *run.result.mesh;
  throw InputError("mesh: expected a run with mesh=True, found one without");
}

void save_mesh(const LabelRun& run, const std::string& path, const std::string& region, int bins) {
  std::vector<FoundObject> objects = found_objects(run.result);
  const std::vector<NamedSurface> named = named_surfaces(run.result);
  for (std::size_t n = 0; n < named.size(); ++n) objects[n].segment.label = named[n].label;
  write_mesh(path, make_mesh_output(mesh_of(run), run.image(), mesh_options(region, bins), objects),
             run.frame);
}

void save_surfaces(const LabelRun& run, const std::string& path, const std::string& name,
                   bool error) {
  const std::vector<std::filesystem::path> paths{path};
  write_label_surfaces(paths, run.result, {run.frame, name, error}, run.wanted > 1);
}

}  // namespace

void bind_labels(py::module_& module) {
  using namespace py::literals;
  py::class_<LabelRun, Shared>(module, "LabelRun")
      .def_property_readonly("objects",
                             [](const Shared& r) {
                               py::list objects;
                               for (std::size_t n = 0; n < r->result.objects.size(); ++n) {
                                 objects.append(object_of(r, n));
                               }
                               return objects;
                             })
      .def_property_readonly(
          "nodes", [](const Shared& r) { return view_of<double>(mesh_of(*r).mesh.points, r); })
      .def_property_readonly(
          "tets", [](const Shared& r) { return view_of<Index>(mesh_of(*r).mesh.cells, r); })
      .def_property_readonly("u", [](const Shared& r) { return view_of<double>(mesh_of(*r).u, r); })
      .def_property_readonly("v", [](const Shared& r) { return view_of<double>(mesh_of(*r).v, r); })
      .def_readonly("warnings", &LabelRun::warnings)
      .def_readonly("notes", &LabelRun::notes)
      .def_readonly("flaw", &LabelRun::flaw)
      .def("report",
           [](const LabelRun& r) {
             return released({py::none(), 0}, [&](const Progress&) { return report_of(r); });
           })
      .def(
          "save_surfaces",
          [](const LabelRun& r, const std::string& path, const std::string& name, bool error) {
            without_lock([&] { save_surfaces(r, path, name, error); });
          },
          "path"_a, "name"_a, "error"_a)
      .def(
          "save_mesh",
          [](const LabelRun& r, const std::string& path, const std::string& region, int bins) {
            without_lock([&] { save_mesh(r, path, region, bins); });
          },
          "path"_a, "region"_a, "bins"_a)
      .def(
          "save_labelmap",
          [](const LabelRun& r, const std::string& path) {
            without_lock(
                [&] { write_label_map(path, label_map_of(r.grid, found_objects(r.result))); });
          },
          "path"_a);
}

}  // namespace mesamis::python
