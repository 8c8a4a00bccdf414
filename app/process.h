// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mesamis {

/// The most memory this process has held so far, MB (10^6 bytes).
double peak_memory_mb();

/// Seconds since the program started, or since the clock was set back.
double wall_seconds();

/// Sets the clock of wall_seconds() to 0: what follows is a run of its own.
void restart_clock();

}  // namespace mesamis
