// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mesamis/picture/plot.h"
#include "mesamis/study/study_run.h"

/// The diagrams of a study.
namespace mesamis::detail::study {

/// A diagram that plot_svg() draws.
struct Diagram {
  std::string name;  ///< of its file, without the prefix of the experiment
  std::vector<PlotSeries> series;
  PlotOptions options;
};

/// Makes the diagrams of the runs of one experiment:
///
///   distance.svg   mean distances in mm over s, of the runs that are compared and no baseline
///   histogram.svg  share of the reference's vertices in each bin of distances, percent over mm
///   energy.svg     energy after each minimisation, grey value^2 mm^3, a curve per run
///   cells.svg      tetrahedra of the mesh of each minimisation, a curve per run
///
/// @return those that have a point.  O(n) for n distances.
std::vector<Diagram> study_diagrams(std::span<const StudyRun> runs);

/// Draws the diagrams into files PREFIXNAME. Each file appears whole or not at all.
/// @param folder  must exist.
/// @return the names of the files.
/// @throws InputError  if a file cannot be written. Cost as study_diagrams().
std::vector<std::string> draw_diagrams(const std::filesystem::path& folder,
                                       const std::string& prefix, std::span<const StudyRun> runs);

}  // namespace mesamis::detail::study
