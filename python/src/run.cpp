// SPDX-License-Identifier: Apache-2.0
#include "run.h"

#include <pybind11/stl.h>

#include <nlohmann/json.hpp>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/report/run_surface.h"
#include "mesamis/shape_files/surface_files.h"

namespace mesamis::python {
namespace {

using Shared = std::shared_ptr<Run>;

std::string report_of(const Run& run) {
  nlohmann::ordered_json report = report_json(run.details(), run.files());
  report["output"]["threads"] = run.threads > 0 ? run.threads : thread_count();
  report["seconds"] = run.seconds;
  return json_text(report);
}

const Result& mesh_of(const Run& run) {
  if (run.details().mesh() != nullptr) return *run.details().mesh();
  throw InputError(run.details().one ? "mesh: expected a run that made one, found a preview"
                                     : "mesh: expected a run with mesh=True, found one without");
}

/// Of a preview, which has a mesh without nodes, too.
const Result& fields_of(const Run& run) {
  return run.details().one ? *run.details().one : mesh_of(run);
}

template <class Number, class Element>
auto field(std::vector<Element> Result::*member) {
  return [member](const Shared& run) { return view_of<Number>(fields_of(*run).*member, run); };
}

py::dict object_of(const Shared& run, std::size_t n) {
  using namespace py::literals;
  const FoundObject o = run->details().objects().at(n);
  const auto& colour = o.segment.colour;
  return py::dict("name"_a = o.segment.name, "label"_a = o.segment.label,
                  "layer"_a = o.segment.layer,
                  "colour"_a = py::make_tuple(colour[0], colour[1], colour[2]),
                  "points"_a = view_of<double>(o.surface.points, run),
                  "triangles"_a = view_of<Index>(o.surface.triangles, run),
                  "expected_error"_a = view_of<double>(run->details().expected_error(n), run));
}

py::list objects_of(const Shared& run) {
  py::list objects;
  for (std::size_t n = 0; n < run->details().objects().size(); ++n)
    objects.append(object_of(run, n));
  return objects;
}

/// How a surface is written.
struct SaveOptions {
  std::string name;
  bool error = false;    ///< with the expected error
  bool patient = false;  ///< .dcm: belongs to patient and study of the scan
};

void save_surface(const Run& run, const std::string& path, const SaveOptions& as) {
  const auto& [name, error, patient] = as;
  if (run.details().one && error && !carries_arrays(path)) {
    throw InputError("error: expected a .vtp or .ply, found " + path);
  }
  RunFiles out = run.files();
  out.surfaces = {path};
  out.name = name;
  out.error = error;
  if (patient) out.subject = subject_of(run.scan, path);
  write(run.details(), out);
}

void save_mesh(const Run& run, const std::string& path, const std::string& region, int bins) {
  mesh_of(run);
  if (run.details().object->kind != TissueKind::kBright) {
    throw InputError(
        "mesh: expected a bright tissue, whose grey values are those of the scan, found " +
        run.details().object->tissue);
  }
  RunFiles out = run.files();
  out.meshes = {path};
  out.mesh = mesh_options(region, bins);
  write(run.details(), out);
}

void save_band(const Run& run, const std::string& path) {
  mesh_of(run);
  RunFiles out = run.files();
  out.band_meshes = {path};
  write(run.details(), out);
}

/// The scan is shown as it was given; where the run took its samples over, as the run used it.
void save_page(const Run& run, const std::string& path) {
  RunFiles out = run.files();
  out.page.html = path;
  out.shown_scan = [&run]() -> std::optional<Volume> {
    if (!run.scan) return std::nullopt;
    return copy_volume(run.scan->spent ? run.details().image() : run.scan->view);
  };
  write(run.details(), out);
}

void save_labelmap(const Run& run, const std::string& path) {
  RunFiles out = run.files();
  out.labelmap = path;
  write(run.details(), out);
}

}  // namespace

RunFiles Run::files() const {
  RunFiles out;
  out.frame = frame;
  out.facts = facts;
  return out;
}

std::vector<std::string> Run::warnings() const {
  std::vector<std::string> lines = facts.warnings;
  const auto append = [&](const std::vector<std::string>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
  };
  if (scan) append(scan->warnings);
  append(outcome.warnings());
  return lines;
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
      .def_property_readonly("several",
                             [](const Run& r) { return r.details().several.has_value(); })
      .def_property_readonly("objects", &objects_of)
      .def_property_readonly(
          "nodes", [](const Shared& r) { return view_of<double>(fields_of(*r).mesh.points, r); })
      .def_property_readonly(
          "tets", [](const Shared& r) { return view_of<Index>(fields_of(*r).mesh.cells, r); })
      .def_property_readonly("u", field<double>(&Result::u))
      .def_property_readonly("v", field<double>(&Result::v))
      .def_property_readonly("f", field<double>(&Result::f))
      .def_property_readonly("metric", field<double>(&Result::metric))
      .def_property_readonly("level",
                             [](const Run& r) -> std::optional<double> {
                               if (r.details().is_of_range()) return std::nullopt;
                               return r.details().parameters().level;
                             })
      .def_property_readonly("converged", [](const Run& r) { return r.details().one->converged; })
      .def_property_readonly("stopped", [](const Run& r) { return r.details().one->stopped; })
      .def_property_readonly("closed", [](const Run& r) { return r.details().checks[0].closed(); })
      .def_property_readonly("warnings", &Run::warnings)
      .def_property_readonly("notes",
                             [](const Run& r) {
                               return r.details().object ? r.details().object->notes
                                                         : std::vector<std::string>{};
                             })
      .def_property_readonly("flaw", [](const Run& r) { return r.details().verdict.message; })
      .def("require_surface",
           [](const Run& r) {
             if (r.details().one) require_surface(*r.details().one, r.details().asked);
           })
      .def("report",
           [](const Run& r) {
             return released({py::none(), 0}, [&](const Progress&) { return report_of(r); });
           })
      .def(
          "save_surface",
          [](const Run& r, const std::string& path, const std::string& name, bool error,
             bool patient) {
            without_lock([&] { save_surface(r, path, {name, error, patient}); });
          },
          "path"_a, "name"_a, "error"_a, "patient"_a)
      .def(
          "save_mesh",
          [](const Run& r, const std::string& path, const std::string& region, int bins) {
            without_lock([&] { save_mesh(r, path, region, bins); });
          },
          "path"_a, "region"_a, "bins"_a)
      .def(
          "save_band",
          [](const Run& r, const std::string& path) { without_lock([&] { save_band(r, path); }); },
          "path"_a)
      .def(
          "save_page",
          [](const Run& r, const std::string& path) { without_lock([&] { save_page(r, path); }); },
          "path"_a)
      .def(
          "save_labelmap",
          [](const Run& r, const std::string& path) {
            without_lock([&] { save_labelmap(r, path); });
          },
          "path"_a);
}

}  // namespace mesamis::python
