// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/tet_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <tuple>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/kuhn.h"
#include "mesamis/mesh/predicates.h"

namespace mesamis {
namespace {

struct FaceSlot {
  std::array<Index, 3> points;  // sorted
  Index cell;
  std::int8_t face;
};

/// The faces of all cells, in one bucket per lowest point: what is left to sort is short, and a
/// matter of each bucket.
class FaceBuckets {
 public:
  explicit FaceBuckets(const TetMesh& mesh) : mesh_(mesh), start_(point_count(mesh) + 1, 0) {
    for_each_face([this](std::size_t lowest, std::int64_t) { ++start_[lowest + 1]; });
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    slots_.resize(4 * mesh.cells.size());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for_each_face([&](std::size_t lowest, std::int64_t slot) { slots_[next[lowest]++] = slot; });
  }

  std::size_t size() const { return start_.size() - 1; }

  /// Those of one bucket by their points, then by cell.
  void sort(std::size_t lowest, std::vector<FaceSlot>& faces) const {
    faces.clear();
    for (std::size_t i = start_[lowest]; i < start_[lowest + 1]; ++i) {
      const std::int64_t cell = slots_[i] / 4, face = slots_[i] % 4;
      faces.push_back(
          {sorted_face(mesh_.cells[static_cast<std::size_t>(cell)], static_cast<int>(face)),
           static_cast<Index>(cell), static_cast<std::int8_t>(face)});
    }
    std::sort(faces.begin(), faces.end(), [](const FaceSlot& a, const FaceSlot& b) {
      return std::tie(a.points[1], a.points[2], a.cell) <
             std::tie(b.points[1], b.points[2], b.cell);
    });
  }

 private:
  static std::size_t point_count(const TetMesh& mesh) {
    Index highest = kNoIndex;
    for (const Cell& cell : mesh.cells) {
      const auto [low, high] = std::minmax_element(cell.begin(), cell.end());
      if (*low < 0) throw InputError("mesh: a cell names a missing point");
      highest = std::max(highest, *high);
    }
    if (!mesh.points.empty() && highest >= std::ssize(mesh.points)) {
      throw InputError("mesh: a cell names a missing point");
    }
    return static_cast<std::size_t>(highest) + 1;  // 0 without cells
  }

  template <class Visit>
  void for_each_face(Visit&& visit) const {
    std::int64_t slot = 0;
    for (const Cell& cell : mesh_.cells) {
      for (const auto& [a, b, c] : kCellFaces) {
        visit(static_cast<std::size_t>(std::min({cell[a], cell[b], cell[c]})), slot++);
      }
    }
  }

  const TetMesh& mesh_;
  std::vector<std::size_t> start_;
  std::vector<std::int64_t> slots_;  // four times the cell and the face
};

/// Calls look(faces) once for the faces that have the same points, concurrently.
/// @return what it says where it first says anything, in the order of the points.
template <class Look>
std::string look_at_faces(const TetMesh& mesh, Look&& look) {
  const FaceBuckets buckets(mesh);
  std::vector<std::string> said((buckets.size() + kBlock - 1) / kBlock);
  parallel_blocks(buckets.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<FaceSlot> faces;
    std::string& first = said[begin / kBlock];
    for (std::size_t p = begin; p < end && first.empty(); ++p) {
      buckets.sort(p, faces);
      for (std::size_t i = 0; i < faces.size() && first.empty();) {
        std::size_t j = i + 1;
        while (j < faces.size() && faces[j].points == faces[i].points) ++j;
        first = look(std::span<const FaceSlot>(faces).subspan(i, j - i));
        i = j;
      }
    }
  });
  const auto found =
      std::find_if(said.begin(), said.end(), [](const std::string& s) { return !s.empty(); });
  return found == said.end() ? std::string() : *found;
}

bool on_one_plane(const std::array<Vec3, 3>& p, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double plane : {box.lo[axis], box.hi[axis]}) {
      if (p[0][axis] == plane && p[1][axis] == plane && p[2][axis] == plane) return true;
    }
  }
  return false;
}

std::string find_bad_point(const TetMesh& mesh, const Box& box) {
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = mesh.points[i][axis];
      if (!(x >= box.lo[axis] && x <= box.hi[axis])) {
        return "point " + std::to_string(i) + " is not inside the box";
      }
    }
  }
  return {};
}

std::string find_bad_cell(const TetMesh& mesh) {
  const auto points = static_cast<Index>(mesh.points.size());
  std::vector<char> used(mesh.points.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Cell& k = mesh.cells[c];
    for (const Index i : k) {
      if (i < 0 || i >= points) return "cell " + std::to_string(c) + " names a missing point";
      used[static_cast<std::size_t>(i)] = 1;
    }
    const auto [p, q, r, s] = cell_corners(mesh, k);
    if (!certified_positive(p, q, r, s)) {
      return "cell " + std::to_string(c) + " has no certified positive volume";
    }
  }
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end()) {
    return "point " + std::to_string(unused - used.begin()) + " belongs to no cell";
  }
  return {};
}

std::string find_bad_face(const TetMesh& mesh, const Box& box) {
  return look_at_faces(mesh, [&](std::span<const FaceSlot> same) -> std::string {
    const auto& p = same[0].points;
    const bool outer = on_one_plane({mesh.points[p[0]], mesh.points[p[1]], mesh.points[p[2]]}, box);
    auto face = [&] { return "a face of cell " + std::to_string(same[0].cell); };
    if (same.size() > 2) return face() + " is shared by " + std::to_string(same.size()) + " cells";
    if (same.size() == 2 && outer) return face() + " lies on the box and has two cells";
    if (same.size() == 1 && !outer) return face() + " has one cell and does not lie on the box";
    return {};
  });
}

