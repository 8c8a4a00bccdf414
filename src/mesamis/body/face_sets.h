// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

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
/// "NAME=normal:X,Y,Z,DEGREES" or "NAME=between:1,2". Lengths are in mm, with or without the unit.
/// @param text  the name has letters, digits and underscores, begins with a letter.
/// @throws InputError  naming the forms there are, and what was found.
///
/// O(length).
FaceQuery parse_face_query(std::string_view text);

/// A face as its cell and the local vertex opposite it.
using CellFace = std::array<Index, 2>;

/// Finds the faces of a body that a query means, on its boundary or between two objects.
/// @param body  m cells, in the frame of the query, mm.
/// @return by cell and face; of a face between two objects that of the first one named.
/// @throws InputError  if there is none, or as cell_neighbors().
///
/// O(m log d), see cell_neighbors().
std::vector<CellFace> find_faces(const BodyMesh& body, const FaceQuery& query);

}  // namespace mesamis
