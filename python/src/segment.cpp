// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "binding.h"
#include "mesamis/base/error.h"
#include "mesamis/delivery/label_output.h"
#include "mesamis/label_files/label_table.h"
#include "mesamis/method/memory.h"
#include "mesamis/record/label_report.h"
#include "mesamis/record/object_report.h"
#include "mesamis/record/verdict.h"
#include "request.h"
#include "run.h"

namespace mesamis::python {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void append(std::vector<std::string>& to, const std::vector<std::string>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// A scan that nobody else has: its samples may be taken.
struct GivenScan {
  std::shared_ptr<Scan> scan;
  bool ours = false;
};

/// Chooses the object: in place where the samples stay as they are.
void choose(RunFacts& run, const GivenScan& given, const Request& request) {
  Scan& scan = *given.scan;
  run.scan = given.scan;
  if (scan.spent) throw InputError("volume: its samples were given away");
  require_usable(scan.view);
  run.input = scan.facts();
  run.warnings = scan.warnings;
  const ObjectRequest wanted = object_request(request, scan.view, run.warnings);
  Settings with_crop = request.settings;
  with_crop.crop = wanted.crop;
  if (!request.wants_labels()) require_memory(scan.view, with_crop, request.memory_gb);
  run.object = choose_in_place(scan.view, wanted);
  if (!run.object && given.ours && !scan.own.samples.empty()) {
    scan.spent = true;
    scan.view.samples = {};
    run.object = choose_object(std::move(scan.own), wanted);
  } else if (!run.object) {
    run.object = choose_object(copy_volume(scan.view), wanted);
  }
  append(run.notes, run.object->notes);
  append(run.warnings, run.object->warnings);
  run.chosen = object_json(wanted, *run.object);
  if (wanted.mask) {
    const std::string& path = request.mask->path;
    run.chosen["mask"]["path"] = path.empty() ? nlohmann::json() : nlohmann::json(path);
  }
}

void start(RunFacts& run, const Request& request, int threads) {
  run.settings = request.settings;
  run.frame = request.frame;
  run.threads = threads;
}

std::shared_ptr<Run> run_one(std::shared_ptr<Run> run, const Request& request,
                             const Progress& progress, Clock::time_point begin) {
  HasEnough enough;
  if (request.time_limit) {
    enough = [begin, limit = *request.time_limit] { return seconds_since(begin) >= limit; };
  }
  run->result =
      run_on_object(ObjectInPlace{*run->object, run->image()}, request.settings, progress, enough);
  const Parameters& p = run->result.parameters;
  if (p.surface == SurfaceKind::kSolid) {
    append(run->warnings, surface_warnings(*run->object, run->image(), p.level));
  }
  run->check = check_surface(run->result.surface);
  run->flaw = judge(run->result, run->check).message;
  run->seconds = seconds_since(begin);
  return run;
}

void finish(LabelRun& run, const std::vector<Segment>& wanted, Clock::time_point begin) {
  run.wanted = wanted.size();
  append(run.warnings, missing_objects(run.result, wanted));
  for (const LabelledObject& object : run.result.objects) {
    run.checks.push_back(check_surface(object.surface));
  }
  run.flaw = judge(run.result, run.checks).message;
  run.seconds = seconds_since(begin);
}

/// @param scan  whose grid labels may need; may be null.
LabelMap read_labels(const Request& request, const Scan* scan, std::vector<std::string>& warnings) {
  LabelOptions how{.limits = {.memory_gb = request.memory_gb}};
  if (scan != nullptr) how = label_options(request, scan->view);
  LabelMap map = labels_of(*request.labels, how, warnings);
  if (!request.names_file.empty()) {
    map = with_names(std::move(map), read_label_table(request.names_file));
  }
  for (const auto& [label, name] : request.names) {
    for (Segment& segment : map.segments) {
      if (segment.label == label || segment.number_in_file == label) segment.name = name;
    }
  }
  require_valid(map);
  return map;
}

std::shared_ptr<LabelRun> run_labels(const GivenScan& given, const Request& request,
                                     const Progress& progress, int threads) {
  const auto begin = Clock::now();
  const auto run = std::make_shared<LabelRun>();
  start(*run, request, threads);
  std::vector<std::string> warnings;
  const LabelMap labels = read_labels(request, given.scan.get(), warnings);
  LabelRequest wanted{labels};
  wanted.mesh = request.mesh;
  wanted.margin = request.margin;
  for (const std::string& name : request.chosen) {
    const Segment segment = find_segment(labels.segments, name);
    const auto end = wanted.chosen.end();
    if (std::find(wanted.chosen.begin(), end, segment) == end) wanted.chosen.push_back(segment);
  }
  if (given.scan) {
    choose(*run, given, request);
    run->grid = given.scan->view;
    run->result = run_on_labels(ObjectInPlace{*run->object, run->image()}, wanted, request.settings,
                                progress);
  } else {
    if (request.mesh) throw InputError("mesh: expected a scan beside the labels, found none");
    run->grid = labels;
    run->result = surfaces_of_labels(wanted, request.settings, progress);
  }
  run->warnings.insert(run->warnings.begin(), warnings.begin(), warnings.end());
  finish(*run, wanted.chosen.empty() ? labels.segments : wanted.chosen, begin);
  return run;
}

/// The parts that several seeds split an object into.
std::shared_ptr<LabelRun> run_parts(RunFacts one, const Request& request, const Progress& progress,
                                    Clock::time_point begin) {
  const auto run = std::make_shared<LabelRun>();
  static_cast<RunFacts&>(*run) = std::move(one);
  run->grid = run->object->volume;
  const LabelMap& parts = *run->object->parts;
  run->result = run_on_labels(ObjectInPlace{*run->object, run->image()},
                              {.map = parts, .mesh = request.mesh}, request.settings, progress);
  finish(*run, parts.segments, begin);
  return run;
}

struct Outcome {
  std::shared_ptr<Run> one;
  std::shared_ptr<LabelRun> several;
};

Outcome run_any(const GivenScan& given, const Request& request, const Progress& progress,
                int threads) {
  if (request.wants_labels()) return {nullptr, run_labels(given, request, progress, threads)};
  if (!given.scan)
    throw InputError("volume: expected a scan, or labels without one; found neither");
  const auto begin = Clock::now();
  auto run = std::make_shared<Run>();
  start(*run, request, threads);
  choose(*run, given, request);
  if (run->object->parts) return {nullptr, run_parts(std::move(*run), request, progress, begin)};
  return {run_one(std::move(run), request, progress, begin), nullptr};
}

/// @param ours  nobody else has the scan.
py::object segment(const std::shared_ptr<Scan>& scan, bool ours, const py::dict& arguments,
                   const py::object& progress, int threads) {
  const Request request = request_of(Arguments(arguments));
  if (request.time_limit && (request.wants_labels() || request.seeds.size() > 1)) {
    throw InputError("time_limit: expected a run for one object, found several");
  }
  const Outcome outcome = released({progress, threads}, [&](const Progress& tell) {
    return run_any({scan, ours}, request, tell, threads);
  });
  return outcome.one ? py::cast(outcome.one) : py::cast(outcome.several);
}

}  // namespace

void bind_segment(py::module_& module) {
  using namespace py::literals;
  module.def("segment", &segment, "scan"_a, "ours"_a, "arguments"_a, "progress"_a, "threads"_a);
}

}  // namespace mesamis::python
