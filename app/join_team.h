// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "mesamis/slabs/team.h"

/// The processes that run the program together: `mesamis` is alone, `mesamis-mpi` is not.
namespace mesamis {

/// Joins the others that were started with this one.
/// @param count, arguments  as main() has them.
std::unique_ptr<Team> join_team(int& count, char**& arguments);

/// Ends this process's part. Where it has failed, the others end too, at once.
/// @return the exit status.
int leave_team(Team& team, int status);

}  // namespace mesamis
