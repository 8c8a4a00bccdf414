// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// The frame a file's coordinates are given in: LPS (DICOM, ITK) or RAS (x and y negated).
enum class Frame { kLps, kRas };
/// "LPS" or "RAS".
const char* frame_name(Frame frame);

/// A value per point of a surface.
struct PointArray {
  std::string name;
  std::vector<double> values;
};

struct SurfaceWriteOptions {
  /// Stated in the file: "SPACE=LPS", as 3D Slicer writes and reads it. Without one nothing is
  /// stated, and coordinates are written as they are given.
  std::optional<Frame> frame = Frame::kLps;
  std::string name{};  ///< what the object is called
  /// .3mf, .amf, .vtp: a grey value per point, 0 (black) to 255; empty: none
  std::vector<double> grey{};
  /// .3mf, .amf: further facts as type and text; "producer" is the program. Nothing about the
  /// patient belongs here.
  std::vector<std::pair<std::string, std::string>> metadata{};
  std::vector<PointArray> point_arrays{};  ///< .vtp: finite values to colour by
};

/// Writes a surface by extension. The file appears whole or not at all (written beside, then
/// renamed).
///
///   .stl  binary, single precision. What is closed stays closed, see round_to_single().
///   .ply  binary, double precision (what reads PLY in this field takes it)
///   .obj  text, double precision
///   .vtp  VTK XML, appended binary, double precision
///   .3mf  3MF with colours as the materials extension has them, single precision, six decimals,
///         millimetres; grey values are colours of the triangles' corners
///   .amf  AMF 1.1 (ISO/ASTM 52915), text, double precision, millimetres, with grey values as
///         colours of the points
///
/// Frame and name stand in the header (.stl, cut at 80 bytes), in comments (.ply, .obj), in
/// field data (.vtp) or in metadata (.3mf, .amf).
/// @param surface  points in LPS mm.
/// @throws InputError  for another extension, an empty or unsound surface, a number of grey values
///                     or of an array's that is not that of the points, a value that is not
///                     finite, or a file that cannot be written.
void write_surface(const std::filesystem::path& path, const TriMesh& surface,
                   const SurfaceWriteOptions& options = {});

/// The extensions above, with their dots.
std::vector<std::string> written_surface_formats();

/// Whether the format of this extension has a place for SurfaceWriteOptions::grey.
bool carries_grey(const std::filesystem::path& path);

/// Reads .stl .ply .obj (text or binary where there are both), .vtp, .3mf, .amf (not zipped),
/// legacy .vtk, also gzip'd (.gz). Equal points of an STL are welded; polygons are cut into fans.
/// Coordinates are returned as the file has them, in mm where it names its unit: no frame is
/// assumed or changed.
/// @return at least one triangle; indices in range, finite coordinates; else as the file has it.
/// @throws InputError  one line: the file, what was expected and what was found.
TriMesh read_surface(const std::filesystem::path& path);

/// A surface and the frame its file states in one of the places above, or in the title or a field
/// of a legacy .vtk; none if it states none, or another than LPS and RAS.
struct SurfaceFile {
  TriMesh surface;  ///< as read_surface()
  std::optional<Frame> frame;
};
SurfaceFile read_surface_file(const std::filesystem::path& path);

/// LPS to RAS and back: x and y negated, which is a rotation, so that triangles face as before.
TriMesh turned(TriMesh surface);

/// The surface in LPS where its file states a frame, else as the file has it.
TriMesh in_lps(const SurfaceFile& file);

/// The values of an array on the points of a .vtp, one per point, in the order of read_surface().
/// @throws InputError  if the file has no such array of one component (the message names those it
///                     has), consists of several pieces, or is no .vtp.
std::vector<double> read_point_array(const std::filesystem::path& path, const std::string& name);

}  // namespace mesamis
