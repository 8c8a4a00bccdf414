// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/print_bed.h"

#include <sstream>

#include "mesamis/base/error.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis::detail::printing {

void require_valid(const PrintBed& bed) {
  for (const double length : {bed.width, bed.depth, bed.height}) {
    if (length >= kBedLengthMin && length <= kBedLengthMax) continue;
    std::ostringstream message;
    message << "bed: expected lengths from " << kBedLengthMin << " to " << kBedLengthMax
            << " mm, found " << length;
    throw InputError(message.str());
  }
}

PlacedSurface place_on_bed(TriMesh surface, const PrintBed& bed) {
  require_valid(bed);
  require_sound(surface);
  if (surface.triangles.empty()) {
    throw InputError("surface: expected at least one triangle, found none");
  }
  const Box box = bounding_box(without_unused_points(surface).points);
  const Vec3 middle = 0.5 * (box.lo + box.hi);
  const Vec3 shift{bed.width / 2 - middle.x, bed.depth / 2 - middle.y, -box.lo.z};
  for (Vec3& p : surface.points) p += shift;
  return {std::move(surface), box.extent()};
}

bool fits_on(const PrintBed& bed, const Vec3& size) {
  return size.x <= bed.width && size.y <= bed.depth && size.z <= bed.height;
}

std::string size_text(const Vec3& size) {
  std::ostringstream text;
  text << size.x << " x " << size.y << " x " << size.z << " mm";
  return text.str();
}

}  // namespace mesamis::detail::printing
