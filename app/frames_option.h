// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/shape_files/surface_pair.h"

namespace CLI {
class App;
}  // namespace CLI

namespace mesamis {

/// Adds --frames. `rule` must outlive the parsing.
void add_frames_option(CLI::App& command, FrameRule& rule);

}  // namespace mesamis
