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

/// The faces of all cells by their points, then by cell. Put into one bucket per lowest point
/// first: what is left to sort is short.
std::vector<FaceSlot> sorted_faces(const TetMesh& mesh) {
  Index highest = kNoIndex;
  for (const Cell& cell : mesh.cells) {
    const auto [low, high] = std::minmax_element(cell.begin(), cell.end());
    if (*low < 0) throw InputError("mesh: a cell names a missing point");
    highest = std::max(highest, *high);
  }
  if (!mesh.points.empty() && highest >= std::ssize(mesh.points)) {
    throw InputError("mesh: a cell names a missing point");
  }
  std::vector<std::size_t> start(static_cast<std::size_t>(highest) + 2, 0);
  for (const Cell& cell : mesh.cells) {
    for (int f = 0; f < 4; ++f) ++start[sorted_face(cell, f)[0] + 1];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  std::vector<FaceSlot> faces(4 * mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (int f = 0; f < 4; ++f) {
      const std::array<Index, 3> points = sorted_face(mesh.cells[c], f);
      faces[next[points[0]]++] = {points, static_cast<Index>(c), static_cast<std::int8_t>(f)};
    }
  }
  parallel_for(next.size(), [&](std::size_t p) {
    std::sort(faces.begin() + static_cast<std::ptrdiff_t>(start[p]),
              faces.begin() + static_cast<std::ptrdiff_t>(start[p + 1]),
              [](const FaceSlot& a, const FaceSlot& b) {
                return std::tie(a.points[1], a.points[2], a.cell) <
                       std::tie(b.points[1], b.points[2], b.cell);
              });
  });
  return faces;
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
  const std::vector<FaceSlot> faces = sorted_faces(mesh);
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t j = i + 1;
    while (j < faces.size() && faces[j].points == faces[i].points) ++j;
    const auto& p = faces[i].points;
    const bool outer = on_one_plane({mesh.points[p[0]], mesh.points[p[1]], mesh.points[p[2]]}, box);
    auto face = [&] { return "a face of cell " + std::to_string(faces[i].cell); };
    if (j - i > 2) return face() + " is shared by " + std::to_string(j - i) + " cells";
    if (j - i == 2 && outer) return face() + " lies on the box and has two cells";
    if (j - i == 1 && !outer) return face() + " has one cell and does not lie on the box";
    i = j;
  }
  return {};
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
  const std::vector<FaceSlot> faces = sorted_faces(mesh);
  for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
    if (faces[i].points != faces[i + 1].points) continue;
    if (i + 2 < faces.size() && faces[i + 2].points == faces[i].points) {
      throw InputError("mesh: a face of cell " + std::to_string(faces[i].cell) +
                       " is shared by more than two cells");
    }
    neighbors[faces[i].cell][faces[i].face] = faces[i + 1].cell;
    neighbors[faces[i + 1].cell][faces[i + 1].face] = faces[i].cell;
    ++i;
  }
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
