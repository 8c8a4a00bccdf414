// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// What a surface covers: the greatest of the samples of a P1 function on the way from each point
/// of the surface inward along its normal (see vertex_normals()). On a level set the function
/// itself is the same everywhere; this tells dense bone from thin.
///
/// @param mesh     fills a box, mm; beyond it the nearest cell answers.
/// @param u        the function at the nodes.
/// @param surface  normals outward, mm.
/// @param depth    how far inward, mm, >= 0.
/// @param samples  on the way, >= 1, the point itself beside them.
/// @return a value per point.
/// @throws InputError  as require_sound, or if u is not one per node or a parameter out of range.
std::vector<double> greatest_beneath(const TetMesh& mesh, std::span<const double> u,
                                     const TriMesh& surface, double depth, int samples);

}  // namespace mesamis
