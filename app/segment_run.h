// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "segment_labels.h"
#include "segment_slabs.h"
#include "settings_options.h"

namespace mesamis {

/// Everything that a run of `segment` is asked for.
struct SegmentOptions : SegmentRun {
  SettingsArguments settings;
  SlabArguments slabs;
  std::optional<double> time_limit;  ///< s, from wall_seconds() 0
  bool plan = false;                 ///< only tell what the run needs
};

/// Runs `segment`: for its own command line, and for those who ask for it in another way.
/// @return the exit status.
/// @throws CLI::ValidationError, InputError, NumericalError  as the command.
int run_segment(SegmentOptions options, const CommonOptions& common);

}  // namespace mesamis
