// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/region.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

#include "mesamis/base/error.h"

namespace mesamis::detail::mesh {
namespace {

using Neighbors = std::vector<std::array<Index, 4>>;

void require_one_per_node(const TetMesh& mesh, std::span<const double> values) {
  if (values.size() == mesh.points.size()) return;
  throw InputError("mesh: expected one value per node (" + std::to_string(mesh.points.size()) +
                   "), found " + std::to_string(values.size()));
}

/// Which cells are in the set, 1 or 0.
std::vector<char> flags_of(const TetMesh& mesh, std::span<const Index> cells) {
  std::vector<char> inside(mesh.cells.size(), 0);
  for (const Index cell : cells) {
    if (cell < 0 || cell >= std::ssize(mesh.cells)) {
      throw InputError("mesh: there is no cell " + std::to_string(cell));
    }
    inside[static_cast<std::size_t>(cell)] = 1;
  }
  return inside;
}

/// A face-connected set of cells, all inside or all outside; maximal.
struct Part {
  std::vector<Index> cells;
  bool inside = false, at_boundary = false;  // the mesh's boundary
  double volume = 0;                         // mm^3
};

/// The part of a cell; its cells are taken out of `left`.
Part part_of(Index first, const Neighbors& neighbors, const std::vector<char>& inside,
             std::vector<char>& left) {
  Part part{{first}, inside[first] != 0};
  left[first] = 0;
  for (std::size_t i = 0; i < part.cells.size(); ++i) {
    for (const Index next : neighbors[part.cells[i]]) {
      if (next == kNoIndex) {
        part.at_boundary = true;
      } else if (left[next] && inside[next] == inside[first]) {
        left[next] = 0;
        part.cells.push_back(next);
      }
    }
  }
  return part;
}

/// In the order of their first cells.
std::vector<Part> find_parts(const TetMesh& mesh, const Neighbors& neighbors,
                             const std::vector<char>& inside) {
  std::vector<Part> parts;
  std::vector<char> left(mesh.cells.size(), 1);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    if (!left[c]) continue;
    parts.push_back(part_of(static_cast<Index>(c), neighbors, inside, left));
    for (const Index cell : parts.back().cells) parts.back().volume += cell_volume(mesh, cell);
  }
  return parts;
}

void fill_cavities(const std::vector<Part>& parts, const CellSelection& selection,
                   std::vector<char>& inside) {
  for (const Part& part : parts) {
    const bool cavity = !part.inside && !part.at_boundary;
    if (!cavity || !(selection.fill_cavities || part.volume < selection.volume_min)) continue;
    for (const Index cell : part.cells) inside[cell] = 1;
  }
}

void drop_parts(std::vector<Part> parts, const CellSelection& selection,
                std::vector<char>& inside) {
  std::erase_if(parts, [](const Part& part) { return !part.inside; });
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return a.volume > b.volume; });
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const bool too_many =
        selection.keep_largest > 0 && static_cast<std::int64_t>(p) >= selection.keep_largest;
    if (!too_many && parts[p].volume >= selection.volume_min) continue;
    for (const Index cell : parts[p].cells) inside[cell] = 0;
  }
}

}  // namespace

double mesh_volume(const TetMesh& mesh) {
  double sum = 0;
  for (Index c = 0; c < std::ssize(mesh.cells); ++c) sum += cell_volume(mesh, c);
  return sum;
}

std::vector<double> cell_means(const TetMesh& mesh, std::span<const double> values) {
  require_one_per_node(mesh, values);
  std::vector<double> means;
  means.reserve(mesh.cells.size());
  for (const Cell& k : mesh.cells) {
    means.push_back(0.25 * (values[k[0]] + values[k[1]] + values[k[2]] + values[k[3]]));
  }
  return means;
}

