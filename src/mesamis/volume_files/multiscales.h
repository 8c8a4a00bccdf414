// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/files/json_value.h"
#include "mesamis/volume_files/chunked_scan.h"

/// The metadata by which OME-Zarr groups arrays of one image (NGFF 0.1 to 0.5).
namespace mesamis::detail::volume_files {

/// One resolution of an image.
struct ScaleLevel {
  std::string path;               ///< of the array, from the group
  std::vector<std::string> axes;  ///< names, slowest first; empty if they are not told
  std::optional<Vec3> spacing;    ///< mm along i, j, k; none if it is not told
  Vec3 origin;                    ///< mm
  std::vector<std::string> warnings;
  /// Of an image of labels those that are named or coloured; none for other images.
  std::shared_ptr<const std::vector<NamedNumber>> labels{};
};

/// The levels of the first image that a group describes, finest first; empty if it describes none.
/// @param attributes  of the group.
/// Names and colours of labels that contradict the format are left out with a warning.
/// @throws InputError  for what else contradicts the format, and space axes other than z, y, x.
std::vector<ScaleLevel> read_multiscales(const JsonValue& attributes);

}  // namespace mesamis::detail::volume_files
