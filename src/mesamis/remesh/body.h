// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/mesh/metric_field.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/remesh/body_shape.h"
#include "mesamis/remesh/remesh.h"

namespace mesamis::detail::remesh {

/// A mesh of one or more objects: between two of them, and towards the outside, its faces are the
/// skin.
struct BodyMesh {
  TetMesh mesh;                     ///< of the objects alone, mm
  std::vector<Material> materials;  ///< per cell, above 0
  RemeshReport report{};            ///< what remesh_body() did
};

/// Builds a mesh of the objects of a shape, whose edges have length one in the metric.
///
/// The start mesh is cut: an edge between two materials is split where it crosses the border, also
/// where it passes through a wall or gap that is thinner than the cells. Then the operations of
/// remesh() work on all of it. The skin stays a boundary: its vertices move along it only, its
/// edges are split on it, collapsed along it where the link condition holds, and turned where the
/// new triangles are as near to the border. Where the skin meets a plane of the box it stays in
/// both. Every cell is certified positive at any time, and the cells outside stay until the end:
/// the skin cannot pass through itself.
///
/// @param start   a valid mesh of a box around the objects, mm, whose edges have about the length
///                that is wanted: of remesh() with the same metric.
/// @param metric  in 1/mm^2, defined on the whole box; isotropic where a solver gets the mesh.
/// @param shape   called in threads.
/// @return the same bits for any number of threads.
/// @throws InputError  if start is not a valid mesh of its bounding box, or no cell lies inside.
/// @throws Cancelled   if progress returns false.
///
/// Time and memory as remesh(), and a few look-ups of the border per operation on the skin.
BodyMesh remesh_body(const TetMesh& start, const MetricField& metric, const BodyShape& shape,
                     const RemeshOptions& options = {});

}  // namespace mesamis::detail::remesh
