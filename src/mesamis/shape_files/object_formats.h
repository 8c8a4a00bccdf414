// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <map>

#include "mesamis/shape_files/object_files.h"
#include "mesamis/shape_files/surface_formats.h"

/// The formats behind object_files.h, as surface_formats.h has them.
namespace mesamis::detail::shape_files {

using Colour = std::array<std::uint8_t, 3>;

/// What a file says about one of its objects.
struct ObjectFacts {
  std::string name;  ///< empty: nothing
  std::optional<Index> label;
  std::optional<Colour> colour;
};

/// A file's surface, and to which of its objects each triangle belongs.
struct ParsedObjects {
  SurfaceFile file;
  std::vector<ObjectFacts> objects;  ///< some perhaps without a triangle
  std::vector<Index> object_of;      ///< per triangle, in [0, number of objects)
};

/// A share of 0 to 1 of a colour as a byte; what is no share counts as the nearer end.
inline std::uint8_t channel_of(double share) {
  return share > 0 ? static_cast<std::uint8_t>(std::lround(255 * std::min(share, 1.0))) : 0;
}

/// The label that a text gives in decimals, if it does.
std::optional<Index> object_label_in(std::string_view text);

/// Names for files and materials, no two of them equal: see object_paths().
std::vector<std::string> safe_names(std::span<const NamedSurface> objects);

/// Writers take names of one line, not empty.
std::string threemf_object_bytes(std::span<const NamedSurface> objects,
                                 const SurfaceWriteOptions& options);
std::string vtp_object_bytes(std::span<const NamedSurface> objects,
                             const SurfaceWriteOptions& options);
std::string glb_object_bytes(std::span<const NamedSurface> objects,
                             const SurfaceWriteOptions& options);
std::string amf_object_bytes(std::span<const NamedSurface> objects,
                             const SurfaceWriteOptions& options);
/// @param materials  the name of the file of the materials, which have the safe names.
std::string obj_object_bytes(std::span<const NamedSurface> objects,
                             const SurfaceWriteOptions& options, const std::string& materials);

ParsedObjects parse_threemf_objects(const std::filesystem::path& file, std::string_view bytes,
                                    MemoryBudget& budget);
ParsedObjects parse_vtp_objects(const std::filesystem::path& file, std::string_view bytes,
                                MemoryBudget& budget);
ParsedObjects parse_amf_objects(const std::filesystem::path& file, std::string_view bytes,
                                MemoryBudget& budget);
/// Colours are read from the file of materials beside it.
ParsedObjects parse_obj_objects(const std::filesystem::path& file, std::string_view bytes,
                                MemoryBudget& budget);

/// The materials of an .obj: their diffuse colours.
std::string mtl_bytes(std::span<const NamedSurface> objects);
/// The colours by the names of the materials; those without one, or with a spectrum instead, are
/// left out.
/// @throws InputError  naming the line, if a colour is not three numbers.
std::map<std::string, Colour> parse_mtl(const std::filesystem::path& file, std::string_view bytes,
                                        MemoryBudget& budget);

}  // namespace mesamis::detail::shape_files
