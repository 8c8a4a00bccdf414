// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What the program was started with: its standard streams and its limits.
namespace mesamis {

/// Opens those of the descriptors 0 to 2 that are closed, so that no file of ours becomes one of
/// them. What is written to stdout then fails, as it should; what goes to stderr is lost.
void open_closed_streams();

/// Lets the program hold as many files open as the system allows: a run may write hundreds. A file
/// that grows beyond the limit of its size is an error and no end by a signal.
void lift_limits();

/// Writes what is left in the buffers of stdout.
/// @return  0; errno if not all that was printed has been written.
int flush_stdout();

}  // namespace mesamis
