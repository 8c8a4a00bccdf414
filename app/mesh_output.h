// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesamis/io/mesh_files.h"
#include "mesamis/mes_amis.h"

namespace mesamis {

enum class MeshRegion { kBox, kObject };

struct MeshOptions {
  MeshRegion region = MeshRegion::kBox;
  int bins = 10;  ///< 1 to kMostBins
};
inline constexpr int kMostBins = 999;

/// Cells whose native value lies in a range.
struct MeshBin {
  double low = 0, high = 0;  ///< native units
  std::int64_t cells = 0;
  double volume = 0;       ///< mm^3
  double native_mean = 0;  ///< by volume; 0 for an empty bin
};

/// The mesh of a run as it is written: a region of it, its fields, its cells in bins.
struct MeshOutput {
  MeshOptions options;
  double level_native = 0;  ///< the object is where u is above it
  MeshWithArrays grid;      ///< as docs/formats.md lists them
  std::vector<MeshBin> bins;
  CellSets sets;                ///< of the bins
  double volume = 0;            ///< mm^3
  std::int64_t components = 0;  ///< connected by faces
};

/// @param volume       the scan the result is of.
/// @throws InputError  if no cell belongs to the object.
MeshOutput make_mesh_output(const Result& result, const Volume& volume, const MeshOptions& options);

/// By extension, in any of the formats of written_mesh_formats().
void write_mesh(const std::filesystem::path& path, const MeshOutput& mesh, Frame frame);
std::vector<std::string> written_mesh_formats();

/// T_h^th and v_h^th: the cells of the band alone. .vtu
void write_band_mesh(const std::filesystem::path& path, const Result& result, Frame frame);

/// What the report says of it.
nlohmann::ordered_json region_json(const MeshOutput& mesh);

}  // namespace mesamis
