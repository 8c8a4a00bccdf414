// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "mesamis/base/progress.h"
#include "mesamis/base/types.h"
#include "mesamis/slabs/scratch.h"
#include "mesamis/slabs/slab_work.h"
#include "mesamis/slabs/team.h"

namespace mesamis::detail {

/// Stages of a run: each process does its share of the tasks, unless they are done already.
class Stages {
 public:
  /// @param turns  in how many turns the tasks of a stage are to be done, at least 1.
  Stages(const Scratch& scratch, Team& team, const Progress& progress, Index turns)
      : scratch_(scratch), team_(team), progress_(progress), turns_(turns) {}

  /// Does task(0) to task(count - 1), neighbours in one process, and waits for the others. A
  /// process does count / turns of its tasks at a time, but one at least, in threads.
  void run(const std::string& name, Index count, const std::function<SlabWork(Index)>& task);
  /// What a task has done.
  SlabWork work_of(const std::string& name, Index n) const;

 private:
  const Scratch& scratch_;
  Team& team_;
  const Progress& progress_;
  Index turns_;
};

}  // namespace mesamis::detail
