// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <locale>
#include <sstream>
#include <string>

#include "mesamis/rooms.h"

namespace mesamis::detail::base {

/// Joins the parts of a message, numbers as an ostream writes them in the C locale.
template <class... Part>
std::string message(const Part&... parts) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  (out << ... << parts);
  return std::move(out).str();
}

}  // namespace mesamis::detail::base
