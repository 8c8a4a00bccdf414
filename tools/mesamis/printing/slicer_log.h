// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "mesamis/rooms.h"

namespace mesamis::detail::printing {

/// Text on one line: control characters become blanks, blanks at the end are removed.
std::string one_log_line(std::string_view text);

/// The reason that a program states for its failure, on one line.
///
/// @param output  what it wrote to stdout and stderr.
/// @return its first line that calls itself an error, else its last two lines that are neither
///         progress nor warnings; empty if there are none. At most 200 characters.
std::string failure_line(std::string_view output);

}  // namespace mesamis::detail::printing
