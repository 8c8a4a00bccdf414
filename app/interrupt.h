// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>

/// SIGINT, SIGTERM and SIGHUP during work that a signal handler cannot undo.
namespace mesamis {

/// Leaves the work that was interrupted; the program then ends by the signal.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// While one lives, an interrupt is noted and the program continues, see noted_interrupt().
class HeldInterrupts {
 public:
  HeldInterrupts() noexcept;
  ~HeldInterrupts();
  HeldInterrupts(const HeldInterrupts&) = delete;
  HeldInterrupts& operator=(const HeldInterrupts&) = delete;
};

/// The signal that came while they were held; 0: none.
int noted_interrupt() noexcept;

/// For the signal handler: notes the signal if interrupts are held.
/// @return whether they are.
bool note_interrupt(int signal) noexcept;

}  // namespace mesamis
