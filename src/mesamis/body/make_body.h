// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/body/body_fit.h"
#include "mesamis/body/body_options.h"
#include "mesamis/body/body_skin.h"
#include "mesamis/body/mid_nodes.h"
#include "mesamis/mesh/element_quality.h"
#include "mesamis/remesh/body.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::body {

/// A body for finite elements.
struct MeshedBody {
  BodyMesh elements;           ///< object k of the surfaces has the material k, from 1 on
  MidNodes middles;            ///< empty unless quadratic
  std::vector<TriMesh> skins;  ///< of object k at k - 1, see body_skin(); before small parts were
                               ///< left out; empty unless asked for
  ElementQuality quality;      ///< of all elements
  double element_size = 0;     ///< that was aimed at, mm
  std::int64_t parts = 0, parts_dropped = 0;  ///< connected by faces
  BodyFit fit;                                ///< to the surfaces; parts that were dropped count
  double least_size = 0;                      ///< the smallest that was aimed at, mm
  double narrow_share = 0;  ///< of the surfaces' area: where a wall or a gap is narrower than that
  struct Seconds {
    double sizes = 0, start = 0, body = 0, fit = 0, total = 0;
  } seconds;
};

/// The smallest box around all points of surfaces.
/// @param surfaces  mm.
/// @return mm; as bounding_box() where there are no points.
Box bounding_box(std::span<const TriMesh> surfaces);

/// Fills surfaces with well shaped tetrahedra, whose boundary lies within the tolerance of them.
///
/// Sizes follow the element size, curvature and thickness (size_field()); a mesh of the box is made
/// for them (remesh()), cut at the surfaces and improved with its skin kept (remesh_body()). Where
/// skin and surfaces are farther apart than the tolerance, all this is done again, three times at
/// most, with half the sizes there, unless that is below a least size that is given or asks for
/// three times as many elements. The nearest body is returned.
/// The boundary of one object alone is a 2-manifold. Of several objects each has a closed boundary,
/// which may touch itself where three of them, or two and the outside, meet.
/// @param surfaces  1 to 255 objects, closed, 2-manifold, oriented outward, mm; what two share is
///                  the same in both.
/// @param box       mm, around all of them: where a surface lies on one of its planes, so will the
///                  body.
/// @throws InputError  as BodySurface and remesh_body(), where the element size is larger than the
///                     body, or where it asks for too many elements.
/// @throws Cancelled   if progress says stop.
///
/// Time and memory (600 bytes per element were measured) as remesh() for about twice the elements.
/// The same bits for any number of threads.
MeshedBody make_body(std::span<const TriMesh> surfaces, const Box& box, const BodyOptions& options);

}  // namespace mesamis::detail::body
