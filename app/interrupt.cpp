// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <atomic>

namespace mesamis {
namespace {

std::atomic<int> holders{0}, noted_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

}  // namespace

HeldInterrupts::HeldInterrupts() noexcept { ++holders; }
HeldInterrupts::~HeldInterrupts() { --holders; }

int noted_interrupt() noexcept { return noted_signal; }

bool note_interrupt(int signal) noexcept {
  if (holders == 0) return false;
  noted_signal = signal;
  return true;
}

}  // namespace mesamis
