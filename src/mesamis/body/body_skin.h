// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "mesamis/remesh/body.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::body {

/// The boundary of one object of a body: closed, its triangles turned outward.
/// @param object  from 1 on; 0: of all objects together, without what two of them share.
/// @return the points that the boundary uses, in the order of the body's; the triangles in the
///         order of the cells and of their faces.
/// @throws InputError  as cell_neighbors().
///
/// O(m log d) for m elements, see cell_neighbors().
TriMesh body_skin(const BodyMesh& body, Material object = kOutside);

/// The boundaries of the objects 1 to `count`, as body_skin() gives them; empty where an object has
/// no element.
/// @throws InputError  as cell_neighbors().
///
/// O(m log d) for m elements, and O(n) per object for n points.
std::vector<TriMesh> body_skins(const BodyMesh& body, std::size_t count);

}  // namespace mesamis::detail::body
