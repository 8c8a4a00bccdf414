// SPDX-License-Identifier: Apache-2.0
#include "mesamis/report/cell_labels.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesamis/base/parallel.h"
#include "mesamis/report/line_crossing.h"
#include "mesamis/report/solver_name.h"

namespace mesamis::detail::report {
namespace {

constexpr double kPointsPerBin = 8;

/// Points by their y and z, in bins.
class Bins {
 public:
  explicit Bins(std::span<const Vec3> points) : box_(bounding_box(points)) {
    const double bins = static_cast<double>(points.size()) / kPointsPerBin;
    side_ = std::max<Index>(1, static_cast<Index>(std::sqrt(bins)));
    first_.assign(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_) + 1, 0);
    for (const Vec3& p : points) ++first_[bin_of(p) + 1];
    for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
    listed_.resize(points.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t n = 0; n < points.size(); ++n) listed_[next[bin_of(points[n])]++] = n;
  }

  Index side() const { return side_; }

  /// The bin along an axis, 1 or 2; what lies beyond counts as the last.
  Index along(int axis, double at) const {
    const double share = (at - box_.lo[axis]) / std::max(box_.extent()[axis], 1e-300);
    return static_cast<Index>(std::clamp(share * side_, 0.0, side_ - 1.0));
  }

  /// Calls visit(point) for those of a row of bins, from one along y to another.
  template <class Visit>
  void for_each(Index row, Index from, Index to, Visit&& visit) const {
    const std::size_t start = static_cast<std::size_t>(row) * static_cast<std::size_t>(side_);
    const std::size_t end = first_[start + static_cast<std::size_t>(to) + 1];
    for (std::size_t n = first_[start + static_cast<std::size_t>(from)]; n < end; ++n) {
      visit(listed_[n]);
    }
  }

 private:
  std::size_t bin_of(const Vec3& p) const {
    return static_cast<std::size_t>(along(2, p.z)) * static_cast<std::size_t>(side_) +
           static_cast<std::size_t>(along(1, p.y));
  }

  Box box_;
  Index side_ = 1;
  std::vector<std::size_t> first_, listed_;
};

/// A triangle and where it lies along y and z.
struct Spread {
  std::array<NumberedCorner, 3> corners;
  double y0, y1, z0, z1;
};

Spread spread_of(const TriMesh& surface, const Triangle& t) {
  const auto at = [&](std::size_t n) -> const Vec3& { return surface.points[t[n]]; };
  const auto [y0, y1] = std::minmax({at(0).y, at(1).y, at(2).y});
  const auto [z0, z1] = std::minmax({at(0).z, at(1).z, at(2).z});
  return {{{{at(0), t[0]}, {at(1), t[1]}, {at(2), t[2]}}}, y0, y1, z0, z1};
}

/// The triangles of a surface that each row of bins meets.
std::vector<std::vector<Index>> triangles_by_row(const TriMesh& surface, const Bins& bins) {
  std::vector<std::vector<Index>> rows(static_cast<std::size_t>(bins.side()));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Spread s = spread_of(surface, surface.triangles[t]);
    for (Index row = bins.along(2, s.z0); row <= bins.along(2, s.z1); ++row) {
      rows[static_cast<std::size_t>(row)].push_back(static_cast<Index>(t));
    }
  }
  return rows;
}

/// How often the line to each point has entered a surface more than left it.
std::vector<int> depths_in(const TriMesh& surface, std::span<const Vec3> points, const Bins& bins) {
  std::vector<int> depth(points.size(), 0);
  const auto rows = triangles_by_row(surface, bins);
  parallel_for(rows.size(), [&](std::size_t row) {
    for (const Index t : rows[row]) {
      const Spread s = spread_of(surface, surface.triangles[static_cast<std::size_t>(t)]);
      const auto cross = [&](std::size_t n) {
        const auto& [x, y, z] = points[n];
        if (y < s.y0 || y > s.y1 || z < s.z0 || z > s.z1) return;
        const auto crossing = line_crossing(s.corners, y, z);
        if (crossing && crossing->x < x) depth[n] += crossing->inward;
      };
      bins.for_each(static_cast<Index>(row), bins.along(1, s.y0), bins.along(1, s.y1), cross);
    }
  });
  return depth;
}

std::string set_name(const Segment& segment) {
  return solver_name("L" + std::to_string(segment.label) + "_" + segment.name);
}

}  // namespace

std::vector<Index> objects_at(std::span<const Vec3> points, std::span<const FoundObject> objects) {
  std::vector<Index> found(points.size(), kNoIndex);
  const Bins bins(points);
  for (std::size_t o = 0; o < objects.size(); ++o) {
    const std::vector<int> depth = depths_in(objects[o].surface, points, bins);
    for (std::size_t n = 0; n < depth.size(); ++n) {
      if (depth[n] != 0) found[n] = static_cast<Index>(o);
    }
  }
  return found;
}

CellSets label_sets(const TetMesh& mesh, std::span<const FoundObject> objects) {
  std::vector<Vec3> centroids(mesh.cells.size());
  parallel_for(centroids.size(), [&](std::size_t c) {
    const auto corners = cell_corners(mesh, mesh.cells[c]);
    centroids[c] = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  });
  CellSets sets{{{"BACKGROUND", "outside of all objects"}}, objects_at(centroids, objects)};
  for (Index& set : sets.of_cell) ++set;  // kNoIndex, -1, is the background
  for (const FoundObject& object : objects) {
    const Segment& s = object.segment;
    sets.sets.push_back({set_name(s), "label " + std::to_string(s.label) + ", " + s.name});
  }
  return sets;
}

}  // namespace mesamis::detail::report
