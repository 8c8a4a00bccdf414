// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "commands.h"

namespace mesamis {

/// Runs an action and turns every failure into one line of the log and an exit status.
/// @param where  what the action works on; a message that does not name it begins with it.
int run_action(const Action& action, const std::string& where = "");

}  // namespace mesamis
