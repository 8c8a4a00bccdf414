// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/tri_mesh.h"

/// Distances between two surfaces, as reports and histograms show them.
namespace mesamis::detail::surface {

/// Distances (16) from one surface to another, mm.
struct DirectedDistances {
  std::string name;                   ///< "reference_to_surface"
  std::vector<double> from_vertices;  ///< one per vertex of the first surface
  std::vector<double> from_area;      ///< of 200 000 points spread evenly by area
};

/// Measures the distances from one surface to another.
/// @param from  mm; without points that no triangle uses, because every point counts as a vertex.
/// @param to    mm, in the same frame.
/// @param part  mm; where given, only points of `from` inside this box count.
/// @throws InputError  if a surface has no triangle or is not sound, or no point counts.
///
/// O((n + 200 000) log m) for n vertices and m triangles of `to`.
DirectedDistances measure_distances(const std::string& name, const TriMesh& from, const TriMesh& to,
                                    const std::optional<Box>& part = std::nullopt);

/// Measures the distances as measure_distances() does.
/// @return nothing where no point counts.
std::optional<DirectedDistances> find_distances(const std::string& name, const TriMesh& from,
                                                const TriMesh& to, const std::optional<Box>& part);

/// The figures that reports give of distances in one direction.
struct DirectedSummary {
  DistanceSummary vertices;  ///< of the distances from the vertices, mm
  DistanceSummary area;      ///< of the distances from the points spread by area, mm
};

/// Summarises the distances of one direction.
/// @param distances  mm.
/// @return mm; all zero where there is no distance.  O(n log n) for n distances.
DirectedSummary summarize(const DirectedDistances& distances);

/// How many distances lie in each of equal bins from 0 to the longest of all columns.
struct DistanceHistogram {
  struct Column {
    std::string name;
    std::vector<std::size_t> counts;  ///< one per bin
  };
  double width = 1;  ///< of a bin, mm
  std::vector<Column> columns;
};

/// Counts distances in 100 bins.
/// @param directions  mm.
/// @return columns NAME_vertices and NAME_area for each direction.  O(n) for n
///         distances.
DistanceHistogram histogram_of(std::span<const DirectedDistances> directions);

/// Writes a histogram as CSV: the names of the columns, then a row per bin with its bounds in mm,
/// from_mm and to_mm, and the counts.  O(bins) for each column.
std::string to_csv(const DistanceHistogram& histogram);

}  // namespace mesamis::detail::surface
