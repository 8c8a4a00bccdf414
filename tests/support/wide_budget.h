// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/files/memory_budget.h"

namespace mesamis {

/// A gigabyte: more than any file of a test needs.
struct WideBudget : MemoryBudget {
  WideBudget() : MemoryBudget("a file", {1}) {}
};

}  // namespace mesamis
