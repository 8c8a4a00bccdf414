// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace mesamis {

/// A long computation calls this from time to time with the name of its stage and the fraction of
/// the stage that is done, 0 to 1. If it returns false, the computation stops, throws Cancelled and
/// leaves nothing behind. Calls may come from other threads, one at a time.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// A run calls this between passes. If it returns true, the run finishes with the passes made so
/// far and reports that it was stopped.
using HasEnough = std::function<bool()>;

}  // namespace mesamis
