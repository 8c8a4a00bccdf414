// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "mesamis/rooms.h"

namespace mesamis::detail::page {

/// Bytes as base64 (RFC 4648) with padding, on one line.
std::string base64(std::string_view bytes);

}  // namespace mesamis::detail::page
