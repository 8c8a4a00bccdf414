// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "mesamis/files/output_path.h"
#include "mesamis/image/volume.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

/// What came out of a run, as one HTML file that anyone can open, and as pictures.
namespace mesamis::detail::page {

/// A surface on a page.
struct PageSurface {
  const TriMesh* surface = nullptr;      ///< LPS, mm; sound, see require_sound()
  std::string name{};                    ///< may be empty
  std::array<std::uint8_t, 3> colour{};  ///< red, green, blue (sRGB)
  std::span<const double> error{};       ///< expected at its points, mm; empty: not known
};

/// The most bytes of a page.
inline constexpr std::size_t kLargestPage = 10'000'000;

/// What a page shows. All but the report may be missing; the page then says so.
struct RunPage {
  nlohmann::json report;                ///< of `segment`, see docs/formats.md
  const Volume* scan = nullptr;         ///< as it was read; usable, see require_usable()
  std::vector<PageSurface> surfaces{};  ///< one per object
  const TetMesh* mesh = nullptr;        ///< LPS, mm
  std::span<const double> grey{};       ///< u at the nodes of the mesh, grey values
  bool names = false;                   ///< show paths and file names, which may name a patient
  std::size_t most = kLargestPage;      ///< bytes of the page, as a goal
};

/// Makes a page that needs no network: pictures, diagrams and tables of the run and, where there is
/// a scan, a viewer: its slices with the outlines of the surfaces, and the surfaces to turn. It
/// opens on the surfaces.
///
/// The scan is cropped to no part, but thinned and brought to 256 steps, and surfaces lose
/// triangles, as far as the bound `most` asks for. Where that is not enough, the viewer is left
/// out, then the pictures, and the page says so; tables and texts are never cut. The page holds
/// times, memory and threads nowhere.
/// @param page  see there.
/// @return UTF-8; the same bytes for the same input. A value of the report is an element `data`
///         with the exact value and its JSON pointer.
/// @throws InputError  if a surface is not sound, its errors are not one per point, or the grey
///                     values are not one per node of the mesh.
///
/// O(voxels + triangles log(triangles) + cells). Memory: a few times the page, and 16 bytes per
/// voxel shown.
std::string run_page(const RunPage& page);

/// Writes run_page() to a file, which appears whole or not at all.
/// @param file  its folder must exist.
/// @throws InputError  as run_page(), or if the file cannot be written. Cost as there.
void write_run_page(const OutputPath& file, const RunPage& page);

/// A picture of a run.
struct RunPicture {
  std::string name;  ///< of its file: "slice-axial.png"
  std::string png;   ///< its bytes
};

/// Draws a run without any display: the surfaces from four sides, three slices with their outlines,
/// the mesh cut open. What is missing is not drawn.
/// @param pixels  along the longer side of each picture, 64 to 4096.
/// @return the same bytes for the same input.
/// @throws InputError  as run_page(), or if the size is out of range.
///
/// O(voxels of the slices + triangles log(triangles) + cells + pixels).
std::vector<RunPicture> run_pictures(const RunPage& page, int pixels = 1000);

}  // namespace mesamis::detail::page
