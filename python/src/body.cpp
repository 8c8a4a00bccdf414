// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "mesamis/base/error.h"
#include "mesamis/base/written_number.h"
#include "mesamis/body/material_law.h"
#include "mesamis/report/body_json.h"
#include "mesamis/report/body_output.h"
#include "mesamis/report/body_request.h"
#include "mesamis/shape_files/element_files.h"
#include "request.h"
#include "run.h"

namespace mesamis::python {
namespace {

/// A body with the frame of the run that it was made of.
struct Body {
  BodyOutput output;
  Frame frame = Frame::kLps;
  std::vector<std::string> warnings;  ///< promises that it misses; empty ones count for nothing
};
using Shared = std::shared_ptr<Body>;

/// A size that was given; 0: none.
double size_of(const Arguments& a, const char* name) {
  const auto size = a.find<double>(name);
  if (size && !(*size > 0)) {
    throw InputError(std::string(name) + ": expected a number above 0, found " +
                     number_text(*size));
  }
  return size.value_or(0);
}

std::optional<MaterialOptions> material_options(const Arguments& a) {
  if (!a.has("material")) {
    for (const char* name : {"calibration", "ash", "material_gap", "material_rim", "poisson"}) {
      if (!a.has(name)) continue;
      throw InputError(std::string(name) + ": expected material beside it, found none");
    }
    return std::nullopt;
  }
  if (!a.has("calibration"))
    throw InputError("material: expected a calibration beside it, found none");
  MaterialOptions options;
  options.law = parse_material_law(a.get<std::string>("material"));
  options.calibration = parse_calibration(a.get<std::string>("calibration"));
  if (a.has("ash")) options.ash = find_ash_rule(a.get<std::string>("ash"));
  options.gap = a.get<double>("material_gap", options.gap);
  options.poisson = a.find<double>("poisson");
  return options;
}

BodyWishes body_wishes(const Arguments& a, Frame frame) {
  BodyWishes wishes;
  BodyOptions& o = wishes.elements;
  o.element_size = size_of(a, "element_size");
  o.least_size = size_of(a, "least_size");
  o.gradation = a.get<double>("gradation", o.gradation);
  o.through_wall = a.get<int>("wall_elements", o.through_wall);
  o.quadratic = a.get<bool>("quadratic");
  wishes.tolerance = a.find<double>("tolerance");
  wishes.material = material_options(a);
  wishes.rim = a.find<double>("material_rim");
  for (const auto& text : a.get<std::vector<std::string>>("sets")) {
    wishes.sets.push_back(in_lps(parse_face_query(text), frame));
  }
  return wishes;
}

/// What the program does for --body.
Shared body_of(const std::shared_ptr<Run>& run, const py::dict& arguments,
               const py::object& progress, int threads) {
  const OutcomeDetails& found = run->details();
  if (!found.object) throw InputError("body: expected a scan beside the labels, found none");
  const Arguments plain(arguments);
  ElementRequest request{body_wishes(plain, run->frame), true};
  request.memory_gb = plain.get<double>("memory");
  require_fillable(found.asked, request.wishes.tolerance);
  if (request.wishes.material && found.object->kind != TissueKind::kBright) {
    throw InputError("material: expected a bright tissue, found " + found.object->tissue);
  }
  ElementResults results = released({progress, threads}, [&](const Progress& tell) {
    const std::vector<FoundObject> objects = found.objects();
    const VolumeView image = found.image();
    return make_elements(request,
                         {objects, image, image, found.parameters(), found.asked.tolerance}, tell);
  });
  return std::make_shared<Body>(
      Body{std::move(*results.body), run->frame, {results.unmet, results.loose}});
}

py::dict sets_of(const Shared& body) {
  py::dict sets;
  for (const auto& set : body->output.elements.sets) {
    sets[py::str(set.name)] = view_of<Index>(set.nodes, body);
  }
  return sets;
}

py::list materials_of(const Shared& body) {
  py::list materials;
  for (const auto& m : body->output.elements.materials) {
    materials.append(py::make_tuple(m.name, m.modulus, m.poisson, m.density));
  }
  return materials;
}

void save(const Body& body, const std::string& path) {
  write_elements(path, body.output.elements, {.frame = body.frame});
}

}  // namespace

void bind_body(py::module_& module) {
  using namespace py::literals;
  const auto elements = [](const Shared& b) -> const FiniteElements& { return b->output.elements; };
  py::class_<Body, Shared>(module, "Body")
      .def_property_readonly(
          "nodes", [=](const Shared& b) { return view_of<double>(elements(b).points, b); })
      .def_property_readonly("corners",
                             [=](const Shared& b) { return view_of<Index>(elements(b).cells, b); })
      .def_property_readonly(
          "mid_nodes", [=](const Shared& b) { return view_of<Index>(elements(b).mid_nodes, b); })
      .def_property_readonly(
          "part", [=](const Shared& b) { return view_of<Index>(elements(b).part_of_cell, b); })
      .def_property_readonly(
          "material",
          [=](const Shared& b) { return view_of<Index>(elements(b).material_of_cell, b); })
      .def_property_readonly("materials", &materials_of)
      .def_property_readonly("sets", &sets_of)
      .def_readonly("warnings", &Body::warnings)
      .def("report", [](const Body& b) { return json_text(body_json(b.output)); })
      .def(
          "save",
          [](const Body& b, const std::string& path) {
            const py::gil_scoped_release lock_released;
            save(b, path);
          },
          "path"_a);
  module.def("make_body", &body_of, "run"_a, "arguments"_a, "progress"_a, "threads"_a);
}

}  // namespace mesamis::python
