// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "mesamis/surface/tri_mesh.h"
#include "slicers.h"

namespace mesamis {

/// What a surface must be before it is sliced: a slicer makes a hollow or truncated print of what
/// is not, and does not complain.
struct PrintGate {
  SurfaceCheck check;
  std::size_t self_intersections = 0;  ///< pairs of triangles; slicers unite what overlaps
  std::optional<PrusaInfo> prusa{};    ///< PrusaSlicer's opinion, where it is installed
};

/// mesamis's part of the gate.
PrintGate check_for_print(const TriMesh& surface);

/// Why the surface cannot be printed, as "3 open edges, 1 triangle ..."; "" if it can.
std::string print_flaw(const PrintGate& gate);

/// The entry "gate" of the report.
nlohmann::ordered_json gate_json(const PrintGate& gate);

}  // namespace mesamis
