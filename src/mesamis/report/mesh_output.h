// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/method/mes_amis.h"
#include "mesamis/report/label_output.h"
#include "mesamis/shape_files/mesh_files.h"

namespace mesamis::detail::report {

/// What is known of a set of cells.
struct MeshBin {
  double low = 0, high = 0;  ///< of the native values, native units; 0 for an empty set of a label
  std::int64_t cells = 0;
  double volume = 0;       ///< mm^3
  double native_mean = 0;  ///< by volume; 0 for an empty set
};

/// The mesh of a run as it is written: a region of it, its fields, its cells in sets.
struct MeshOutput {
  MeshOptions options;
  std::optional<double>
      level_native;             ///< the object is where u is above it; none: where labels are
  MeshWithArrays grid;          ///< as docs/formats.md lists them
  std::vector<MeshBin> bins;    ///< one per set
  CellSets sets;                ///< of equal ranges of the native value, or of labels
  std::vector<Index> numbers;   ///< of the sets: bins from 1, or labels with 0 as background
  double volume = 0;            ///< mm^3
  std::int64_t components = 0;  ///< connected by faces
};

/// Collects a region of a run's mesh with its fields, and sorts its cells into bins of equal width
/// by their mean native value.
/// @param result   of mes_amis().
/// @param volume   the scan the result is of, native units.
/// @param options  the region, and the number of bins.
/// @throws InputError  if no cell belongs to the object, or there is no bin.
///
/// Memory: a copy of the region and of its fields.
MeshOutput make_mesh_output(const Result& result, const VolumeView& volume,
                            const MeshOptions& options);

/// The same of a run on labels: the cells are sorted by the object that their centroid lies in, see
/// label_sets(); the region is all cells, or those of objects.
/// @param result   of mesh_beside_labels().
/// @param volume   the scan, or the part of it that the result is of.
/// @param objects  with labels that differ.
/// @throws InputError  if the region is that of the objects, and no cell lies within one.
///
/// O(voxels + cells), and as label_sets().
MeshOutput make_mesh_output(const Result& result, const VolumeView& volume,
                            const MeshOptions& options, std::span<const FoundObject> objects);

/// Collects a part of a run's mesh with its fields, as one piece of several. Native means at nodes
/// that it shares with other pieces are of its own cells.
/// @param piece   a result with that part of the mesh.
/// @param volume  the whole scan, native units.
///
/// O(voxels in the piece's box + cells).
MeshWithArrays make_mesh_piece(const Result& piece, const VolumeView& volume);

/// Writes the mesh in the format of the extension, one of written_mesh_formats(); .vtu for any
/// other extension. Each file appears whole or not at all. A .mesh goes with a .sol of the same
/// name that holds its fields.
/// @param frame  of the points, vectors and tensors in the file.
/// @throws InputError  as write_vtu(), write_medit_mesh(), write_gmsh() or write_abaqus().
void write_mesh(const OutputPath& path, const MeshOutput& mesh, Frame frame);

/// The extensions of write_mesh(), with their dots. O(1) time and memory.
std::vector<std::string> written_mesh_formats();

/// Writes the cells of the band alone with v as a .vtu: T_h^th and v_h^th.
/// @param result  of mes_amis().
/// @param frame   of the points in the file.
/// @throws InputError  as write_vtu().
void write_band_mesh(const OutputPath& path, const Result& result, Frame frame);

}  // namespace mesamis::detail::report
