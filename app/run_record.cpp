// SPDX-License-Identifier: Apache-2.0
#include "run_record.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "costs.h"
#include "mesamis/record/report.h"
#include "page_options.h"

namespace mesamis {
namespace {

using nlohmann::ordered_json;

ordered_json report_of(const SegmentRun& run, const ChosenScan& scan, const RunRecord& record) {
  ordered_json report;
  report["program"] = program_json();
  ordered_json warnings = ordered_json::array();
  if (scan.facts) {
    report["input"] = input_json(*scan.facts);
    for (const std::string& line : scan.facts->warnings) warnings.push_back(line);
    for (const std::string& line : scan.object.warnings) warnings.push_back(line);
  }
  for (const std::string& line : scan.warnings) warnings.push_back(line);
  for (const std::string& line : record.warnings) warnings.push_back(line);
  report["command"] = run.command;
  report["output"] = output_json(run.scan.frame);
  if (!record.found.contains("object")) report["object"] = scan.report;
  report.update(record.found);
  if (scan.facts) report["object"].update(scan.report);
  report["warnings"] = std::move(warnings);
  report["verdict"] = {{"kept", record.verdict.outcome == Outcome::kKept},
                       {"message", record.verdict.message}};
  return report;
}

/// The page has what a reader of the report file would find.
void write_page_of(const SegmentRun& run, const ChosenScan& scan, const RunRecord& record,
                   const ordered_json& report) {
  const std::string sum = scan.facts ? scan.facts->sha256 : std::string();
  const auto shown = read_shown_scan({run.scan.input, run.scan.read, sum});
  const auto replace = ordered_json::error_handler_t::replace;
  RunPage page{nlohmann::json::parse(report.dump(-1, ' ', false, replace))};
  page.scan = shown ? &*shown : nullptr;
  page.surfaces = record.surfaces;
  page.mesh = record.mesh;
  page.grey = record.grey;
  page.names = run.page.names;
  write_page(run.page, page);
}

}  // namespace

void write_record(const SegmentRun& run, const ChosenScan& scan, const RunRecord& record,
                  const OutputSet& set) {
  ordered_json report = report_of(run, scan, record);
  if (run.page.given()) write_page_of(run, scan, record, report);
  if (run.report.empty() && !run.on_report) return;
  report["files"] = files_json(set);
  add_costs(report);
  deliver_report(run, report);
}

}  // namespace mesamis
