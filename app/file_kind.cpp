// SPDX-License-Identifier: Apache-2.0
#include "file_kind.h"

#include <algorithm>
#include <array>
#include <string>

#include "outputs.h"

namespace mesamis {
FileKind kind_of(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return FileKind::kVolume;
  std::string extension = lower_extension(path);
  if (extension == ".gz") extension = lower_extension(path.stem());
  constexpr std::array kSurfaces{".stl", ".ply", ".obj", ".vtp", ".3mf", ".amf", ".vtk"};
  const bool surface = std::find(kSurfaces.begin(), kSurfaces.end(), extension) != kSurfaces.end();
  if (surface) return FileKind::kSurface;
  return extension == ".vtu" || extension == ".mesh" ? FileKind::kMesh : FileKind::kVolume;
}

}  // namespace mesamis
