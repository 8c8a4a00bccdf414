// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/files/dicom_subject.h"
#include "mesamis/files/output_path.h"
#include "mesamis/files/reading.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// The default name of a surface. Never the scan's, which may name the patient.
inline constexpr const char* kSurfaceName = "mesamis surface";

/// A named array with one value per point of a surface.
struct PointArray {
  std::string name;            ///< one word
  std::vector<double> values;  ///< finite
};

struct SurfaceWriteOptions {
  /// The frame of the coordinates in the file, stated as "SPACE=LPS" or "SPACE=RAS", as 3D Slicer
  /// does. None: coordinates are written as given, and the file states no frame.
  std::optional<Frame> frame = Frame::kLps;
  std::string name{};  ///< name of the object; written on one line
  /// .3mf, .amf, .vtp: a finite grey value per point, 0 (black) to 255 (white); empty: none
  std::vector<double> grey{};
  /// .3mf, .amf: metadata as type and text; "producer" is the program. Nothing about the patient
  /// belongs here.
  std::vector<std::pair<std::string, std::string>> metadata{};
  std::vector<PointArray> point_arrays{};  ///< .vtp, .ply: arrays to colour by, with distinct names
  DicomSubject subject{};  ///< .dcm: patient, study and frame of reference; empty: none, made up
};

/// Writes a surface in the format of the extension. The file appears whole or not at all.
///
///   .stl  binary, single precision; a closed surface stays closed, see round_to_single()
///   .ply  binary, double precision
///   .obj  text, double precision
///   .vtp  VTK XML, appended binary, double precision
///   .3mf  3MF core and materials extension, single precision, six decimals, millimetres; grey
///         values are colours of the triangles' corners
///   .amf  AMF 1.1 (ISO/ASTM 52915), text, double precision, millimetres; grey values are colours
///         of the points
///   .glb  binary glTF 2.0, single precision, with normals; a node turns it from mm with z up to
///         metres with y up; grey values are colours of the points
///   .dcm  Encapsulated STL in DICOM, and for names that end with .obj.dcm Encapsulated OBJ, always
///         in LPS; missing UIDs follow from the content
///
/// Frame and name are stated in the header (.stl, cut at 80 bytes), in comments (.ply, .obj), in
/// field data (.vtp) or in metadata (.3mf, .amf).
/// @param path     one of the extensions above, in upper or lower case.
/// @param surface  n points in LPS mm, m >= 1 triangles with indices in [0, n).
/// @param options  values that the format cannot hold are left out.
/// @throws InputError  for another extension; an empty surface; an index out of range or a
///                     coordinate that is not finite; grey values or arrays of another size than n
///                     or not finite; an array's name that is not one word, or two arrays of the
///                     same name; a file that cannot be written.
///
/// Memory: the file's bytes, and for RAS a copy of the surface.
void write_surface(const OutputPath& path, const TriMesh& surface,
                   const SurfaceWriteOptions& options = {});

/// The extensions of write_surface(), with their dots. O(1) time and memory.
std::vector<std::string> written_surface_formats();

/// The extensions of read_surface(), with their dots. O(1) time and memory.
/// @throws nothing
std::vector<std::string> read_surface_formats();

/// Whether the format of this extension holds SurfaceWriteOptions::grey.
bool carries_grey(const std::filesystem::path& path);

/// Whether the format of this extension holds SurfaceWriteOptions::point_arrays.
bool carries_arrays(const std::filesystem::path& path);

/// Reads a surface: .stl .ply .obj (text or binary where there are both), .vtp, .3mf, .amf (not
/// zipped), legacy .vtk, each also compressed by gzip (.gz), and Encapsulated STL and OBJ in DICOM,
/// whatever their names are. Equal points of an STL become one; polygons are cut into fans.
///
/// @return n points and m >= 1 triangles; indices in [0, n), coordinates finite. Coordinates are as
///         in the file, in mm where the format states a unit; the frame is neither assumed nor
///         changed.
/// @param limits  a file that claims more memory is refused before the memory is taken.
/// @throws InputError  in one line: the file, what was expected and what was found.
///
/// O(size of the file), with a logarithm for STL. Memory: the file's bytes and the surface, within
/// the limits.
TriMesh read_surface(const std::filesystem::path& path, const ReadLimits& limits = {});

/// A surface with the frame that its file states in one of the places of write_surface(), or in the
/// title or a field of a legacy .vtk; none if the file states none, or another than LPS and RAS.
struct SurfaceFile {
  TriMesh surface;  ///< as read_surface()
  std::optional<Frame> frame;
};

/// Reads a surface and the frame that its file states.
///
/// @throws InputError  as read_surface(). Cost as read_surface().
SurfaceFile read_surface_file(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Converts a surface from LPS to RAS or back: x and y are negated. This is a rotation and keeps
/// the orientation of the triangles.
///
/// @param surface  n points; taken by value, so that a moved surface is not copied.
/// @return the same surface in the other frame.
TriMesh turned(TriMesh surface);

/// Converts the surface to LPS where its file states a frame.
///
/// @return points in LPS; as the file has them where it states no frame.
///
/// O(n), a copy of the surface.
TriMesh in_lps(const SurfaceFile& file);

/// Reads one array on the points of a .vtp of one piece, or one property of the vertices of a .ply.
///
/// @param name    of an array of one component.
/// @param limits  as read_surface().
/// @return one value per point, in the order of read_surface(); any unit, as the file has them.
/// @throws InputError  if the file is neither .vtp nor .ply, has several pieces, or has no such
///                     array of one component; the message names those it has.
std::vector<double> read_point_array(const std::filesystem::path& path, const std::string& name,
                                     const ReadLimits& limits = {});

}  // namespace mesamis
