// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/base/progress.h"
#include "mesamis/mes_amis.h"

namespace mesamis {

/// Makes the solid surface ready to be written in any format: coordinates that single precision
/// holds, and no more triangles than settings.tolerance and settings.triangles ask for. With
/// neither (tolerance 0) it stays as extracted.
/// @param surface   closed, 2-manifold or empty; world frame, mm.
/// @param settings  its tolerance, where there is neither that nor triangles, counts as 0.
/// @param report    what was done, distances measured against the surface given.
/// @throws Cancelled  if progress says stop.
TriMesh make_printable(const TriMesh& surface, const Settings& settings, const Progress& progress,
                       PrintableReport& report);

}  // namespace mesamis
