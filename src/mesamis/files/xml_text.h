// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "mesamis/rooms.h"

namespace mesamis::detail::files {

/// Escapes a text for an XML element or attribute, in UTF-8. '?' replaces each byte that XML does
/// not allow: control characters other than tab and line ends, and bytes that are not UTF-8.
std::string xml_escaped(std::string_view text);

}  // namespace mesamis::detail::files
