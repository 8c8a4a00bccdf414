// SPDX-License-Identifier: Apache-2.0
#include "run.h"

#include <pybind11/stl.h>

#include <nlohmann/json.hpp>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/record/report.h"
#include "mesamis/record/run_surface.h"
#include "mesamis/shape_files/surface_files.h"

namespace mesamis::python {
namespace {

using Shared = std::shared_ptr<Run>;

std::string report_of(const Run& run) {
  nlohmann::ordered_json report = run.report_head();
  report.update(run_json(run.settings, run.result, run.check));
  report["seconds"] = run.seconds;
  return json_text(report);
}

void save_surface(const Run& run, const std::string& path, const std::string& name, bool error) {
  require_surface(run.result);
  if (error && !carries_arrays(path)) {
    throw InputError("error: expected a .vtp or .ply, found " + path);
  }
  const double voxel = run.image().voxel_size();
  write_surface(path, run.result.surface,
                surface_options(run.result, voxel, {run.frame, name, error, carries_grey(path)}));
}

void require_mesh(const Run& run) {
  if (!run.result.mesh.cells.empty()) return;
  throw InputError("mesh: expected a run that made one, found a preview");
}

void save_mesh(const Run& run, const std::string& path, const std::string& region, int bins) {
  require_mesh(run);
  if (run.object->kind != TissueKind::kBright) {
    throw InputError(
        "mesh: expected a bright tissue, whose grey values are those of the scan, found " +
        run.object->tissue);
  }
  write_mesh(path, make_mesh_output(run.result, run.image(), mesh_options(region, bins)),
             run.frame);
}

template <class Number, class Element>
auto field(std::vector<Element> Result::*member) {
  return [member](const Shared& run) { return view_of<Number>(run->result.*member, run); };
}

}  // namespace

VolumeView RunFacts::image() const {
  VolumeView view = object->volume;
  if (view.samples.empty()) view.samples = scan->view.samples;
  return view;
}

nlohmann::ordered_json RunFacts::report_head() const {
  nlohmann::ordered_json report;
  report["program"] = program_json();
  if (scan) report["input"] = input;
  report["output"] = output_json(frame);
  report["output"]["threads"] = threads > 0 ? threads : thread_count();
  if (scan) report["object"] = chosen;
  return report;
}

MeshOptions mesh_options(const std::string& region, int bins) {
  if (region != "box" && region != "object") {
    throw InputError("region: expected 'box' or 'object', found '" + region + "'");
  }
  if (bins < 1 || bins > kMostBins) {
    throw InputError("bins: expected 1 to " + std::to_string(kMostBins) + ", found " +
                     std::to_string(bins));
  }
  return {region == "object" ? MeshRegion::kObject : MeshRegion::kBox, bins};
}

std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void bind_run(py::module_& module) {
  using namespace py::literals;
  py::class_<Run, Shared>(module, "Run")
      .def_property_readonly(
          "points", [](const Shared& r) { return view_of<double>(r->result.surface.points, r); })
      .def_property_readonly(
          "triangles",
          [](const Shared& r) { return view_of<Index>(r->result.surface.triangles, r); })
      .def_property_readonly(
          "nodes", [](const Shared& r) { return view_of<double>(r->result.mesh.points, r); })
      .def_property_readonly(
          "tets", [](const Shared& r) { return view_of<Index>(r->result.mesh.cells, r); })
      .def_property_readonly("u", field<double>(&Result::u))
      .def_property_readonly("v", field<double>(&Result::v))
      .def_property_readonly("f", field<double>(&Result::f))
      .def_property_readonly("metric", field<double>(&Result::metric))
      .def_property_readonly("expected_error", field<double>(&Result::expected_error))
      .def_property_readonly("level", [](const Run& r) { return r.result.parameters.level; })
      .def_property_readonly("converged", [](const Run& r) { return r.result.converged; })
      .def_property_readonly("stopped", [](const Run& r) { return r.result.stopped; })
      .def_property_readonly("closed", [](const Run& r) { return r.check.closed(); })
      .def_readonly("warnings", &Run::warnings)
      .def_readonly("notes", &Run::notes)
      .def_readonly("flaw", &Run::flaw)
      .def("require_surface", [](const Run& r) { require_surface(r.result); })
      .def("report",
           [](const Run& r) {
             return released({py::none(), 0}, [&](const Progress&) { return report_of(r); });
           })
      .def(
          "save_surface",
          [](const Run& r, const std::string& path, const std::string& name, bool error) {
            without_lock([&] { save_surface(r, path, name, error); });
          },
          "path"_a, "name"_a, "error"_a)
      .def(
          "save_mesh",
          [](const Run& r, const std::string& path, const std::string& region, int bins) {
            without_lock([&] { save_mesh(r, path, region, bins); });
          },
          "path"_a, "region"_a, "bins"_a)
      .def(
          "save_band",
          [](const Run& r, const std::string& path) {
            without_lock([&] {
              require_mesh(r);
              write_band_mesh(path, r.result, r.frame);
            });
          },
          "path"_a);
}

}  // namespace mesamis::python
