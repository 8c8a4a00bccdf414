// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace mesamis {

/// Called now and then by long work: a stage's name and the share of it that is done, 0 to 1.
/// Returning false asks the work to stop; it then throws Cancelled and leaves nothing behind.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

}  // namespace mesamis
