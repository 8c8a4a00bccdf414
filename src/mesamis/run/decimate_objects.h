// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/method/printable.h"
#include "mesamis/shape_files/object_files.h"

/// Fewer triangles of closed surfaces, as the program and the Python package reduce them.
namespace mesamis::detail::run {

/// Reads the objects of a file, each closed. Where one of them is not, as with groups of an .obj,
/// the whole file is one object without a name.
/// @param warnings  learns of it, one line.
/// @return points in LPS where the file states a frame, which `frame` then is.
/// @throws InputError  as read_object_file(); if the whole is not closed and 2-manifold either.
ObjectFile read_closed_objects(const std::filesystem::path& path, const ReadLimits& limits,
                               std::vector<std::string>& warnings);

/// Objects with fewer triangles.
struct DecimatedObjects {
  std::vector<NamedSurface> objects;     ///< in their order
  std::vector<PrintableReport> reports;  ///< one for each of them
  std::vector<std::string> dropped;      ///< names of the objects of which no part is left
  std::string unmet;                     ///< why there are more triangles than asked for; or empty
};

/// Chooses the parts of each object and reduces its triangles: of one by make_printable(), of
/// several by simplify_objects(), so that they go on sharing what they share.
/// @param objects  mm; each closed and 2-manifold.
/// @param options  tolerance > 0; the triangles are those of all objects, shared ones counted once.
/// @throws InputError  as simplify_objects().
/// @throws Cancelled   if the progress of the options returns false.
///
/// O(n log n) for n triangles.
DecimatedObjects decimate_objects(std::vector<NamedSurface> objects,
                                  const PrintableOptions& options);

}  // namespace mesamis::detail::run
