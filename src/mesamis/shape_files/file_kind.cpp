// SPDX-License-Identifier: Apache-2.0
#include "mesamis/shape_files/file_kind.h"

#include <algorithm>
#include <array>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"
#include "mesamis/shape_files/surface_formats.h"

namespace mesamis::detail::shape_files {
namespace {

/// DICOM holds images, labels and surfaces. What cannot be read may be a scan.
bool is_surface_in_dicom(const std::filesystem::path& path) {
  try {
    return is_encapsulated(path);
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

FileKind kind_of(const std::filesystem::path& path) {
  std::error_code error;  // of a path that cannot be followed: it may be a scan
  if (std::filesystem::is_directory(path, error)) return FileKind::kVolume;
  std::string extension = lower_extension(path);
  if (extension == ".gz") extension = lower_extension(path.stem());
  constexpr std::array kSurfaces{".stl", ".ply", ".obj", ".vtp", ".3mf", ".amf", ".glb", ".vtk"};
  const bool surface = std::find(kSurfaces.begin(), kSurfaces.end(), extension) != kSurfaces.end();
  if (surface) return FileKind::kSurface;
  if (extension == ".vtu" || extension == ".mesh") return FileKind::kMesh;
  return is_surface_in_dicom(path) ? FileKind::kSurface : FileKind::kVolume;
}

MeshWithArrays read_mesh(const std::filesystem::path& path, const ReadLimits& limits) {
  if (lower_extension(path) == ".mesh") return {read_medit_mesh(path, limits), {}, {}};
  return read_vtu(path, limits);
}

}  // namespace mesamis::detail::shape_files
