// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace mesamis {

enum class FileKind { kSurface, kMesh, kVolume };

/// What a file holds by its extension, a final .gz left out: .stl .ply .obj .vtp .vtk are
/// surfaces, .vtu .mesh tetrahedra; everything else, directories too, may be a volume.
FileKind kind_of(const std::filesystem::path& path);

}  // namespace mesamis
