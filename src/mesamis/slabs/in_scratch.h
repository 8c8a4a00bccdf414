// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mesamis/base/stopwatch.h"
#include "mesamis/slabs/run_in_slabs.h"
#include "mesamis/slabs/same_run.h"
#include "mesamis/slabs/scratch.h"

namespace mesamis::detail::slabs {

/// Runs something in the scratch folder of a run, and clears or keeps the folder afterwards: after an
/// error it is kept if the run may go on there.
/// @param description  of the run, see require_same_run(). The folder of another run stays as it is.
/// @param run          called with the folder; returns an optional result, which rank 0 alone has.
/// @return what it returned, with the seconds of the whole.
/// @throws InputError  if the folder cannot be made, or is another run's; and what run() throws.
template <class Run>
auto run_in_scratch(const SlabRunOptions& options, const std::string& description, Team& team,
                    Run&& run) {
  Stopwatch watch;
  const Scratch scratch(options.scratch);
  require_same_run(scratch, description, team);
  decltype(run(scratch)) found;
  try {
    found = run(scratch);
  } catch (...) {
    if (!options.resumable) scratch.clear();
    throw;
  }
  if (!found) return found;
  found->result.seconds.total = watch.lap();
  if (!options.keep_scratch) scratch.clear();
  return found;
}

}  // namespace mesamis::detail::slabs
