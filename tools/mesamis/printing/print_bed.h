// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

/// The size of the printer's bed, and the surface on it.
namespace mesamis::detail::printing {

inline constexpr double kBedLengthMin = 1;    // mm
inline constexpr double kBedLengthMax = 1e4;  // mm

/// The largest print that a printer takes: kBedLengthMin to kBedLengthMax in each direction.
struct PrintBed {
  double width = 250;   ///< mm, along x
  double depth = 210;   ///< mm, along y
  double height = 210;  ///< mm, along z, above the bed
};

/// Checks the lengths of a bed.
/// @throws InputError  if a length is out of range; the message gives it.
void require_valid(const PrintBed& bed);

/// A surface in the coordinates of the print. The corner of the bed is the origin.
struct PlacedSurface {
  TriMesh surface;  ///< mm
  Vec3 size;        ///< mm, of its bounding box
};

/// Moves a surface to the middle of the bed, its lowest point at z = 0. It is neither turned nor
/// scaled.
///
/// @param surface  at least one triangle; mm. Points that no triangle uses are moved but do not
///                 count for the size.
/// @param bed      see require_valid().
/// @throws InputError  if the surface is empty or unsound (see require_sound()), or the bed is
///                     not valid.
PlacedSurface place_on_bed(TriMesh surface, const PrintBed& bed);

/// Whether a print of this size, in mm, is no larger than the bed in any direction.
bool fits_on(const PrintBed& bed, const Vec3& size);

/// Writes a size in mm as "250 x 210 x 210 mm".
std::string size_text(const Vec3& size);

}  // namespace mesamis::detail::printing
