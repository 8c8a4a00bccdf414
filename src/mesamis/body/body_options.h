// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "mesamis/base/progress.h"
#include "mesamis/base/types.h"
#include "mesamis/mesh/tet_mesh.h"

/// Options and face queries for a body of finite elements.
namespace mesamis {

/// The elements of a body.
struct BodyOptions {
  double element_size = 0;  ///< wanted edge length, mm; 0: a thirtieth of the body's longest side
  /// Shortest edge wanted, mm; 0: a quarter of the element size, less where the skin misses the
  /// tolerance.
  double least_size = 0;
  double tolerance = 0.1;  ///< largest distance of the skin from the surfaces, mm, > 0
  double gradation = 0.5;  ///< growth of sizes over a length, no unit, > 0
  int through_wall = 1;    ///< elements wanted between two sides of a wall; 0: any
  /// Parts with a smaller share of the volume of each object are left out, because a solver cannot
  /// support loose parts; 0: none.
  double part_share = 1e-3;
  std::int64_t most_elements = 100'000'000;  ///< limit, elements outside the body included
  bool quadratic = false;                    ///< add mid-side nodes, on the skin where it is curved
  bool skins = false;  ///< also deliver the skins, those of small parts included
  Progress progress;   ///< optional
};

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
/// @throws InputError  naming the possible forms, and what was found.
FaceQuery parse_face_query(std::string_view text);

/// Converts a query from another frame to the world frame (LPS): x and y change sign.
FaceQuery in_lps(FaceQuery query, Frame frame);

}  // namespace mesamis
