// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/decimate/cover.h"
#include "mesamis/decimate/decimate.h"

namespace mesamis::detail::decimate {

/// Decimates a part of a surface as decimate() does, but for points that are held: triangles whose
/// corners are all held stay. So parts whose common points are held still fit.
/// @param original  what the part stands for, mm; a 2-manifold, which may be open. Its points need not
///                  be those of the part.
/// @param part      within the tolerance of the original; where it ends, its points are held. A triangle that stands for none has three held corners.
/// @param held      of each point of the part 1 if it stays.
/// @param options   a finite tolerance > 0, and no number of triangles.
/// @return over the points of the part, which may have moved; the same bits for any number of threads.
/// @throws InputError  if an option is out of range.
/// @throws Cancelled   if progress says stop.
///
/// As decimate().
Cover decimate_part(const TriMesh& original, Cover part, const std::vector<char>& held,
                    const DecimateOptions& options);

}  // namespace mesamis::detail::decimate
