// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "mesamis/mesh/finite_elements.h"
#include "mesamis/shape_files/element_files.h"

/// The formats behind element_files.h. They take elements that write_elements() has checked.
namespace mesamis::detail::shape_files {

/// The cells of each of `count` groups, in increasing order.
std::vector<std::vector<Index>> cells_by_group(const std::vector<Index>& group_of_cell,
                                               std::size_t count);

void write_abaqus_elements(const OutputPath& path, const FiniteElements& elements,
                           const ElementWriteOptions& options);
void write_febio(const OutputPath& path, const FiniteElements& elements,
                 const ElementWriteOptions& options);
void write_gmsh_elements(const OutputPath& path, const FiniteElements& elements,
                         const ElementWriteOptions& options);

/// Part, and where there are materials material (from 1), modulus, density and Poisson ratio of
/// each cell: what formats without materials state.
std::vector<MeshArray> material_arrays(const FiniteElements& elements);

}  // namespace mesamis::detail::shape_files
