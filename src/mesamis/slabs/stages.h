// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesamis/base/progress.h"
#include "mesamis/base/types.h"
#include "mesamis/slabs/scratch.h"
#include "mesamis/slabs/slab_work.h"
#include "mesamis/slabs/team.h"

namespace mesamis::detail::slabs {

/// Stages of a run: each process does its share of the tasks, unless they are done already.
class Stages {
 public:
  /// @param turns  in how many turns the tasks of a stage are to be done, at least 1.
  Stages(const Scratch& scratch, Team& team, const Progress& progress, Index turns)
      : scratch_(scratch), team_(team), progress_(progress), turns_(turns) {}

  /// Does task(0) to task(count - 1), neighbours in one process, and waits for the others. A
  /// process does count / turns of its tasks at a time, but one at least, in threads.
  void run(const std::string& name, Index count, const std::function<SlabWork(Index)>& task);
  /// The same with a task for each slab, or for each border between the slabs s and s + 1.
  void for_slabs(const std::string& name, Index slabs, const std::function<SlabWork(Index)>& task);
  void for_borders(const std::string& name, Index slabs,
                   const std::function<SlabWork(Index)>& task);
  /// What a task has done.
  SlabWork work_of(const std::string& name, Index n) const;
  /// What the tasks of each slab have done, those of the border above it included.
  std::vector<SlabWork> work_of_slabs(Index slabs) const;

 private:
  const Scratch& scratch_;
  Team& team_;
  const Progress& progress_;
  Index turns_;
  std::vector<std::string> of_slabs_, of_borders_;  // the stages so far
};

}  // namespace mesamis::detail::slabs
