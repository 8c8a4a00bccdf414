// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/mesh_checks.h"

#include "mesamis/files/refuse.h"

namespace mesamis::detail::shape_files {

void require_sets(const std::filesystem::path& path, const TetMesh& mesh, const CellSets& sets) {
  if (mesh.cells.empty()) refuse(path, "a mesh without cells cannot be written");
  if (sets.of_cell.size() != mesh.cells.size()) {
    refuse(path, message("expected a set for each of ", mesh.cells.size(), " cells, found ",
                         sets.of_cell.size()));
  }
  for (const Index set : sets.of_cell) {
    if (set < 0 || set >= std::ssize(sets.sets)) {
      refuse(path, message("a cell names set ", set, ", there are ", sets.sets.size()));
    }
  }
  for (const Cell& cell : mesh.cells) {
    for (const Index n : cell) {
      if (n < 0 || n >= std::ssize(mesh.points)) refuse(path, "a cell names a missing point");
    }
  }
}

std::vector<std::int64_t> cells_per_set(const CellSets& sets) {
  std::vector<std::int64_t> counts(sets.sets.size(), 0);
  for (const Index set : sets.of_cell) ++counts[static_cast<std::size_t>(set)];
  return counts;
}

}  // namespace mesamis::detail::shape_files
