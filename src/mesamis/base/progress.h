// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace mesamis {

/// Called at times by a long computation with the name of its stage and the share of the stage that
/// is done, 0 to 1. If it returns false, the computation stops, throws Cancelled and leaves nothing
/// behind. It may be called from other threads than the computation was, but by one at a time.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// Asked between the passes of a run, never inside one. If it returns true, the run makes a whole
/// result of the passes it has made, and says that it was stopped.
using HasEnough = std::function<bool()>;

}  // namespace mesamis
