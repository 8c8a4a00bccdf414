// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/select_parts.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis::detail::surface {
namespace {

bool is_cavity(const Nesting& nesting, std::size_t part) { return nesting.depth[part] % 2 != 0; }

/// Does what is around the part go?
bool leaves_along(const Nesting& nesting, const std::vector<char>& goes, std::size_t part) {
  return nesting.parent[part] != kNoIndex && goes[nesting.parent[part]];
}

/// Which parts go. They come largest first, so that what is around a part is decided before it.
std::vector<char> find_unwanted(std::span<const SurfaceComponents::Size> parts,
                                const Nesting& nesting, const PartSelection& selection) {
  std::vector<char> goes(parts.size(), 0);
  double least = selection.volume_min;
  if (selection.largest_stays && !parts.empty()) least = std::min(least, std::abs(parts[0].volume));
  std::int64_t islands = 0;
  for (std::size_t p = 0; p < goes.size(); ++p) {
    const bool cavity = is_cavity(nesting, p);
    const bool small = std::abs(parts[p].volume) < least;
    const bool filled = cavity && selection.fill_cavities;
    goes[p] = leaves_along(nesting, goes, p) || small || filled;
    if (cavity || goes[p]) continue;
    ++islands;
    goes[p] = selection.keep_largest > 0 && islands > selection.keep_largest;
  }
  return goes;
}

SelectionReport tell(std::span<const SurfaceComponents::Size> parts, const Nesting& nesting,
                     const std::vector<char>& goes) {
  SelectionReport report;
  for (std::size_t p = 0; p < goes.size(); ++p) {
    const double volume = std::abs(parts[p].volume);
    if (is_cavity(nesting, p)) {
      // A cavity that leaves with its island is not filled.
      const bool filled = goes[p] && !leaves_along(nesting, goes, p);
      ++report.cavities;
      report.cavities_filled += filled;
      report.volume_filled += filled ? volume : 0;
    } else {
      ++report.islands;
      report.islands_dropped += goes[p];
      report.volume_dropped += goes[p] * volume;
    }
  }
  return report;
}

TriMesh without(const TriMesh& surface, const SurfaceComponents& parts,
                const std::vector<char>& goes) {
  TriMesh kept{surface.points, {}};
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Index part = parts.of_triangle[t];
    if (part != kNoIndex && !goes[part]) kept.triangles.push_back(surface.triangles[t]);
  }
  return without_unused_points(kept);
}

}  // namespace

PartChoice choose_parts(std::span<const SurfaceComponents::Size> parts, const Nesting& nesting,
                        const PartSelection& selection) {
  std::vector<char> goes = find_unwanted(parts, nesting, selection);
  const SelectionReport report = tell(parts, nesting, goes);
  return {std::move(goes), report};
}

TriMesh select_parts(const TriMesh& surface, const PartSelection& selection,
                     SelectionReport* report) {
  const std::string flaws = flaws_of(check_surface(surface));
  if (!flaws.empty()) {
    throw InputError("parts of a surface: expected a closed 2-manifold surface, found " + flaws);
  }
  const SurfaceComponents parts = find_components(surface);
  const Nesting nesting = find_nesting(surface, parts);
  const PartChoice choice = choose_parts(parts.sizes, nesting, selection);
  if (report != nullptr) *report = choice.report;
  return without(surface, parts, choice.goes);
}

}  // namespace mesamis::detail::surface
