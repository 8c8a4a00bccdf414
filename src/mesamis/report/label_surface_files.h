// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "mesamis/method/label_surfaces.h"
#include "mesamis/report/run_surface.h"
#include "mesamis/shape_files/object_files.h"

/// The surfaces of a run on labels as files: one for all objects, or one for each.
namespace mesamis::detail::report {

/// Gives each object a number of its own: its label, or where layers share labels a running one.
/// @return in their order, without surfaces.
///
/// O(n log n) for n segments.
std::vector<NamedSurface> named_segments(std::span<const Segment> segments);

/// The objects of a run with their surfaces, numbered as named_segments() does. O(points and
/// triangles), copied.
std::vector<NamedSurface> named_surfaces(const LabelResult& result);

/// Whether a file of this name is one of each object: "{label}" in its name stands for the object.
bool names_each(const std::filesystem::path& path);

/// Whether a file of this name holds all objects: its format can, and the name is not one of each.
bool holds_all(const std::filesystem::path& path);

/// Names the files of objects whose path is not that of all. The object's name stands where {label}
/// is, or before the extension.
/// @param several  more than one object was asked for.
/// @return one path per object, no two of them equal.
/// @throws InputError  as object_paths(). O(n log n) for n objects.
std::vector<std::filesystem::path> label_paths(const std::filesystem::path& path,
                                               std::span<const NamedSurface> objects, bool several);

/// Writes objects to one file where that holds all, else to one for each object.
/// @param options  as for write_objects(); `name` is that of the whole.
/// @throws InputError  as write_objects(), write_surface() and rounded_together().
///
/// O(points and triangles).
void write_named_surfaces(const OutputPath& path, std::span<const NamedSurface> objects,
                          const SurfaceWriteOptions& options);

/// Writes the surfaces of a run on labels to each of the paths, or to the files of each object that
/// a path stands for.
/// @param options  `name` is that of the whole.
/// @param several  as for label_paths().
/// @throws InputError  as write_objects(), write_surface() and rounded_together().
///
/// O(points and triangles) for each path.
void write_label_surfaces(std::span<const OutputPath> paths, const LabelResult& result,
                          const RunSurfaceOptions& options, bool several);

}  // namespace mesamis::detail::report
