// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "arrays.h"
#include "binding.h"
#include "call.h"
#include "mesamis/base/error.h"
#include "mesamis/label_files/write_labels.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/method/printable.h"
#include "mesamis/phantom/degrade.h"
#include "mesamis/phantom/phantom.h"
#include "mesamis/phantom/phantom_truth.h"
#include "mesamis/remesh/adapt_mesh.h"
#include "mesamis/report/comparison_json.h"
#include "mesamis/report/label_output.h"
#include "mesamis/report/remesh_json.h"
#include "mesamis/report/report.h"
#include "mesamis/report/verdict.h"
#include "mesamis/run/decimate_objects.h"
#include "mesamis/shape_files/surface_pair.h"
#include "mesamis/surface/comparison.h"
#include "request.h"
#include "run.h"

namespace mesamis::python {
namespace {

using namespace py::literals;
using Size = std::array<Index, 3>;

// ---- decimate

/// Objects with fewer triangles, a report of each, and what is to be warned of.
struct Decimated {
  std::vector<NamedSurface> objects;
  std::vector<std::string> reports, warnings;
};

std::string report_text(const NamedSurface& object, const PrintableReport& done, double tolerance) {
  nlohmann::ordered_json report = printable_json(done, tolerance);
  report.update(check_json(object.surface, check_surface(object.surface)));
  return json_text(report);
}

Decimated decimated(std::vector<NamedSurface> objects, const PrintableOptions& options) {
  const bool several = objects.size() > 1;
  const auto of = [several](const std::string& name) { return several ? name + ": " : ""; };
  for (const NamedSurface& object : objects) {
    const std::string flaws = flaws_of(check_surface(object.surface));
    if (flaws.empty()) continue;
    throw InputError("surface: " + of(object.name) +
                     "expected a closed 2-manifold surface, found " + flaws);
  }
  DecimatedObjects done = decimate_objects(std::move(objects), options);
  if (done.objects.empty()) {
    throw InputError("surface: expected a part of at least min_volume, found none");
  }
  Decimated result;
  for (const std::string& name : done.dropped) {
    result.warnings.push_back(name + ": no part of at least min_volume");
  }
  result.warnings.push_back(done.unmet);
  for (std::size_t n = 0; n < done.objects.size(); ++n) {
    const PrintableReport& report = done.reports[n];
    result.reports.push_back(report_text(done.objects[n], report, options.tolerance));
    if (report.within(options.tolerance)) continue;
    result.warnings.push_back(of(done.objects[n].name) +
                              tolerance_unmet(options.tolerance, report));
  }
  result.objects = std::move(done.objects);
  return result;
}

/// @param dicts  objects, LPS.
/// @return those that are left, a report of each, and warnings.
py::tuple decimate_dicts(const py::list& dicts, const py::dict& arguments,
                         const py::object& progress, int threads) {
  const Arguments wanted(arguments);
  std::vector<NamedSurface> objects = named_surfaces_of(dicts);
  PrintableOptions options;
  options.tolerance = wanted.get("tolerance", std::numeric_limits<double>::infinity());
  options.triangles = wanted.get<std::int64_t>("triangles");
  options.min_volume = wanted.get<double>("min_volume");
  options.keep_largest = wanted.get<std::int64_t>("keep_largest");
  options.fill_cavities = wanted.get<bool>("fill_cavities");
  Decimated done = released({progress, threads}, [&](const Progress& tell) {
    options.progress = tell;
    return decimated(std::move(objects), options);
  });
  return py::make_tuple(dicts_of(std::move(done.objects)), done.reports, done.warnings);
}

// ---- compare

/// A surface of Python in its frame: "lps", "ras", or none.
SurfaceFile surface_file(const Doubles& points, const Indices& triangles,
                         const std::string& frame) {
  SurfaceFile file{surface_of(points, triangles), std::nullopt};
  if (!frame.empty()) file.frame = frame_of(frame);
  return file;
}

FrameRule rule_of(const std::string& name) {
  if (name == "auto") return FrameRule::kAuto;
  if (name == "as-is") return FrameRule::kAsIs;
  if (name == "turned") return FrameRule::kTurned;
  throw InputError("frames: expected 'auto', 'as-is' or 'turned', found '" + name + "'");
}

/// A surface, its objects where it has several, and what messages call it.
struct ComparedSurface {
  SurfaceFile whole;
  PairedFile objects;
};

/// Of a dict of points, triangles, frame, objects and name.
ComparedSurface compared_surface(const py::dict& dict) {
  return {surface_file(dict["points"].cast<Doubles>(), dict["triangles"].cast<Indices>(),
                       dict["frame"].cast<std::string>()),
          {dict["name"].cast<std::string>(), named_surfaces_of(dict["objects"].cast<py::list>())}};
}

struct Compared {
  SurfacePair pair;
  std::vector<DirectedDistances> directions;
  std::vector<ObjectDistances> objects;
  std::string report;
};

Compared compared(const ComparedSurface& reference, const ComparedSurface& surface, FrameRule rule,
                  const std::optional<Box>& box) {
  Compared c{pair_up(reference.whole, surface.whole, rule, "surface"), {}, {}, ""};
  pair_objects(c.pair, reference.objects, surface.objects);
  c.directions = measure_both(c.pair, box);
  c.objects = measure_objects(c.pair, box);
  nlohmann::ordered_json report;
  report["frames"] = frames_json(c.pair);
  report["unit"] = "mm";
  for (const DirectedDistances& d : c.directions) report[d.name] = distances_json(d);
  report["paper"] = paper_distances_json(c.directions[1]);
  if (!c.objects.empty()) report["objects"] = objects_json(c.objects);
  c.report = json_text(report);
  return c;
}

/// The distances of the vertices in both directions.
py::tuple vertex_distances(std::vector<DirectedDistances>& directions) {
  return py::make_tuple(array_of<double>(std::move(directions[0].from_vertices)),
                        array_of<double>(std::move(directions[1].from_vertices)));
}

/// @return the report, the warnings, the distances of the vertices, and those of each object that
///         the report has.
py::tuple compare_surfaces(const std::pair<py::dict, py::dict>& surfaces, const std::string& frames,
                           const std::optional<std::array<double, 6>>& b, int threads) {
  const ComparedSurface first = compared_surface(surfaces.first);
  const ComparedSurface second = compared_surface(surfaces.second);
  std::optional<Box> box;
  if (b) box = Box{{(*b)[0], (*b)[1], (*b)[2]}, {(*b)[3], (*b)[4], (*b)[5]}};
  const FrameRule rule = rule_of(frames);
  Compared c = released({py::none(), threads},
                        [&](const Progress&) { return compared(first, second, rule, box); });
  py::list of_objects;
  for (ObjectDistances& o : c.objects) of_objects.append(vertex_distances(o.directions));
  return py::make_tuple(c.report, c.pair.warnings, vertex_distances(c.directions), of_objects);
}

// ---- remesh

py::tuple remesh_mesh(const Doubles& nodes, const Indices& tets, const Doubles& metric,
                      std::int64_t max_tets, const py::object& progress, int threads) {
  const TetMesh mesh{points_of(nodes, "nodes"), cells_of(tets, "tets")};
  const std::vector<Sym3> metrics = tensors_of(metric, "metric");
  if (mesh.points.empty() || mesh.cells.empty()) {
    throw InputError("mesh: expected nodes and tets, found none");
  }
  if (max_tets < 0)
    throw InputError("max_tets: expected 1 or more, found " + std::to_string(max_tets));
  AdaptedMesh done = released({progress, threads}, [&](const Progress& tell) {
    const std::string flaw = find_flaw(mesh, bounding_box(mesh.points));
    if (!flaw.empty()) throw InputError("mesh: not a mesh of its bounding box: " + flaw);
    if (metrics.size() != mesh.points.size()) {
      throw InputError("metric: expected " + std::to_string(mesh.points.size()) +
                       " metrics, one per node, found " + std::to_string(metrics.size()));
    }
    require_positive_definite(metrics);
    RemeshOptions options;
    options.max_cells = max_tets;
    options.progress = tell;
    return adapt_mesh(mesh, metrics, options);
  });
  nlohmann::ordered_json report;
  report["mesh"] = fit_json(done);
  report["remesh"] = remesh_json(done.report);
  report["converged"] = done.report.converged;
  return py::make_tuple(array_of<double>(std::move(done.mesh.points)),
                        array_of<Index>(std::move(done.mesh.cells)), json_text(report));
}

py::tuple box_of_cells(const Vector& low, const Vector& high, const Size& cells) {
  const Box box{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
  for (int a = 0; a < 3; ++a) {
    if (!(box.lo[a] < box.hi[a])) throw InputError("box: expected each low end below its high end");
    if (cells[static_cast<std::size_t>(a)] < 1) {
      throw InputError("cells: expected at least 1 along each axis");
    }
  }
  TetMesh mesh = box_mesh(box, cells);
  return py::make_tuple(array_of<double>(std::move(mesh.points)),
                        array_of<Index>(std::move(mesh.cells)));
}

// ---- phantom

std::shared_ptr<Scan> phantom_scan(const std::string& name, const Size& size, const Vector& spacing,
                                   const py::dict& arguments, int samples) {
  const Arguments wanted(arguments);
  DegradeOptions degrade_as;
  degrade_as.blur = wanted.get<double>("blur");
  degrade_as.noise = wanted.get<double>("noise");
  degrade_as.speckle = wanted.get<double>("speckle");
  degrade_as.salt_pepper = wanted.get<double>("salt_pepper");
  degrade_as.pepper = wanted.get<double>("pepper");
  degrade_as.salt = wanted.get<double>("salt");
  degrade_as.seed = wanted.get<std::uint64_t>("seed");
  const auto scan = scan_of(released({py::none(), 0}, [&](const Progress&) {
    require_valid(degrade_as);
    const Phantom phantom = make_phantom(name, size, vec(spacing));
    return degrade(sample_phantom(phantom, samples), degrade_as);
  }));
  scan->format = "phantom " + name;
  return scan;
}

py::tuple phantom_surface(const std::string& name, const Size& size, const Vector& spacing) {
  PhantomTruth truth = released({py::none(), 0}, [&](const Progress&) {
    return make_truth(make_phantom(name, size, vec(spacing)));
  });
  return py::make_tuple(array_of<double>(std::move(truth.surface.points)),
                        array_of<Index>(std::move(truth.surface.triangles)), truth.error.max);
}

py::list phantom_names() {
  py::list names;
  for (const PhantomInfo& info : phantom_list()) {
    names.append(py::make_tuple(info.name, info.description, info.size));
  }
  return names;
}

// ---- label

using NamedParts = std::vector<std::tuple<std::string, Doubles, Indices>>;

/// Writes surfaces as a label map on the grid of a scan.
/// @param parts  names, points (LPS, mm) and triangles.
/// @return label, name and voxels of each, and the warnings.
py::tuple write_labels(const NamedParts& parts, const std::shared_ptr<Scan>& scan,
                       const std::string& path) {
  std::vector<TriMesh> surfaces;
  for (const auto& [name, points, triangles] : parts) {
    surfaces.push_back(surface_of(points, triangles));
    if (check_surface(surfaces.back()).closed()) continue;
    throw InputError("surface: expected a closed one, found '" + name + "' open");
  }
  std::vector<FoundObject> objects;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const auto label = static_cast<Index>(n + 1);
    objects.push_back({surfaces[n], {std::get<0>(parts[n]), label, 0, default_colour(label)}});
  }
  SurfaceLabels labels;
  {
    const py::gil_scoped_release lock_released;
    labels = labels_of_surfaces(scan->view, objects);
    write_label_map(path, labels.map);
  }
  const std::vector<std::size_t> counts = voxel_counts(labels.map);
  py::list rows;
  for (std::size_t n = 0; n < counts.size(); ++n) {
    const Segment& segment = labels.map.segments[n];
    rows.append(py::make_tuple(segment.label, segment.name, counts[n]));
  }
  return py::make_tuple(rows, labels.warnings);
}

}  // namespace

void bind_tools(py::module_& module) {
  module.def("require_frame", [](const std::string& name) { frame_of(name); });
  module.def("decimate", &decimate_dicts, "objects"_a, "wanted"_a, "progress"_a, "threads"_a);
  module.def("label", &write_labels, "parts"_a, "scan"_a, "path"_a);
  module.def("compare", &compare_surfaces, "surfaces"_a, "frames"_a, "box"_a, "threads"_a);
  module.def("remesh", &remesh_mesh, "nodes"_a, "tets"_a, "metric"_a, "max_tets"_a, "progress"_a,
             "threads"_a);
  module.def("box_mesh", &box_of_cells, "low"_a, "high"_a, "cells"_a);
  module.def("phantom", &phantom_scan, "name"_a, "size"_a, "spacing"_a, "wanted"_a, "samples"_a);
  module.def("phantom_surface", &phantom_surface, "name"_a, "size"_a, "spacing"_a);
  module.def("phantoms", &phantom_names);
}

}  // namespace mesamis::python
