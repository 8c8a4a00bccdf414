// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "mesamis/files/output_set.h"
#include "mesamis/page/run_page.h"
#include "mesamis/record/verdict.h"
#include "segment_labels.h"

/// What a run of `segment` leaves beside its shapes: report, page and pictures.
namespace mesamis {

/// A run that is done.
struct RunRecord {
  nlohmann::ordered_json found;       ///< what the report says of the run itself
  std::vector<std::string> warnings;  ///< beside those of the readers, one line each
  Verdict verdict;
  std::vector<PageSurface> surfaces;  ///< for the page
  const TetMesh* mesh = nullptr;      ///< for the page; nullptr: none
  std::span<const double> grey{};     ///< u at its nodes
};

/// Writes page, pictures and report, those that are asked for, as the last files of the set.
/// @throws InputError  as read_shown_scan(), write_page() and write_json().
void write_record(const SegmentRun& run, const ChosenScan& scan, const RunRecord& record,
                  const OutputSet& set);

}  // namespace mesamis
