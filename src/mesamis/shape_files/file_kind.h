// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesamis/rooms.h"
#include "mesamis/shape_files/mesh_files.h"

namespace mesamis::detail::shape_files {

/// What a file holds.
enum class FileKind {
  kSurface,  ///< triangles: read_surface() reads it
  kMesh,     ///< tetrahedra: read_mesh() reads it
  kVolume,   ///< perhaps a scan
};

/// Tells what a file holds by its extension, in either case and without a final .gz: .stl .ply .obj
/// .vtp .3mf .amf .glb .vtk are surfaces, .vtu .mesh are tetrahedra. Anything else, a directory
/// with any name too, may be a scan; a file that begins like an Encapsulated STL or OBJ in DICOM is
/// a surface.
/// @param path  need not exist.
FileKind kind_of(const std::filesystem::path& path);

/// Reads tetrahedra by extension, in either case: Medit .mesh, without arrays, or .vtu.
/// @return mm; in LPS where a .vtu states its frame, else as the file has it.
/// @throws InputError  as read_medit_mesh() and read_vtu(), which refuses any other extension.
///
/// O(bytes of the file) time and memory.
MeshWithArrays read_mesh(const std::filesystem::path& path, const ReadLimits& limits = {});

}  // namespace mesamis::detail::shape_files
