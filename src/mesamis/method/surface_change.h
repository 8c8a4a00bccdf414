// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::method {

/// What level_set_change() looks at.
struct LevelSetOptions {
  double level = 0;  ///< in the fields' unit
  double most = 1;   ///< longest distance that counts, in the mesh's unit of length, > 0
};

/// Measures how far a level set has moved on a mesh, from one field to another.
///
/// In every cell that the level set {now = level} cuts, the distance to {before = level} is
/// |before - level| / |grad now|, the mean over the crossings with the cell's edges, and
/// options.most at most: what was not there before has come from nowhere. The mean is weighted by
/// the area of the cell's level sets, |grad now| volume / (greatest - least value), from the coarea
/// formula.
/// @param before, now  nodal values of the same field on two occasions.
/// @return the mean distance, in the mesh's unit of length; options.most if there was a level set
///         before and is none now, 0 if there was none.
///
/// The same bits for any number of threads.
double level_set_change(const TetMesh& mesh, std::span<const double> before,
                        std::span<const double> now, const LevelSetOptions& options);

}  // namespace mesamis::detail::method
