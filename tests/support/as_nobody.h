// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <cstdlib>

namespace mesamis {

/// For tests of forbidden files: nothing is forbidden to the superuser, so the tests run as
/// somebody else while this lives. Files that are made meanwhile are that user's.
class AsNobody {
 public:
  AsNobody() : before_(geteuid()) {
    constexpr uid_t kNobody = 65534;
    if (before_ == 0) changed_ = seteuid(kNobody) == 0;
  }
  ~AsNobody() {
    if (changed_ && seteuid(before_) != 0) std::abort();
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  uid_t before_;
  bool changed_ = false;
};

}  // namespace mesamis
