// SPDX-License-Identifier: Apache-2.0
// The targets of every reader. The bytes become a file of the format's name.
#include "reader_targets.h"

namespace mesamis {

std::span<const FuzzTarget> fuzz_targets() {
  static const std::vector<FuzzTarget> all = [] {
    std::vector<FuzzTarget> targets;
    for (const auto& some : {scan_targets(), label_targets(), shape_targets()}) {
      targets.insert(targets.end(), some.begin(), some.end());
    }
    return targets;
  }();
  return all;
}

/// Theirs are in dictionaries/.
std::vector<std::string> fuzz_words() { return {}; }

}  // namespace mesamis
