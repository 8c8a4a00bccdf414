// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "commands.h"

/// Messages of the program on stderr, one line each.
namespace mesamis {

/// Call once, before anything is logged. With --quiet only errors appear.
void set_up_log(const CommonOptions& options);

void log_info(const std::string& message);
void log_warning(const std::string& message);
void log_error(const std::string& message);

/// Whether a progress bar may be drawn: stderr is a terminal and its lines are for people.
bool log_allows_bar();

/// Wipes a progress bar off the current line of the terminal.
inline constexpr const char* kWipeLine = "\r\033[K";

}  // namespace mesamis
