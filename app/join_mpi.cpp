// SPDX-License-Identifier: Apache-2.0
#include "commands.h"
#include "join_team.h"
#include "mesamis/parallel/mpi_team.h"

namespace mesamis {

std::unique_ptr<Team> join_team(int& count, char**& arguments) {
  return std::make_unique<MpiTeam>(count, arguments);
}

int leave_team(Team& team, int status) {
  // A result that is not all that was promised is one: only a process without any ends the others.
  const bool failed =
      status != kExitDone && status != kExitNotConverged && status != kExitNotClosed;
  if (failed) static_cast<MpiTeam&>(team).end_all(status);
  return status;
}

}  // namespace mesamis
