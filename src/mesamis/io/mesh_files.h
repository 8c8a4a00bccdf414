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

/// Sets of cells that share none, each cell in one: what a finite element user gives a material.
struct CellSets {
  struct Set {
    std::string name;  ///< letters, digits and underscores, at most 60; starts with a letter
    std::string note;  ///< what it holds: one line that goes into comments
  };
  std::vector<Set> sets;
  std::vector<Index> of_cell;  ///< each cell's set, from 0
};

/// Gmsh .msh, version 2.2 ASCII: the one of the format's versions that its readers have in common.
/// Sets are physical groups, numbered from 1, named where they are not empty; arrays are $NodeData
/// and $ElementData; frame, unit and notes stand in $Comments. Numbers of nodes and elements are
/// indices plus 1; decimals read back to the same bits. Whole or not at all.
/// @param grid         points in LPS mm; arrays of one component.
/// @throws InputError  if an array or the sets do not fit, there is no cell, a value is not finite
///                     or the file cannot be written.
void write_gmsh(const std::filesystem::path& path, const MeshWithArrays& grid, const CellSets& sets,
                Frame frame = Frame::kLps);

/// Abaqus .inp, also read by CalculiX: C3D4 elements, *NSET and *ELSET named ALL, an *ELSET per set
/// that is not empty, after a comment with its note; commented lines show how a section is made of
/// each. Numbers as in write_gmsh; coordinates to 13 digits, because CalculiX refuses a number of
/// more than 20 characters. Whole or not at all.
/// @throws InputError  as write_gmsh.
void write_abaqus(const std::filesystem::path& path, const TetMesh& mesh, const CellSets& sets,
                  Frame frame = Frame::kLps);

/// Medit ASCII .mesh, decimals that read back to the same bits. Whole or not at all.
/// @param references   one per cell, or none: all 0.
/// @throws InputError  if there are as many references as neither, a value is not finite or the
///                     file cannot be written.
void write_medit_mesh(const std::filesystem::path& path, const TetMesh& mesh,
                      Frame frame = Frame::kLps, std::span<const Index> references = {});
/// Takes Vertices and Tetrahedra, skips every other section and all references.
/// @throws InputError  naming file, line and section; nothing is allocated beyond what a file of
///                     that size can hold.
TetMesh read_medit_mesh(const std::filesystem::path& path);

/// Medit ASCII .sol at the vertices: scalars, or symmetric tensors in the order
/// m11 m12 m22 m13 m23 m33. Scalars at the tetrahedra, if there are any, follow in a section of
/// their own. Errors as above.
void write_medit_scalars(const std::filesystem::path& path,
                         std::span<const std::vector<double>> fields,
                         std::span<const std::vector<double>> cell_fields = {});
void write_medit_metric(const std::filesystem::path& path, std::span<const Sym3> metrics);
/// An isotropic size field (one scalar h per vertex) is read as 1/h^2 times the identity.
/// Whether a tensor is positive definite is for its user to check.
std::vector<Sym3> read_medit_metric(const std::filesystem::path& path);

}  // namespace mesamis
