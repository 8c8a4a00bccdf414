// SPDX-License-Identifier: Apache-2.0
#include "deliver.h"

#include <nlohmann/json.hpp>

#include "costs.h"
#include "log.h"
#include "outputs.h"
#include "summary.h"

namespace mesamis {

RunFiles outputs_of(const SegmentOptions& options, const CommonOptions& common) {
  RunFiles out = options.out;
  out.frame = options.scan.frame;
  out.bodies = options.body.files;
  out.gmsh = options.body.gmsh == "4.1" ? GmshVersion::k41 : GmshVersion::k22;
  out.facts.command = common.arguments;
  out.facts.mask = options.scan.places.mask.string();
  out.facts.complete = [also = options.report_also](nlohmann::ordered_json& report) {
    add_costs(report);
    report.update(also);
  };
  return out;
}

int deliver(const OutcomeDetails& outcome, RunFiles outputs, OutputSet& set,
            ProgressDisplay& display) {
  display.begin("writing");
  const std::vector<std::string>& logged = warnings_logged();
  outputs.facts.warnings.insert(outputs.facts.warnings.end(), logged.begin(), logged.end());
  write(outcome, outputs, set);
  RunFigures figures = figures_of(outcome);
  figures.files = files_of(set);
  commit(set);
  display.finish();
  show_summary(figures);
  const Verdict& verdict = outcome.verdict;
  if (verdict.kind != VerdictKind::kKept) log_error(verdict.message);
  return exit_status(verdict.kind);
}

}  // namespace mesamis
