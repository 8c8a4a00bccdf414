// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "mesamis/comparison/surface_pair.h"

namespace mesamis {

/// Adds --frames. `rule` must outlive the parsing.
void add_frames_option(CLI::App& command, FrameRule& rule);

}  // namespace mesamis
