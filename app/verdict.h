// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mesamis/mes_amis.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// Whether a run kept what it promised.
struct Verdict {
  int status = 0;       ///< kExitDone, kExitNotConverged or kExitNotClosed
  std::string message;  ///< what was expected and found, on one line; empty: all is well
};

/// @param check  of the result's surface.
Verdict judge(const Result& result, const SurfaceCheck& check);

}  // namespace mesamis
