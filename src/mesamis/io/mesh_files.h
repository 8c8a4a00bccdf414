// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mesamis/io/surface_files.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {

/// A named array on the points or the cells of a mesh, `components` values each. Three are a
/// vector; six are a symmetric tensor in VTK's order xx yy zz xy yz xz. Both turn with the frame
/// of the file; any other number of components is written as it is.
struct MeshArray {
  std::string name;
  int components = 1;
  std::vector<double> values;
};

/// Writes an unstructured grid: .vtu, appended binary, zlib. Whole or not at all. The field data
/// say "SPACE" (LPS or RAS) and "LengthUnit" (mm).
/// @param mesh         points in LPS mm.
/// @throws InputError  if an array's size does not fit or the file cannot be written.
void write_vtu(const std::filesystem::path& path, const TetMesh& mesh,
               std::span<const MeshArray> point_arrays, std::span<const MeshArray> cell_arrays,
               Frame frame = Frame::kLps);

/// A mesh of a .vtu, in LPS where the file states its frame, else as the file has it.
struct MeshWithArrays {
  TetMesh mesh;
  std::vector<MeshArray> point_arrays, cell_arrays;
};
/// @throws InputError  if the file is not a .vtu of tetrahedra alone, or is damaged.
MeshWithArrays read_vtu(const std::filesystem::path& path);

/// Medit ASCII .mesh, decimals that read back to the same bits. Whole or not at all.
/// @throws InputError  if a value is not finite or the file cannot be written.
void write_medit_mesh(const std::filesystem::path& path, const TetMesh& mesh,
                      Frame frame = Frame::kLps);
/// Takes Vertices and Tetrahedra, skips every other section and all references.
/// @throws InputError  naming file, line and section; nothing is allocated beyond what a file of
///                     that size can hold.
TetMesh read_medit_mesh(const std::filesystem::path& path);

/// Medit ASCII .sol at the vertices: scalars, or symmetric tensors in the order
/// m11 m12 m22 m13 m23 m33. Errors as above.
void write_medit_scalars(const std::filesystem::path& path,
                         std::span<const std::vector<double>> fields);
void write_medit_metric(const std::filesystem::path& path, std::span<const Sym3> metrics);
/// An isotropic size field (one scalar h per vertex) is read as 1/h^2 times the identity.
/// Whether a tensor is positive definite is for its user to check.
std::vector<Sym3> read_medit_metric(const std::filesystem::path& path);

}  // namespace mesamis
