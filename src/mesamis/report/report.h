// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/files/output_set.h"
#include "mesamis/files/read_record.h"
#include "mesamis/image/volume.h"
#include "mesamis/method/expected_error.h"
#include "mesamis/method/mes_amis.h"
#include "mesamis/report/mesh_output.h"
#include "mesamis/report/run_summary.h"
#include "mesamis/surface/tri_mesh.h"

/// The entries of reports, as docs/formats.md describes them.
namespace mesamis::detail::report {

/// The scan a report is about.
struct InputFacts {
  std::filesystem::path path;
  std::string format, sha256, modality;
  std::array<Index, 3> size{0, 0, 0};            ///< voxels
  Vec3 spacing;                                  ///< mm
  std::optional<std::array<double, 2>> range{};  ///< of the samples, native units; none: not read
  std::vector<std::string> warnings;             ///< of the reader
  Vec3 origin{};                                 ///< LPS, mm; see VoxelGrid::origin
  Mat3 direction{};                              ///< LPS; see VoxelGrid::direction
};

/// Where a scan comes from, as its reader tells.
struct ScanSource {
  std::filesystem::path path;         ///< that the user named
  std::string format;                 ///< "DICOM"
  std::vector<std::string> warnings;  ///< of the reader
  std::vector<ReadFile> files;        ///< that were read; their bytes make the sha256
};

/// Collects the facts of a scan that a report gives.
/// @param volume  as it was read; native units. Without samples there is no range, and without
///                files no sha256.
/// @throws InputError  if a file cannot be read again for its sha256, or has changed meanwhile.
InputFacts facts_of(const ScanSource& source, const VolumeView& volume);

/// The entry "input" of a report: "path", "format", "sha256", ... of its scan; what is not known
/// of path and sha256 is null.
nlohmann::ordered_json input_json(const InputFacts& input);

/// The entry "program" of every report: name, version, commit.
nlohmann::ordered_json program_json();

/// The program as the producer of a file: "mesamis VERSION (COMMIT)".
std::string producer();

/// The entry "output": the frame of the files written, the threads used.
nlohmann::ordered_json output_json(Frame frame);

/// The entry "files": path, bytes and sha256 of each file of a set. A set of files is whole where
/// they are those of the report that lies beside them, which belongs to the set and comes last.
/// @throws InputError  if a file cannot be read again.
nlohmann::ordered_json files_json(const OutputSet& set);

/// How a solid was made printable: tolerance, triangles before, distances (mm), parts.
/// @param tolerance  mm; infinite where there was no bound.
nlohmann::ordered_json printable_json(const PrintableReport& printable, double tolerance);

/// What a report says of settings: settings, chosen, given, grey.
/// @param asked  the settings the run was started with, to tell what was chosen.
nlohmann::ordered_json settings_used_json(const Settings& asked, const Parameters& used,
                                          const MeasuredImage& image);

/// What was found out about a scan: noise, blur, contrast, as docs/formats.md lists them.
nlohmann::ordered_json image_json(const Parameters& parameters, const MeasuredImage& image);

/// How near to the truth a surface can be expected to be: mean, p95, max, mm; or null.
nlohmann::ordered_json error_json(const ErrorSummary& error);

/// The counts, volume and area of a surface, and whether it is closed.
nlohmann::ordered_json check_json(const TriMesh& surface, const SurfaceCheck& check);

/// What a report says of a run itself: settings, chosen, given, grey, image, iterations, mesh,
/// surface, converged, stopped, seconds_parts.
/// @param asked  the settings the run was started with, to tell what was chosen.
/// @throws InputError  as summarize(). Cost as there.
nlohmann::ordered_json run_json(const Settings& asked, const Result& result,
                                const SurfaceCheck& surface);

/// The same of a run whose figures were taken before.
nlohmann::ordered_json run_json(const Settings& asked, const RunSummary& run);

/// Of those the iterations and the mesh alone.
nlohmann::ordered_json loop_json(const RunSummary& run);

/// The region of a mesh that was written, and its sets of cells.
nlohmann::ordered_json region_json(const MeshOutput& mesh);

}  // namespace mesamis::detail::report
