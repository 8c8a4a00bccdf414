// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "mesamis/rooms.h"
#include "mesamis/shape_files/mesh_files.h"

/// What the writers of finite element formats share.
namespace mesamis::detail::shape_files {

/// @throws InputError  if the mesh is empty, a cell has no set or an index is out of range.
void require_sets(const std::filesystem::path& path, const TetMesh& mesh, const CellSets& sets);

/// How many cells each set has.
std::vector<std::int64_t> cells_per_set(const CellSets& sets);

}  // namespace mesamis::detail::shape_files
