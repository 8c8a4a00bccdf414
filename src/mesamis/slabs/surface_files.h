// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mesamis/slabs/mesh_files.h"
#include "mesamis/slabs/surface_tasks.h"

/// What the tasks on the surface share, and what they find of the mesh.
namespace mesamis::detail::slabs {

/// The last mesh of slab s, its own cells.
/// @param work  optional: where the bytes of another slab are counted.
Piece read_final(const MeshRun& run, int k, Index s, SlabWork* work = nullptr);
/// The same, its nodes in the order of their places. Nodes that it shares with lower slabs have the
/// u of these.
Piece final_mesh(const SurfaceRun& run, Index s, SlabWork& work);
/// The file of the nodes of the last mesh of slab s that are nodes of other slabs too: places and
/// u.
std::string shared_nodes_file(int k, Index s);
/// The height of the highest node of mesh k of slab s, length units.
double top_of_mesh(const MeshRun& run, int k, Index s);

inline std::string surface_file(const char* what, Index s) {
  return "surface." + std::string(what) + "." + std::to_string(s);
}

inline void write_surface(const Scratch& scratch, const std::string& name,
                          const SurfacePiece& piece) {
  ArchiveWriter archive;
  add_surface(archive, piece);
  scratch.write(name, archive);
}

/// @param work  optional: where the bytes of another slab are counted.
inline SurfacePiece read_surface(const Scratch& scratch, const std::string& name,
                                 SlabWork* work = nullptr) {
  ArchiveReader archive = scratch.read(name);
  if (work != nullptr) work->bytes += static_cast<std::int64_t>(archive.size());
  return next_surface(archive);
}

/// The surface of slab s before decimation, with that at its upper border. Its points are where
/// they are to be.
/// @param work  optional, as for read_surface().
SurfacePiece surface_of(const SurfaceRun& run, Index s, SlabWork* work = nullptr);
/// The same of the parts that stay.
SurfacePiece chosen_surface_of(const SurfaceRun& run, Index s, SlabWork* work = nullptr);

/// What slab s delivers: its decimated surface, and that at its upper border.
/// @param work  optional, as for read_surface().
std::vector<SurfacePiece> decimated_by(const SurfaceRun& run, Index s, SlabWork* work = nullptr);
/// The whole surface of the parts that stay, decimated.
SurfacePiece decimated_piece(const SurfaceRun& run);

/// A piece where it is in the world; mm. In a left-handed grid its triangles face inward.
TriMesh in_world(const SurfaceRun& run, const SurfacePiece& piece);
/// The same in single precision.
TriMesh rounded_in_world(const SurfaceRun& run, const SurfacePiece& piece);

}  // namespace mesamis::detail::slabs