double share_above_zero(std::array<double, 4> values) {
  std::sort(values.begin(), values.end(), std::greater<>());
  const auto [a, b, c, d] = values;
  // From a node above, how far along the edge to a node below the function stays above zero.
  const auto reach = [](double above, double below) { return above / (above - below); };
  if (!(a > 0)) return 0;
  if (d > 0) return 1;
  if (!(b > 0)) return reach(a, b) * reach(a, c) * reach(a, d);
  if (c > 0) return 1 - reach(-d, -a) * reach(-d, -b) * reach(-d, -c);
  const double ac = reach(a, c), ad = reach(a, d), bc = reach(b, c), bd = reach(b, d);
  return bc * bd + ac * ad * (1 - bd) + ac * bd * (1 - bc);  // three tetrahedra around node a
}

std::vector<Index> cells_mostly_above(const TetMesh& mesh, std::span<const double> values,
                                      double level) {
  require_one_per_node(mesh, values);
  const auto is_finite = [](double x) { return std::isfinite(x); };
  if (!is_finite(level) || !std::all_of(values.begin(), values.end(), is_finite)) {
    throw InputError("mesh: expected finite values and a finite level");
  }
  std::vector<Index> cells;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Cell& k = mesh.cells[c];
    const double share = share_above_zero(
        {values[k[0]] - level, values[k[1]] - level, values[k[2]] - level, values[k[3]] - level});
    if (share > 0.5) cells.push_back(static_cast<Index>(c));
  }
  return cells;
}

std::vector<Index> select_cells(const TetMesh& mesh, std::span<const Index> cells,
                                const CellSelection& selection) {
  std::vector<char> inside = flags_of(mesh, cells);
  const bool fills = selection.fill_cavities || selection.volume_min > 0;
  const bool drops = selection.keep_largest > 0 || selection.volume_min > 0;
  if (fills || drops) {
    const Neighbors neighbors = cell_neighbors(mesh);
    if (fills) fill_cavities(find_parts(mesh, neighbors, inside), selection, inside);
    if (drops) drop_parts(find_parts(mesh, neighbors, inside), selection, inside);
  }
  std::vector<Index> kept;
  for (std::size_t c = 0; c < inside.size(); ++c) {
    if (inside[c]) kept.push_back(static_cast<Index>(c));
  }
  return kept;
}

std::vector<Index> face_parts(const TetMesh& mesh) {
  std::vector<Index> numbers(mesh.cells.size());
  Index number = 0;
  const auto neighbors = cell_neighbors(mesh);
  for (const Part& part : find_parts(mesh, neighbors, std::vector<char>(mesh.cells.size(), 1))) {
    for (const Index cell : part.cells) numbers[cell] = number;
    ++number;
  }
  return numbers;
}

std::int64_t count_face_parts(const TetMesh& mesh) {
  const std::vector<char> all(mesh.cells.size(), 1);
  return std::ssize(find_parts(mesh, cell_neighbors(mesh), all));
}

RestrictedMesh restrict_mesh(const TetMesh& mesh, std::span<const Index> cells) {
  flags_of(mesh, cells);  // checks them
  std::vector<Index> place(mesh.points.size(), kNoIndex);
  for (const Index c : cells) {
    for (const Index n : mesh.cells[static_cast<std::size_t>(c)]) place[n] = 0;
  }
  RestrictedMesh part;
  for (std::size_t n = 0; n < place.size(); ++n) {
    if (place[n] == kNoIndex) continue;
    place[n] = static_cast<Index>(part.nodes.size());
    part.nodes.push_back(static_cast<Index>(n));
    part.mesh.points.push_back(mesh.points[n]);
  }
  part.mesh.cells.reserve(cells.size());
  for (const Index c : cells) {
    const Cell& k = mesh.cells[static_cast<std::size_t>(c)];
    part.mesh.cells.push_back({place[k[0]], place[k[1]], place[k[2]], place[k[3]]});
  }
  return part;
}

}  // namespace mesamis::detail::mesh
