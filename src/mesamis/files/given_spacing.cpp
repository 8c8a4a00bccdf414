// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/given_spacing.h"

#include <cmath>

#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {

void require_positive_spacing(const std::filesystem::path& path, const Vec3& spacing) {
  for (int a = 0; a < 3; ++a) {
    if (spacing[a] > 0 && std::isfinite(spacing[a])) continue;
    refuse(path, message("expected a positive spacing, found ", spacing[a], " mm"));
  }
}

std::string spacing_is_replaced(const Vec3& stated) {
  return message("the file's spacing, ", stated.x, " x ", stated.y, " x ", stated.z,
                 " mm, is replaced by the one given");
}

}  // namespace mesamis::detail::files
