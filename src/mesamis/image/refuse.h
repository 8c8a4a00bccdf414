// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>

#include "mesamis/base/error.h"

namespace mesamis::detail {

/// Throws an InputError of the parts joined, numbers as an ostream writes them.
template <class... Part>
[[noreturn]] void refuse(const Part&... parts) {
  std::ostringstream line;
  (line << ... << parts);
  throw InputError(line.str());
}

}  // namespace mesamis::detail
