// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/rooms.h"

namespace mesamis::detail::slabs {

/// The processes that work on one run, each of them on its share of the tasks. They see the same
/// folder of scratch files.
class Team {
 public:
  virtual ~Team() = default;

  /// How many there are, at least 1.
  virtual int size() const noexcept = 0;
  /// Which of them this one is, 0 to size() - 1.
  virtual int rank() const noexcept = 0;
  /// Returns when all have called it as often as this one.
  /// @throws what the way to the others throws where one of them is gone.
  virtual void wait_for_all() = 0;
};

/// A process on its own.
class Alone : public Team {
 public:
  int size() const noexcept override { return 1; }
  int rank() const noexcept override { return 0; }
  void wait_for_all() override {}
};

/// The team of a process that was started on its own.
inline Team& alone() noexcept {
  static Alone team;
  return team;
}

}  // namespace mesamis::detail::slabs
