// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mesamis/method/settings.h"
#include "mesamis/slabs/scratch.h"
#include "mesamis/slabs/team.h"

/// Which run a folder of scratch files belongs to.
namespace mesamis::detail::slabs {

/// The version of this program and all settings, on one line.
std::string description_of(const Settings& settings);

/// Writes the description of a run into its folder, or compares it with the one that is there:
/// files of another run would be taken for its own. Returns when all of the team have called it.
/// @throws InputError  if the folder is another run's.
void require_same_run(const Scratch& scratch, const std::string& description, Team& team);

}  // namespace mesamis::detail::slabs
