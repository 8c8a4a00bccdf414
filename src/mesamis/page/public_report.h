// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "mesamis/rooms.h"

/// What of a report may be shown to anyone.
namespace mesamis::detail::page {

/// A report without what differs from run to run: times, memory, threads. Without names also no
/// path and no file name, which may hold a patient's name: of a file the extension stays. Warnings
/// of readers, which may hold file names and free text of the scan, are counted instead; a message
/// of the verdict with a path or a quoted name is replaced.
/// @param report  of any shape; what is no object becomes an empty one.
/// @param names   keep paths, file names and all messages.
nlohmann::json public_report(nlohmann::json report, bool names);

/// The command that repeats the run of a report, quoted for a shell. Without names the scan is
/// SCAN, and files and what else users name freely are called by their options. Options that do not
/// change the results are left out.
/// @param names  keep all words.
std::string repeat_command(const nlohmann::json& report, bool names);

}  // namespace mesamis::detail::page
