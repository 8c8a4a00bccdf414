// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mesamis {

/// What a reader may take of the machine.
struct ReadLimits {
  /// Memory for what comes of a file, 10^9 bytes; 0: what is free, see available_memory().
  double memory_gb = 0;
  /// Whether a header (.nhdr, .mhd) may name a data file outside of the folder that it lies in.
  bool allow_outside = false;
};

}  // namespace mesamis
