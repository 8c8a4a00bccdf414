// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/surface/tri_mesh.h"

/// Distances between two surfaces as reports and histograms show them.
namespace mesamis {

/// Distances (16) from one surface to another, mm: from its vertices and from points even by area.
struct Direction {
  std::string name;
  std::vector<double> from_vertices, from_area;
};

/// @param from  without points that no triangle uses: all of them count as vertices.
/// @param part  where given, only points of `from` inside this box count.
/// @throws InputError  if a surface has no triangle or is not sound, or no point counts.
Direction measure(const std::string& name, const TriMesh& from, const TriMesh& to,
                  const std::optional<Box>& part = std::nullopt);

/// A direction's entry in a report: vertices, mean (15), rms, p95, p99, max, and the same by area.
nlohmann::ordered_json direction_json(const Direction& direction);

/// What the paper calls its distances (14)-(16): its surface of vertices v is the reference.
nlohmann::ordered_json paper_json(const Direction& reference_to_surface);

/// How many distances lie in each of equal bins from 0 to the longest of all columns.
struct DistanceHistogram {
  struct Column {
    std::string name;
    std::vector<std::size_t> counts;  ///< one per bin
  };
  double width = 1;  ///< of a bin, mm
  std::vector<Column> columns;
};

/// 100 bins; columns NAME_vertices and NAME_area for each direction.
DistanceHistogram histogram_of(std::span<const Direction> directions);

/// One row per bin: its bounds in mm, from_mm and to_mm, then the columns.
std::string to_csv(const DistanceHistogram& histogram);

}  // namespace mesamis
