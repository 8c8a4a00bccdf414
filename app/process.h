// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mesamis {

/// The most memory this process has held so far, MB (10^6 bytes).
double peak_memory_mb();

/// Seconds since the program started.
double wall_seconds();

}  // namespace mesamis
