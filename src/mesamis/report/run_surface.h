// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mesamis/method/mes_amis.h"
#include "mesamis/shape_files/surface_files.h"

/// The surface of a run as a file: what is written beside its triangles.
namespace mesamis::detail::report {

/// What a user decides of a surface file.
struct RunSurfaceOptions {
  Frame frame = Frame::kLps;
  std::string name = kSurfaceName;  ///< of the object
  bool error = false;               ///< add the expected error at each point, mm
  bool grey = false;                ///< some file carries_grey(): find grey values
  DicomSubject subject{};           ///< of files in DICOM
};

/// Collects what the files of a run's surface hold beside it: the name, marked where the run was a
/// preview, the program and the settings, grey values, the expected error.
/// @param voxel  mm, >= 0, see surface_grey().
/// @throws InputError  as surface_grey().
///
/// O(points); with grey values as surface_grey().
SurfaceWriteOptions surface_options(const Result& result, double voxel,
                                    const RunSurfaceOptions& options);

/// Refuses a run that found nothing.
/// @param asked  the settings the run was started with: only they are named as given.
/// @throws InputError  if the surface has no triangle: which bound left nothing is what the user
///                     can change.
void require_surface(const Result& result, const Settings& asked);

}  // namespace mesamis::detail::report
