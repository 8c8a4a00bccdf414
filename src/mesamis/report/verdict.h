// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesamis/method/mes_amis.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::report {

/// Whether a run kept what it promised, the worst last.
enum class VerdictKind {
  kKept,          ///< converged, closed, within the tolerance, as accurate as was asked for
  kNotConverged,  ///< the loop did not settle, a solve did not converge, or a distance is unmet
  kNotClosed      ///< a surface that should be closed, manifold and outward is not
};

struct Verdict {
  VerdictKind kind = VerdictKind::kKept;
  std::string message;  ///< what was expected and found, on one line; empty: all was kept
};

/// Judges a run: whether its surface is closed, within the tolerance, the run converged, and the
/// expected error is no more than was asked for.
/// @param check  of the result's surface.  O(n log n) for n triangles.
Verdict judge(const Result& result, const SurfaceCheck& check);

/// Adds what else was missed to a verdict.
/// @param missed  on one line; empty: nothing.
void add_unmet(Verdict& verdict, const std::string& missed);

/// Why a surface is less accurate than was asked for, on one line; empty: it is not.
/// @param accuracy        mm, in the mean; 0: none was asked for.
/// @param expected_error  at its points, mm; empty: not known.
std::string accuracy_unmet(double accuracy, const TriMesh& surface,
                           const std::vector<double>& expected_error);

/// Why a surface is farther from the extracted one than it should be, on one line.
/// @param tolerance  mm.
std::string tolerance_unmet(double tolerance, const PrintableReport& printable);

/// Why decimation stopped at more triangles than were asked for, on one line; empty: it did not.
/// @param asked      triangles, those that two objects share once; 0: no number was.
/// @param tolerance  mm; infinite: none.
std::string triangles_unmet(std::int64_t asked, std::int64_t found, double tolerance);

}  // namespace mesamis::detail::report
