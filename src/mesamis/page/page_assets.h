// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "mesamis/rooms.h"

/// Files that are part of the program: the page's style and its script, which holds the viewer.
namespace mesamis::detail::page {

std::string_view page_style();
std::string_view page_script();

}  // namespace mesamis::detail::page