std::string find_bad_volume(const TetMesh& mesh, const Box& box) {
  long double sum = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    sum += cell_volume(mesh, static_cast<Index>(c));
  }
  const double error = static_cast<double>(sum) / box.volume() - 1;
  if (std::abs(error) <= 1e-12) return {};
  std::ostringstream shown;
  shown << error;
  return "the cells' volume differs from the box's by " + shown.str() + " relative";
}

}  // namespace

std::array<Index, 3> sorted_face(const Cell& cell, int face) {
  const auto& local = kCellFaces[static_cast<std::size_t>(face)];
  std::array<Index, 3> points{cell[local[0]], cell[local[1]], cell[local[2]]};
  std::sort(points.begin(), points.end());
  return points;
}

double cell_volume(const TetMesh& mesh, Index cell) {
  const auto [a, b, c, d] = cell_corners(mesh, mesh.cells[static_cast<std::size_t>(cell)]);
  return six_volume(a, b, c, d) / 6;
}

Box bounding_box(std::span<const Vec3> points) {
  constexpr double kHuge = std::numeric_limits<double>::infinity();
  Box box{{kHuge, kHuge, kHuge}, {-kHuge, -kHuge, -kHuge}};
  for (const Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], p[axis]);
      box.hi[axis] = std::max(box.hi[axis], p[axis]);
    }
  }
  return box;
}

TetMesh box_mesh(const Box& box, const std::array<Index, 3>& n) {
  for (int axis = 0; axis < 3; ++axis) {
    if (n[axis] < 1) throw InputError("box mesh: at least one brick per direction is needed");
    if (!(box.hi[axis] > box.lo[axis])) throw InputError("box mesh: the box is empty");
  }
  const std::int64_t cells = 6 * std::int64_t{n[0]} * n[1] * n[2];
  if (cells > std::numeric_limits<Index>::max()) {
    throw InputError("box mesh: " + std::to_string(cells) + " cells exceed 32-bit indices");
  }
  TetMesh mesh;
  auto coordinate = [&](int axis, Index i) {
    if (i == n[axis]) return box.hi[axis];
    return box.lo[axis] + (box.hi[axis] - box.lo[axis]) * i / n[axis];
  };
  for (Index k = 0; k <= n[2]; ++k) {
    for (Index j = 0; j <= n[1]; ++j) {
      for (Index i = 0; i <= n[0]; ++i) {
        mesh.points.push_back({coordinate(0, i), coordinate(1, j), coordinate(2, k)});
      }
    }
  }
  const std::array<Index, 3> stride{1, n[0] + 1, (n[0] + 1) * (n[1] + 1)};
  mesh.cells.reserve(static_cast<std::size_t>(cells));
  for (Index k = 0; k < n[2]; ++k) {
    for (Index j = 0; j < n[1]; ++j) {
      for (Index i = 0; i < n[0]; ++i) {
        const Index corner = i * stride[0] + j * stride[1] + k * stride[2];
        for (const auto& path : kKuhnPaths) {
          mesh.cells.push_back(kuhn_cell(corner, stride, path));
        }
      }
    }
  }
  return mesh;
}

TetMesh coarse_box_mesh(const Box& box) {
  constexpr double kMostBricks = 32;  // along the longest side
  const Vec3 extent = box.extent();
  const double shortest = std::min({extent.x, extent.y, extent.z});
  const double longest = std::max({extent.x, extent.y, extent.z});
  const double brick = std::max(shortest / 2, longest / kMostBricks);
  std::array<Index, 3> n{};
  for (int a = 0; a < 3; ++a) {
    n[a] = std::max<Index>(1, static_cast<Index>(std::lround(extent[a] / brick)));
  }
  return box_mesh(box, n);
}

std::vector<std::array<Index, 4>> cell_neighbors(const TetMesh& mesh) {
  std::vector<std::array<Index, 4>> neighbors(mesh.cells.size(),
                                              {kNoIndex, kNoIndex, kNoIndex, kNoIndex});
  const std::string flaw = look_at_faces(mesh, [&](std::span<const FaceSlot> same) -> std::string {
    if (same.size() > 2) {
      return "mesh: a face of cell " + std::to_string(same[0].cell) +
             " is shared by more than two cells";
    }
    if (same.size() < 2) return {};
    neighbors[same[0].cell][same[0].face] = same[1].cell;
    neighbors[same[1].cell][same[1].face] = same[0].cell;
    return {};
  });
  if (!flaw.empty()) throw InputError(flaw);
  return neighbors;
}

PointCells point_cells(const TetMesh& mesh) {
  PointCells result;
  result.start.assign(mesh.points.size() + 1, 0);
  for (const Cell& cell : mesh.cells) {
    for (const Index p : cell) ++result.start[static_cast<std::size_t>(p) + 1];
  }
  for (std::size_t i = 0; i < mesh.points.size(); ++i) result.start[i + 1] += result.start[i];
  result.cells.resize(4 * mesh.cells.size());
  std::vector<std::int64_t> next(result.start.begin(), result.start.end() - 1);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (const Index p : mesh.cells[c]) {
      result.cells[static_cast<std::size_t>(next[static_cast<std::size_t>(p)]++)] =
          static_cast<Index>(c);
    }
  }
  return result;
}

std::string find_flaw(const TetMesh& mesh, const Box& box) {
  for (const auto& check : {find_bad_point(mesh, box), find_bad_cell(mesh)}) {
    if (!check.empty()) return check;
  }
  std::string flaw = find_bad_face(mesh, box);
  return flaw.empty() ? find_bad_volume(mesh, box) : flaw;
}

void validate(const TetMesh& mesh, const Box& box) {
  const std::string flaw = find_flaw(mesh, box);
  if (!flaw.empty()) throw NumericalError("mesh: " + flaw);
}

}  // namespace mesamis
