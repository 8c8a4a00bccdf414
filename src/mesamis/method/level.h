// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/image/volume.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/method/parameters.h"
#include "mesamis/method/settings.h"

namespace mesamis {

/// The denoised image on a mesh.
struct NodalField {
  const TetMesh& mesh;        ///< length units, in the grid's own axes
  std::span<const double> u;  ///< nodal grey values
};

/// Decides at which value the solid surface lies: the user's level where one was given; else the
/// half maximum of the object's edge, measured once more along the level set of u at the first
/// estimate. The image is taken as it came: a restored one overshoots at edges.
/// @param volume      the part of the scan that is used, native units.
/// @param parameters  its level is the first estimate.
/// @return native units. The first estimate where the level set is empty, where no edge can be
///         measured, or where the level found lies below T.
///
/// O(cells + triangles of the level set).
double choose_level(const VolumeView& volume, const Settings& settings,
                    const Parameters& parameters, const NodalField& field);

}  // namespace mesamis
