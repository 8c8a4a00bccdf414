// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands.h"
#include "mesamis/files/output_set.h"
#include "mesamis/run/run_files.h"
#include "progress.h"
#include "segment_run.h"

namespace mesamis {

/// What the options say of the files of a run, with its command line and its costs in the report.
RunFiles outputs_of(const SegmentOptions& options, const CommonOptions& common);

/// Writes the files of a run, shows its figures, and logs what it has missed.
/// @param set      of this thread; what is in it already appears with the files.
/// @param display  learns that files are written.
/// @return the exit status.
/// @throws InputError  as write() and OutputSet::commit().
int deliver(const OutcomeDetails& outcome, RunFiles outputs, OutputSet& set,
            ProgressDisplay& display);

}  // namespace mesamis
