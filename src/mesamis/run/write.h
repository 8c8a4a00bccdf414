// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/frame.h"
#include "mesamis/delivery/mesh_output.h"
#include "mesamis/files/dicom_subject.h"
#include "mesamis/files/output_set.h"
#include "mesamis/page/page_files.h"
#include "mesamis/record/report.h"
#include "mesamis/record/run_surface.h"
#include "mesamis/run/outcome.h"
#include "mesamis/shape_files/element_files.h"

namespace mesamis {

/// What a report says beside the outcome.
struct ReportFacts {
  std::optional<InputFacts> input{};    ///< of the scan; none: it has no entry "input"
  std::vector<std::string> warnings{};  ///< of the readers of label files, one line each
  std::vector<std::string> command{};   ///< the command line; empty: no entry
  std::string mask{};                   ///< the file of the mask; empty: none
  /// Adds entries at the end, before the report is written. May be empty.
  std::function<void(nlohmann::ordered_json& report)> complete{};
  /// Sees the report; what it writes appears with the other files. May be empty.
  std::function<void(const nlohmann::ordered_json& report)> written{};
};

/// The files of a run; those whose name is empty are not written. The extension is the format.
struct Outputs {
  std::vector<std::filesystem::path> surfaces{};     ///< see written_surface_formats()
  std::vector<std::filesystem::path> meshes{};       ///< see written_mesh_formats()
  std::vector<std::filesystem::path> band_meshes{};  ///< .vtu
  std::vector<std::filesystem::path> bodies{};       ///< see write_elements()
  std::filesystem::path labelmap{};                  ///< .nii .nii.gz .nrrd .seg.nrrd
  std::filesystem::path report{};                    ///< .json
  PageFiles page{};

  Frame frame = Frame::kLps;        ///< of the points in the files
  std::string name = kSurfaceName;  ///< of the whole; never the scan's, which may be the patient's
  bool error = false;               ///< write the error expected at each point, mm
  DicomSubject subject{};           ///< of surfaces in DICOM
  MeshOptions mesh{};               ///< region and bins of the meshes
  GmshVersion gmsh = GmshVersion::k22;  ///< of bodies
  ReportFacts facts{};
  std::function<std::optional<Volume>()> shown_scan{};  ///< of the page, as it is in its file

  /// Whether anything shows the report.
  bool wants_report() const { return !report.empty() || facts.written || page.given(); }
};

/// The report of a run without the entry "files", as docs/formats.md describes it.
nlohmann::ordered_json report_json(const Outcome& outcome, const Outputs& outputs);

/// Writes the files of a run, which appear together or not at all.
/// @throws InputError  as the writers, or if a surface is asked for and none was found.
void write(const Outcome& outcome, const Outputs& outputs);

/// The same into a set that the caller commits.
/// @param set  empty; that of the calling thread.
void write(const Outcome& outcome, const Outputs& outputs, OutputSet& set);

}  // namespace mesamis
