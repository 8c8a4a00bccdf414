// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/segment.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "binding.h"
#include "mesamis/base/error.h"
#include "mesamis/label_files/label_table.h"
#include "mesamis/method/memory.h"
#include "mesamis/run/run_share.h"
#include "request.h"
#include "run.h"

namespace mesamis::python {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A scan that nobody else has: its samples may be taken.
struct GivenScan {
  std::shared_ptr<Scan> scan;
  bool ours = false;
};

/// @param scan  whose grid labels may need; may be null.
LabelChoice label_choice(const CallRequest& call, const Scan* scan,
                         std::vector<std::string>& warnings) {
  const LabelOptions how = label_options(call, scan != nullptr ? &scan->view : nullptr);
  LabelMap map = labels_of(*call.labels, how, warnings);
  if (!call.names_file.empty()) map = with_names(std::move(map), read_label_table(call.names_file));
  for (const auto& [label, name] : call.names) {
    for (Segment& segment : map.segments) {
      if (segment.label == label || segment.number_in_file == label) segment.name = name;
    }
  }
  require_valid(map);
  LabelChoice choice{std::move(map)};
  choice.margin = call.margin;
  choice.chosen = find_segments(choice.map.segments, call.chosen);
  return choice;
}

/// What is asked of the scan; learns what a report says of it.
void take_scan(const GivenScan& given, const CallRequest& call, Request& request, Run& run) {
  Scan& scan = *given.scan;
  if (scan.spent) throw InputError("volume: its samples were given away");
  require_usable(scan.view);
  run.scan = given.scan;
  run.facts.input = scan.facts();
  request.object = object_request(call, scan.view, run.facts.warnings);
  Settings with_crop = call.settings;
  if (!(request.object.crop == CropRange{})) with_crop.crop = request.object.crop;
  if (!call.wants_labels()) require_memory(scan.view, with_crop, call.memory_gb);
  if (call.mask) run.facts.mask = call.mask->path;
  if (given.ours && !scan.own.samples.empty()) {
    scan.spent = true;
    scan.view.samples = {};
    request.scan = std::move(scan.own);
  } else {
    request.scan = scan.view;
  }
}

std::shared_ptr<Run> run_segment(const GivenScan& given, const CallRequest& call,
                                 const Progress& progress, int threads) {
  const auto begin = Clock::now();
  const auto run = std::make_shared<Run>();
  run->frame = call.frame;
  run->threads = threads;
  Request request;
  request.settings = call.settings;
  request.mesh = call.mesh;
  if (call.wants_labels()) {
    request.labels = label_choice(call, given.scan.get(), run->facts.warnings);
  } else if (!given.scan) {
    throw InputError("volume: expected a scan, or labels without one; found neither");
  }
  if (given.scan) take_scan(given, call, request, *run);
  if (call.time_limit) {
    request.enough = [begin, limit = *call.time_limit] { return seconds_since(begin) >= limit; };
  }
  run->outcome = mesamis::segment(std::move(request), {.progress = progress});
  run->seconds = seconds_since(begin);
  return run;
}

/// @param ours  nobody else has the scan.
std::shared_ptr<Run> segment(const std::shared_ptr<Scan>& scan, bool ours,
                             const py::dict& arguments, const py::object& progress, int threads) {
  const CallRequest call = request_of(Arguments(arguments));
  if (call.time_limit && (call.wants_labels() || call.seeds.size() > 1)) {
    throw InputError("time_limit: expected a run for one object, found several");
  }
  return released({progress, threads}, [&](const Progress& tell) {
    return run_segment({scan, ours}, call, tell, threads);
  });
}

}  // namespace

void bind_segment(py::module_& module) {
  using namespace py::literals;
  py::class_<RunShare>(module, "RunShare")
      .def(py::init([](bool labels, bool scan, bool preview, bool mesh) {
             return RunShare(
                 stage_shares({.labels = labels, .scan = scan, .preview = preview, .mesh = mesh}));
           }),
           "labels"_a, "scan"_a, "preview"_a, "mesh"_a)
      .def("done", &RunShare::done, "stage"_a, "fraction"_a);
  module.def("segment", &segment, "scan"_a, "ours"_a, "arguments"_a, "progress"_a, "threads"_a);
}

}  // namespace mesamis::python
