// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "mesamis/base/types.h"
#include "mesamis/mesh/finite_elements.h"
#include "mesamis/rooms.h"
#include "mesamis/shape_files/mesh_files.h"

/// Bodies of finite elements as the input of solvers.
namespace mesamis::detail::shape_files {

/// What a file holds beside the elements. The arrays are not copied.
struct ElementWriteOptions {
  std::span<const MeshArray> point_arrays = {};  ///< each of all points; .vtu and .msh write them
  std::span<const MeshArray> cell_arrays = {};   ///< each of all cells; .vtu and .msh write them
  Frame frame = Frame::kLps;                     ///< of the points, vectors and tensors in the file
  GmshVersion gmsh = GmshVersion::k22;
};

/// Writes elements by extension, in either case. Point i and cell i, from 0, have the number i + 1.
/// The file appears whole or not at all.
///
/// - .inp: Abaqus and CalculiX, C3D4 or C3D10; *NSET and *ELSET per part; per material an *ELSET,
///   *MATERIAL with *ELASTIC in MPa and *DENSITY in tonne/mm^3, and *SOLID SECTION; per set *NSET
///   and *SURFACE. With materials, only a *STEP is missing.
/// - .feb: FEBio 4.0, tet4 or tet10, a domain per part and material, isotropic elastic materials
///   with density in tonne/mm^3, NodeSet and Surface per set. A step is missing.
/// - .msh: Gmsh; physical groups of dimension 3 for parts and of dimension 2 for sets of faces.
/// - .vtu: VTK; type 10 or 24.
/// - .mesh: Medit; linear elements alone, parts as references (from 1), no sets.
///
/// .msh and .vtu have the cell arrays part (from 1) and, with materials, material (from 1),
/// modulus in MPa, poisson and density in g/cm^3.
///
/// @param elements  n points in LPS mm, m >= 1 cells.
/// @throws InputError  if the extension is none of these, .mesh is asked for with mid-side nodes, a
///                     size, an index, a name, a material or an array does not fit, a coordinate is
///                     not finite, or the file cannot be written.
///
/// Memory: 1 MiB of text, and 4 bytes per cell and part's node.
void write_elements(const OutputPath& path, const FiniteElements& elements,
                    const ElementWriteOptions& options = {});

}  // namespace mesamis::detail::shape_files
