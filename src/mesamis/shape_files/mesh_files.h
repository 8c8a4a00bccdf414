// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/files/output_path.h"
#include "mesamis/files/reading.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {

/// Which cells of the mesh of a run are written.
enum class MeshRegion {
  kBox,    ///< all
  kObject  ///< those of which more than half lies within the object
};

/// Options for writing the mesh of a run.
struct MeshOptions {
  MeshRegion region = MeshRegion::kBox;
  int bins = 10;  ///< of equal ranges of the native value, 1 to kMostBins; of one object only
};
inline constexpr int kMostBins = 999;

/// The versions of Gmsh's format that are written, both ASCII.
enum class GmshVersion {
  k22,  ///< read by nearly all programs
  k41,  ///< Gmsh's own today; entities, and elements in blocks
};

/// A named array on the points or the cells of a mesh. Three components are a vector, six a
/// symmetric tensor in VTK's order xx yy zz xy yz xz; both turn with the frame of the file. Arrays
/// of any other number of components are written as they are.
struct MeshArray {
  std::string name;
  int components = 1;          ///< values per point or cell, 1 to 1000
  std::vector<double> values;  ///< points or cells times components
};

/// The contents of a .vtu file beside the mesh. The arrays are not copied.
struct VtuOptions {
  std::span<const MeshArray> point_arrays = {};  ///< each of n times its components; names differ
  std::span<const MeshArray> cell_arrays = {};   ///< each of m times its components; names differ
  Frame frame = Frame::kLps;                     ///< of the points, vectors and tensors in the file
};

/// Writes a VTK XML unstructured grid (.vtu): appended binary, zlib, double precision. The field
/// data state "SPACE" (LPS or RAS) and "LengthUnit" (mm). The file appears whole or not at all.
///
/// @param mesh     n points in LPS mm, m cells.
/// @param options  arrays of any unit, and the frame.
/// @throws InputError  if an array's size does not fit, two have the same name, there are more than
///                     2^31 / 4 cells, or the file cannot be written.
///
/// Memory: one block of 32 KiB beside the arguments.
void write_vtu(const OutputPath& path, const TetMesh& mesh, const VtuOptions& options = {});

/// Writes the index of a mesh in pieces, VTK XML (.pvtu), as parallel programs leave it. The file
/// appears whole or not at all.
///
/// @param pieces        file names of write_vtu(), without a folder: they lie beside the index.
/// @param point_arrays, cell_arrays as every piece has them: names and components; their values are
///                      not read.
/// @throws InputError  if the file cannot be written.
void write_pvtu(const OutputPath& path, std::span<const std::string> pieces,
                std::span<const MeshArray> point_arrays, std::span<const MeshArray> cell_arrays);

/// A mesh with its arrays.
struct MeshWithArrays {
  TetMesh mesh;  ///< points in LPS mm where the file states its frame, else as the file has them
  std::vector<MeshArray> point_arrays, cell_arrays;
  bool quadratic = false;  ///< read of cells with mid-side nodes: these are points of no cell
};

/// Reads a VTK XML unstructured grid (.vtu) of one piece of tetrahedra: text, base64 or raw, plain
/// or compressed by zlib. Of quadratic ones the cells have the corners.
///
/// @return n >= 1 points, m cells with indices in [0, n). Cells may have any volume. Arrays of type
///         String are left out.
/// @param limits  as read_surface().
/// @throws InputError  if the file is not such a .vtu, has cells of another type, or is damaged.
///
/// Memory: the file's bytes and the mesh, within the limits.
MeshWithArrays read_vtu(const std::filesystem::path& path, const ReadLimits& limits = {});

/// A partition of the cells of a mesh into named sets, one per material of a finite element model.
struct CellSets {
  struct Set {
    std::string name;  ///< letters, digits and underscores, at most 60; starts with a letter
    std::string note;  ///< one line that goes into comments
  };
  std::vector<Set> sets;
  std::vector<Index> of_cell;  ///< per cell its set, in [0, number of sets)
};

