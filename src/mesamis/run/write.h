// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/files/dicom_subject.h"
#include "mesamis/page/page_files.h"
#include "mesamis/run/outcome.h"
#include "mesamis/shape_files/mesh_files.h"
#include "mesamis/shape_files/surface_files.h"

namespace mesamis {

/// The files of a run; empty names are not written. The extension is the format.
struct Outputs {
  std::vector<std::filesystem::path> surfaces{};     ///< see written_surface_formats()
  std::vector<std::filesystem::path> meshes{};       ///< .vtu .msh .inp .mesh
  std::vector<std::filesystem::path> band_meshes{};  ///< .vtu
  std::vector<std::filesystem::path> bodies{};       ///< .inp .feb .msh .vtu .mesh
  std::filesystem::path labelmap{};                  ///< .nii .nii.gz .nrrd .seg.nrrd
  std::filesystem::path report{};                    ///< .json, see docs/formats.md
  PageFiles page{};

  Frame frame = Frame::kLps;  ///< of the points in the files
  /// Of the whole surface; never the scan's, which may name the patient.
  std::string name = kSurfaceName;
  bool error = false;                   ///< write the expected error at each point, mm
  DicomSubject subject{};               ///< of surfaces in DICOM
  MeshOptions mesh{};                   ///< region and bins of the meshes
  GmshVersion gmsh = GmshVersion::k22;  ///< of bodies
};

/// Writes the files of a run, which appear together or not at all.
/// @throws InputError  one line, if a name has another extension, a requested surface was not found, or a file cannot be written.
///
/// Memory: the bytes of a file at a time.
void write(const Outcome& outcome, const Outputs& outputs);

/// The report of a run as JSON (UTF-8), as docs/formats.md describes it, without the entry "files".
/// @throws InputError  as write().
std::string report_text(const Outcome& outcome);

}  // namespace mesamis
