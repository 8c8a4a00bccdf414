// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "mesamis/base/types.h"
#include "mesamis/files/refuse.h"
#include "mesamis/files/text_writer.h"
#include "mesamis/shape_files/mesh_files.h"

/// What the writers of Gmsh .msh share.
namespace mesamis::detail::shape_files {

/// A point's coordinates, ending the line.
inline void write_gmsh_point(TextWriter& out, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) out << " ";
    out.number(p[axis]);
  }
  out << "\n";
}

/// $Nodes of version 2.2.
inline void write_gmsh_nodes(TextWriter& out, std::span<const Vec3> points, Frame frame) {
  out << "$Nodes\n" << points.size() << "\n";
  for (std::size_t n = 0; n < points.size(); ++n) {
    out << n + 1 << " ";
    write_gmsh_point(out, in_frame(points[n], frame));
  }
  out << "$EndNodes\n";
}

/// $NodeData or $ElementData, the same in all versions.
/// @param order  places of the values in the order in which they are written; empty: as they are.
inline void write_gmsh_data(TextWriter& out, const char* section, const MeshArray& array,
                            std::span<const std::size_t> order = {}) {
  // One string (the name), one real (the time), three integers (step, components, entries).
  out << "$" << section << "\n1\n\"" << array.name << "\"\n1\n0\n3\n0\n1\n"
      << array.values.size() << "\n";
  for (std::size_t n = 0; n < array.values.size(); ++n) {
    const std::size_t i = order.empty() ? n : order[n];
    out << i + 1 << " ";
    out.number(array.values[i]);
    out << "\n";
  }
  out << "$End" << section << "\n";
}

/// @throws InputError  unless each array has one component and one value per item.
inline void require_gmsh_scalars(const std::filesystem::path& path,
                                 std::span<const MeshArray> arrays, std::size_t count) {
  for (const MeshArray& array : arrays) {
    if (array.components == 1 && array.values.size() == count) continue;
    refuse(path, message("array '", array.name, "': expected ", count, " scalars, found ",
                         array.values.size(), " values, ", array.components, " components"));
  }
}

}  // namespace mesamis::detail::shape_files
