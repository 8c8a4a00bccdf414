// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "mesamis/study/study_run.h"

/// The tables of a study as CSV, in the columns that docs/formats.md describes. Numbers have the
/// digits of study.json. A figure that a run does not have is an empty cell.
namespace mesamis::detail::study {

/// Tables 1 and 2 and Figure 6 of the paper: a row per run.
/// @return the names of the columns, then the rows; lengths in mm.
std::string runs_csv(std::span<const StudyRun> runs);

/// Figure 3 of the paper: a row per run and iteration, counted from 1.
/// @return the names of the columns, then the rows; energies in grey value^2 times length unit^3.
std::string convergence_csv(std::span<const StudyRun> runs);

/// Figure 7 of the paper: the distances from the reference, as histogram_of() counts them.
/// @return a row per bin, mm; two columns per run that has distances.
///
/// O(n) for n distances.
std::string histogram_csv(std::span<const StudyRun> runs);

/// Writes the tables to PREFIXruns.csv, PREFIXconvergence.csv and PREFIXhistogram.csv. Each file
/// appears whole or not at all.
/// @param folder  must exist.
/// @throws InputError  if a file cannot be written. Cost as histogram_csv().
void write_tables(const std::filesystem::path& folder, const std::string& prefix,
                  std::span<const StudyRun> runs);

}  // namespace mesamis::detail::study
