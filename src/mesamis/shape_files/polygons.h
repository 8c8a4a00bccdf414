// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <span>

#include "mesamis/files/memory_budget.h"
#include "mesamis/files/refuse.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::shape_files {

/// Cuts the polygons of a file into triangles and appends them to a surface; their points are
/// numbered from the surface's number of points at the start.
class PolygonSink {
 public:
  /// @param budget  asked before triangles are made; must live on, as file and surface.
  PolygonSink(const std::filesystem::path& file, TriMesh& surface, MemoryBudget& budget)
      : file_(file),
        surface_(surface),
        budget_(budget),
        base_(static_cast<double>(surface.points.size())) {}

  /// A polygon becomes a fan; in a strip every other triangle turns the other way.
  /// @throws InputError  if a number cannot be that of a point, and as MemoryBudget::claim().
  void add(std::span<const double> corners, bool strip) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const bool odd = strip && i % 2 == 1;
      const double first = strip ? corners[i - 2] : corners[0];
      const Triangle triangle{index(first), index(corners[odd ? i : i - 1]),
                              index(corners[odd ? i - 1 : i])};
      append_within(budget_, surface_.triangles, triangle, "triangles");
    }
  }

  /// Polygon i has corners [offsets[i], offsets[i + 1]) of the list.
  void add_all(std::span<const double> list, std::span<const double> offsets, bool strips) {
    for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
      const double begin = offsets[i], end = offsets[i + 1];
      if (!(begin >= 0 && begin <= end && end <= static_cast<double>(list.size()))) {
        refuse(file_, message("expected the corners of polygon ", i, " within a list of ",
                              list.size(), ", found ", begin, " to ", end));
      }
      const auto from = static_cast<std::size_t>(begin), to = static_cast<std::size_t>(end);
      add(list.subspan(from, to - from), strips);
    }
  }

 private:
  Index index(double number) const {
    const double place = base_ + number;
    if (!(number >= 0 && place <= std::numeric_limits<Index>::max() &&
          number == std::floor(number))) {
      refuse(file_, message("expected the number of a point in a polygon, found ", number));
    }
    return static_cast<Index>(place);
  }

  const std::filesystem::path& file_;
  TriMesh& surface_;
  MemoryBudget& budget_;
  double base_;
};

}  // namespace mesamis::detail::shape_files
