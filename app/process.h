// SPDX-License-Identifier: Apache-2.0
#pragma once

struct rusage;

namespace mesamis {

/// The most memory this process has held so far, MB (10^6 bytes).
double peak_memory_mb();

/// The most memory that a process has held, MB (10^6 bytes).
double peak_memory_mb(const rusage& usage);

/// The time that a process has computed, all threads together.
double cpu_seconds(const rusage& usage);

/// Seconds since the program started.
double wall_seconds();

}  // namespace mesamis
