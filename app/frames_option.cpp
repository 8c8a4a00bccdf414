// SPDX-License-Identifier: Apache-2.0
#include "frames_option.h"

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace mesamis {

void add_frames_option(CLI::App& command, FrameRule& rule) {
  const std::map<std::string, FrameRule> rules{
      {"auto", FrameRule::kAuto}, {"as-is", FrameRule::kAsIs}, {"turned", FrameRule::kTurned}};
  command
      .add_option("--frames", rule,
                  "auto: as the files state, refused if they fit only after a flip; as-is: "
                  "coordinates as they are; turned: the surface's x and y negated")
      ->transform(CLI::CheckedTransformer(rules));
}

}  // namespace mesamis
