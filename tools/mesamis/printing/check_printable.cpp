// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/check_printable.h"

#include "mesamis/surface/self_intersections.h"

namespace mesamis::detail::printing {

PrintCheck check_printable(const TriMesh& surface) {
  return {check_surface(surface), find_self_intersections(surface).size()};
}

std::string print_flaws_of(const PrintCheck& check) {
  std::string flaws = solid_flaws_of(check.surface);
  if (check.prusa && !check.prusa->sound()) {
    flaws += (flaws.empty() ? "" : ", ") + ("prusa-slicer --info: " + flaws_of(*check.prusa));
  }
  return flaws;
}

}  // namespace mesamis::detail::printing
