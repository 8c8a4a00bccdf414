// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <signal.h>

#include <atomic>

namespace mesamis {
namespace {

std::atomic<int> holders{0}, noted{0};
std::atomic<pid_t> child_to_kill{0};
static_assert(std::atomic<int>::is_always_lock_free);
static_assert(std::atomic<pid_t>::is_always_lock_free);

void kill_child() noexcept {
  if (const pid_t child = child_to_kill; child > 0) kill(child, SIGKILL);
}

}  // namespace

HeldInterrupts::HeldInterrupts() noexcept { ++holders; }
HeldInterrupts::~HeldInterrupts() { --holders; }

void check_interrupted() {
  if (noted != 0) throw Interrupted();
}

int noted_interrupt() noexcept { return noted; }

bool note_interrupt(int signal) noexcept {
  if (holders == 0) return false;
  noted = signal;
  kill_child();
  return true;
}

void set_child_to_kill(pid_t child) noexcept {
  child_to_kill = child;
  if (noted != 0) kill_child();  // the signal came first
}

}  // namespace mesamis
