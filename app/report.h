// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesamis/io/read_volume.h"
#include "mesamis/io/surface_files.h"
#include "mesamis/mes_amis.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

struct InputFacts {
  std::filesystem::path path;
  std::string format, sha256, modality;
  std::array<Index, 3> size{0, 0, 0};
  Vec3 spacing;
  double lowest = 0, highest = 0;  ///< native units
  std::vector<std::string> warnings;
  Frame frame = Frame::kLps;  ///< of the files written
};
InputFacts facts_of(const std::filesystem::path& path, const VolumeFile& file, Frame frame);

/// "seconds" and "peak_memory_mb" of the program so far: the end of every report.
void add_costs(nlohmann::ordered_json& report);

/// How a solid was made printable: tolerance, triangles before, distances, parts.
nlohmann::ordered_json printable_json(const PrintableReport& printable, const Settings& settings);

/// Why a surface is farther off than it should be, on one line.
std::string tolerance_unmet(double tolerance, const PrintableReport& printable);

/// What a surface consists of, and whether it is closed.
nlohmann::ordered_json check_json(const TriMesh& surface, const SurfaceCheck& check);

/// Settings with the values used, so that a run can be repeated from its report.
Settings settings_used(const Result& result);

/// What a report says of a run itself: settings, chosen, grey, image, iterations, mesh, surface,
/// converged, seconds_parts.
/// @param settings  those asked for, to tell what was chosen automatically.
nlohmann::ordered_json run_json(const Settings& settings, const Result& result,
                                const SurfaceCheck& surface);

/// "path", "format", "sha256", ... of the scan a report is about.
nlohmann::ordered_json input_json(const InputFacts& input);

/// The report of a run, as docs/formats.md describes it.
nlohmann::ordered_json segment_report(const InputFacts& input, const Settings& settings,
                                      const Result& result, const SurfaceCheck& surface);

}  // namespace mesamis
