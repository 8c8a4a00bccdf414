// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "mesamis/files/memory_budget.h"
#include "mesamis/shape_files/surface_files.h"

/// The formats behind surface_files.h. Writers take points as they go to the file; readers take a
/// file's bytes, unpacked, its path for messages, and the budget that they ask before they take
/// memory, and throw InputError. What they return is not checked further: indices may be out of
/// range.
namespace mesamis::detail::shape_files {

/// The extension in lower case, without a final .gz.
std::string extension_of(const std::filesystem::path& path);
/// The extension of a file that is written, as it stands: the last one, or ".obj.dcm".
std::string format_extension(const std::filesystem::path& path);
/// @throws InputError  naming the path's extension and those known.
[[noreturn]] void refuse_extension(const std::filesystem::path& path, const std::string& known);
/// The options as headers and comments take them: names and facts in one line each, and always a
/// producer.
SurfaceWriteOptions as_written(const SurfaceWriteOptions& options);
/// Replaces control characters by blanks.
std::string one_line(std::string text);
/// What a file must hold to be a surface.
/// @throws InputError  if it has no triangle, too many points, or is not sound.
void require_surface(const std::filesystem::path& path, const TriMesh& surface);

/// "mesamis, millimetre, SPACE=LPS": 3D Slicer looks for the last part in all four formats, which
/// is missing where no frame is stated.
std::string frame_note(std::optional<Frame> frame);
/// The frame that a text names in this way.
std::optional<Frame> frame_named_in(std::string_view note);
/// The frame of this name, see frame_name().
std::optional<Frame> frame_named(std::string_view name);

/// The type of the metadata that names the program; write_surface() makes sure that there is one.
inline constexpr const char* kProducer = "producer";

/// Single precision, as the format has it, see round_to_single().
std::string stl_bytes(const TriMesh& surface, const SurfaceWriteOptions& options);
/// How many bytes a binary file has by its count of triangles, and one more; 0 for text.
std::uint64_t most_stl_bytes(std::string_view first_bytes);
/// Binary or text; equal corners become one point, in the order of their first use.
SurfaceFile parse_stl(const std::filesystem::path& file, std::string_view bytes,
                      MemoryBudget& budget);

/// Double precision: VTK, MeshLab, CloudCompare, Blender, Open3D and Assimp read it.
std::string ply_bytes(const TriMesh& surface, const SurfaceWriteOptions& options);
/// Text or binary of either order. Polygons are cut into fans.
SurfaceFile parse_ply(const std::filesystem::path& file, std::string_view bytes,
                      MemoryBudget& budget);
std::vector<double> parse_ply_array(const std::filesystem::path& file, std::string_view bytes,
                                    const std::string& name, MemoryBudget& budget);

/// Shortest decimals that give the same doubles back.
std::string obj_bytes(const TriMesh& surface, const SurfaceWriteOptions& options);
/// Polygons are cut into fans; everything but positions and faces is left out.
SurfaceFile parse_obj(const std::filesystem::path& file, std::string_view bytes,
                      MemoryBudget& budget);

/// Double precision, appended binary.
std::string vtp_bytes(const TriMesh& surface, const SurfaceWriteOptions& options);
/// Polygons are cut into fans, strips into triangles; points and lines are left out.
SurfaceFile parse_vtp(const std::filesystem::path& file, std::string_view bytes,
                      MemoryBudget& budget);
std::vector<double> parse_vtp_array(const std::filesystem::path& file, std::string_view bytes,
                                    const std::string& name, MemoryBudget& budget);
/// Legacy VTK, DATASET POLYDATA.
SurfaceFile parse_vtk(const std::filesystem::path& file, std::string_view bytes,
                      MemoryBudget& budget);

/// AMF 1.1, text; shortest decimals that give the same doubles back.
std::string amf_bytes(const TriMesh& surface, const SurfaceWriteOptions& options);
/// The meshes of all objects, in mm; not compressed as ZIP; constellations are left out.
SurfaceFile parse_amf(const std::filesystem::path& file, std::string_view bytes,
                      MemoryBudget& budget);

/// 3MF through lib3mf: single precision, six decimals; the same bytes every time.
std::string threemf_bytes(const TriMesh& surface, const SurfaceWriteOptions& options);
/// The meshes of the build items, each at its place, in mm.
SurfaceFile parse_threemf(const std::filesystem::path& file, std::string_view bytes,
                          MemoryBudget& budget);

/// Binary glTF: single precision. Not read.
std::string glb_bytes(const TriMesh& surface, const SurfaceWriteOptions& options);

/// Encapsulated STL and OBJ in DICOM. A surface belongs to the patient and the study of the
/// options, or else to those that its content names.
std::string encapsulated_stl_bytes(const TriMesh& surface, const SurfaceWriteOptions& options);
std::string encapsulated_obj_bytes(const TriMesh& surface, const SurfaceWriteOptions& options);
/// The frame is that of DICOM, LPS, unless the document states another one.
SurfaceFile parse_encapsulated(const std::filesystem::path& file, std::string_view bytes,
                               MemoryBudget& budget);
/// Whether a file is one of these, by its first bytes.
/// @throws InputError  if it cannot be read.
bool is_encapsulated(const std::filesystem::path& path);

}  // namespace mesamis::detail::shape_files
