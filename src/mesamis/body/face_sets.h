// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/base/frame.h"
#include "mesamis/remesh/body.h"

namespace mesamis {

/// Which faces of a body a support or a load acts on.
struct FaceQuery {
  enum class Kind {
    kTop,      ///< faces that look along an axis, within a depth of the body's highest point
    kBottom,   ///< the same against the axis, from its lowest point
    kBox,      ///< faces whose three corners lie in a box
    kNormal,   ///< faces whose outward normal is within an angle of a direction
    kBetween,  ///< faces that two objects share
    kOuter,    ///< faces of the boundaries around the body
    kInner,    ///< faces of the boundaries around its cavities
  };
  std::string name;
  Kind kind = Kind::kTop;
  int axis = 2;                       ///< of kTop and kBottom: 0 x, 1 y, 2 z
  double depth = 0;                   ///< of kTop and kBottom, mm, > 0
  Box box{};                          ///< of kBox, mm
  Vec3 normal{};                      ///< of kNormal, of length 1
  double angle_deg = 0;               ///< of kNormal, degrees, > 0 and at most 180
  std::array<Material, 2> objects{};  ///< of kBetween, from 1 on
};

/// Reads a query: "NAME=top:z,2mm", "NAME=bottom:x,1.5", "NAME=box:X0,Y0,Z0,X1,Y1,Z1",
/// "NAME=normal:X,Y,Z,DEGREES", "NAME=between:1,2" (the first and the second object), "NAME=outer"
/// or "NAME=inner". Lengths are in mm, with or without the unit.
/// @param text  the name has letters, digits and underscores, begins with a letter.
/// @throws InputError  naming the forms there are, and what was found.
FaceQuery parse_face_query(std::string_view text);

/// The query in the world frame (LPS) of one that was written in another: x and y change sign.
FaceQuery in_lps(FaceQuery query, Frame frame);

/// A face as its cell and the local vertex opposite it.
using CellFace = std::array<Index, 2>;

/// Finds the faces of a body that a query means, on its boundary or between two objects.
///
/// Each component of the boundary, connected by edges, is outer or inner as a whole: outer if its
/// faces look away from the volume they enclose. A cavity that touches the outside at an edge is
/// one with it.
/// @param body  m cells, in the frame of the query, mm.
/// @return by cell and face; of a face between two objects that of the first one named. There may
///         be none.
/// @throws InputError  as cell_neighbors().
///
/// O(m log d), see cell_neighbors().
std::vector<CellFace> find_faces(const BodyMesh& body, const FaceQuery& query);

}  // namespace mesamis
