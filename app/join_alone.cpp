// SPDX-License-Identifier: Apache-2.0
#include "join_team.h"

namespace mesamis {

std::unique_ptr<Team> join_team(int&, char**&) { return std::make_unique<Alone>(); }

int leave_team(Team&, int status) { return status; }

}  // namespace mesamis