/// Writes Gmsh .msh, version 2.2 ASCII, the version that all readers of the format share. Sets are
/// physical groups, numbered from 1, named where they are not empty; arrays are $NodeData and
/// $ElementData; frame, unit and notes are in $Comments. Numbers of nodes and elements are indices
/// plus 1; decimals read back to the same bits. The file appears whole or not at all.
///
/// @param grid   n points in LPS mm, m >= 1 cells; arrays of one component, finite.
/// @param sets   of_cell has m entries.
/// @param frame  of the points in the file.
/// @throws InputError  if an array or the sets do not fit, there is no cell, an index is out of
///                     range, a value is not finite or the file cannot be written.
///
/// Memory: 1 MiB of text.
void write_gmsh(const OutputPath& path, const MeshWithArrays& grid, const CellSets& sets,
                Frame frame = Frame::kLps);

/// Writes Abaqus .inp, which CalculiX reads too: C3D4 elements, *NSET and *ELSET named ALL, after a
/// comment with its note an *ELSET per set that is not empty; comments show how to make a section
/// of each. Numbers as in write_gmsh(); coordinates to 13 digits, because CalculiX refuses a number
/// of more than 20 characters. The file appears whole or not at all.
///
/// @param mesh   n points in LPS mm, m >= 1 cells.
/// @param sets   of_cell has m entries.
/// @param frame  of the points in the file.
/// @throws InputError  as write_gmsh(). Cost as write_gmsh().
void write_abaqus(const OutputPath& path, const TetMesh& mesh, const CellSets& sets,
                  Frame frame = Frame::kLps);

/// Writes Medit ASCII .mesh with decimals that read back to the same bits. The file appears whole
/// or not at all.
///
/// @param mesh        n points in LPS mm, m cells.
/// @param frame       of the points in the file.
/// @param references  m integers, Medit's labels of cells; none: all 0.
/// @throws InputError  if the references are neither m nor none, a coordinate is not finite or the
///                     file cannot be written.
///
/// Memory: 1 MiB of text.
void write_medit_mesh(const OutputPath& path, const TetMesh& mesh, Frame frame = Frame::kLps,
                      std::span<const Index> references = {});

/// Reads Vertices and Tetrahedra of a Medit ASCII .mesh; other sections and all references are left
/// out.
///
/// @return points as the file has them: the format states neither frame nor unit.
/// @param limits  as read_surface().
/// @throws InputError  naming file, line and section.
///
/// Memory: the file's bytes and the mesh, within the limits.
TetMesh read_medit_mesh(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Writes scalar fields as Medit ASCII .sol: SolAtVertices, and SolAtTetrahedra if there are fields
/// on cells. The file appears whole or not at all.
///
/// @param fields       k fields of n values each, one per point, any unit.
/// @param cell_fields  fields of m values each, one per cell, any unit.
/// @throws InputError  if the sizes differ, a value is not finite or the file cannot be written.
///
/// Memory: 1 MiB of text.
void write_medit_scalars(const OutputPath& path, std::span<const std::vector<double>> fields,
                         std::span<const std::vector<double>> cell_fields = {});

/// Writes a metric as Medit ASCII .sol at the vertices, in the order m11 m12 m22 m13 m23 m33. The
/// file appears whole or not at all.
///
/// @param metrics  one symmetric matrix per point, in 1/mm^2.
/// @throws InputError  if a value is not finite or the file cannot be written.
///
/// Memory: 1 MiB of text.
void write_medit_metric(const OutputPath& path, std::span<const Sym3> metrics);

/// Reads a metric of a Medit ASCII .sol at the vertices. A scalar size h in mm becomes 1/h^2 times
/// the identity.
///
/// @return one matrix per vertex, in 1/mm^2; whether it is positive definite is not checked.
/// @param limits  as read_surface().
/// @throws InputError  naming file, line and section.
std::vector<Sym3> read_medit_metric(const std::filesystem::path& path,
                                    const ReadLimits& limits = {});

}  // namespace mesamis
