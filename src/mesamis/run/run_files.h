// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/files/output_set.h"
#include "mesamis/image/volume.h"
#include "mesamis/report/report.h"
#include "mesamis/run/write.h"

/// The files of a run as programs write them: with what reports say beside the outcome.
namespace mesamis::detail::run {

/// What a report says beside the outcome.
struct ReportFacts {
  std::optional<InputFacts> input{};    ///< of the scan; none: it has no entry "input"
  std::vector<std::string> warnings{};  ///< of the readers of label files, one line each
  std::vector<std::string> command{};   ///< the command line; empty: no entry
  std::string mask{};                   ///< the file of the mask; empty: none
  /// Adds entries at the end, before the report is written. May be empty.
  std::function<void(nlohmann::ordered_json& report)> complete{};
  /// Sees the report, and may write files of the set. May be empty.
  std::function<void(const nlohmann::ordered_json& report, OutputSet& set)> written{};
};

/// The files of a run, and what is known of it beside its outcome.
struct RunFiles : Outputs {
  ReportFacts facts{};
  std::function<std::optional<Volume>()> shown_scan{};  ///< of the page, as it is in its file

  /// Whether anything shows the report.
  bool wants_report() const { return !report.empty() || facts.written || page.given(); }
};

/// The report of a run without the entry "files", as docs/formats.md describes it.
nlohmann::ordered_json report_json(const OutcomeDetails& outcome, const RunFiles& files);

/// Writes the files of a run into a set that the caller commits.
/// @param set  empty.
/// @throws InputError  as write().
void write(const OutcomeDetails& outcome, const RunFiles& files, OutputSet& set);

/// The same, of which all files appear together or not at all.
/// @throws InputError  as write().
void write(const OutcomeDetails& outcome, const RunFiles& files);

}  // namespace mesamis::detail::run
