// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study.h"

/// What a study leaves beside its surfaces: tables as CSV, diagrams as PNG.
namespace mesamis {

/// PREFIXruns.csv (Tables 1 and 2, Figure 6), PREFIXconvergence.csv (Figure 3) and
/// PREFIXhistogram.csv (Figure 7), as docs/formats.md describes them. A run that failed has empty
/// cells.
/// @throws InputError  if a file cannot be written.
void write_tables(const std::filesystem::path& folder, const std::string& prefix,
                  const std::vector<StudyRun>& runs);

/// PREFIXdistance.png, PREFIXhistogram.png, PREFIXenergy.png and PREFIXcells.png.
/// @return the names of those drawn. Where nothing can be drawn, a warning says why.
std::vector<std::string> draw_pictures(const std::filesystem::path& folder,
                                       const std::string& prefix,
                                       const std::vector<StudyRun>& runs);

/// The table for people, on stdout.
void print_table(const std::vector<StudyRun>& runs);

}  // namespace mesamis
