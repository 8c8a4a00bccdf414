// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesamis/shape_files/surface_files.h"

/// Files of several surfaces, each an object with a name, a colour and a label.
namespace mesamis {

/// The surface of one object of several.
struct NamedSurface {
  std::string name;                                   ///< one line; empty: "object LABEL"
  std::array<std::uint8_t, 3> colour{242, 230, 207};  ///< red, green, blue (sRGB)
  Index label = 1;                                    ///< >= 0; differs from those of the others
  TriMesh surface;                                    ///< mm
};

/// Writes the surfaces of several objects to one file, in the format of the extension. The file
/// appears whole or not at all.
///
///   .3mf  one object of the build each, with its name, its label as part number, and its colour
///         as a base material; single precision, six decimals, see rounded_together()
///   .vtp  one PolyData, double precision; cell arrays `label` and `RGB` (three bytes, the scalars
///         that viewers show), field data `ObjectLabels` and `ObjectNames`
///   .obj  one `o` each, double precision, its label in a comment; the colours are diffuse colours
///         of the materials in a file beside it, with the extension .mtl: both are written before
///         either of them appears
///   .amf  one object each, with its name, its label as number and its colour; double precision
///
/// Each object has its own points. Points that are equal in two objects are written alike, so that
/// neighbours share their boundary in the file too.
/// @param path     one of the extensions above, in upper or lower case.
/// @param objects  at least one; surfaces as write_surface() wants them, points in LPS mm.
/// @param options  `frame`, `name` (of the whole; not .obj) and `metadata` (.3mf, .amf); values
///                 per point are left out.
/// @throws InputError  for another extension; without an object; if two labels are equal or one is
///                     negative; as write_surface() for a surface, more than 2^31 / 3 triangles in
///                     all, and files that cannot be written.
///
/// O(points and triangles), with a logarithm for .3mf. Memory: the file's bytes and a copy of the
/// surfaces.
void write_objects(const OutputPath& path, std::span<const NamedSurface> objects,
                   const SurfaceWriteOptions& options = {});

/// The extensions of write_objects(), with their dots. O(1) time and memory.
std::vector<std::string> written_object_formats();

/// Names the file of one object, for formats that hold one surface: "out.stl" becomes
/// "out-NAME.stl". In NAME each character other than ASCII letters, digits, "-", "_" and "." is
/// "_"; it has at most 100 characters. A name without letter or digit is "object".
std::filesystem::path object_path(const std::filesystem::path& path, const std::string& name);

/// Names one file per object as object_path() does. Names that are equal then, without regard to
/// case, are followed by the label: "out-NAME-LABEL.stl".
/// @param objects  their surfaces are not used. Memory: the names.
/// @return as many paths, no two of them equal.
/// @throws InputError  if two labels are equal or one is negative.
std::vector<std::filesystem::path> object_paths(const std::filesystem::path& path,
                                                std::span<const NamedSurface> objects);

/// Rounds the points of all objects to single precision, see round_together(): neighbours still
/// share their boundary, closed surfaces stay closed. For files of single precision, one per
/// object (.stl); write_objects() does so by itself.
///
/// @param objects  points in mm.
/// @throws InputError  if a coordinate is not finite or exceeds single precision.
///
/// O(n log n) for n points of all objects.
std::vector<NamedSurface> rounded_together(std::vector<NamedSurface> objects);

/// Several objects as one surface.
struct JoinedObjects {
  TriMesh surface;               ///< mm; each object has its own points
  std::vector<Index> object_of;  ///< per triangle: its object's place among the objects
};

/// Joins the surfaces of several objects, one after another.
/// @param objects  points in mm, at most 2^31 - 1 of all objects.
///
/// O(points and triangles).
JoinedObjects joined(std::span<const NamedSurface> objects);

/// The objects of a file.
struct ObjectFile {
  std::vector<NamedSurface> objects;  ///< at least one, each with a triangle
  std::optional<Frame> frame;         ///< as SurfaceFile
  bool coloured = false;              ///< the file has a colour for each object
};

/// Reads the objects of a file that read_surface() reads: the meshes that a .3mf builds, the cells
/// of each value of the cell array `label` of a .vtp, the objects of an .obj (its groups, where it
/// has no `o`) and those of an .amf. A file of any other format has one object.
///
/// Labels are those that write_objects() writes; where one is missing or two are equal, they are 1,
/// 2, ... in the order of the file. An object without a name is called "object LABEL", one without
/// a colour has that of NamedSurface. The colours of an .obj are read from the file that its first
/// `mtllib` names, if it lies in the same folder.
/// @return surfaces as read_surface(); where there are several, points that no triangle of an
///         object uses are left out.
/// @throws InputError  as read_surface(), also for damaged labels, names and colours. Cost as
///                     read_surface().
ObjectFile read_object_file(const std::filesystem::path& path, const ReadLimits& limits = {});

/// The objects of read_object_file() alone.
/// @throws InputError  as read_object_file(). Cost as read_object_file().
std::vector<NamedSurface> read_objects(const std::filesystem::path& path,
                                       const ReadLimits& limits = {});

/// Converts the objects to LPS where their file states a frame.
///
/// @param file  points in mm; taken by value, so that a moved file is not copied.
/// @return points in LPS; as the file has them where it states no frame.
std::vector<NamedSurface> in_lps(ObjectFile file);

}  // namespace mesamis
