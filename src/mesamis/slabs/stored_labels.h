// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesamis/image/label_map.h"
#include "mesamis/slabs/scratch.h"

namespace mesamis::detail::slabs {

/// Writes a label map into a scratch folder: two bytes per voxel and layer.
/// @param warnings  of who has read it, one line each.
/// @throws InputError  if it cannot be written.
void store_labels(const Scratch& scratch, const LabelMap& map,
                  const std::vector<std::string>& warnings = {});

/// A label map in a scratch folder, of which some slices are read at a time. Several threads may
/// read at the same time.
class StoredLabels {
 public:
  /// @param scratch  where store_labels() has written; it must live as long as this object.
  /// @throws InputError  if there is no label map.
  explicit StoredLabels(const Scratch& scratch);

  /// The grid and the segments; its layers are empty.
  const LabelMap& head() const noexcept { return head_; }
  /// As they were stored.
  const std::vector<std::string>& warnings() const noexcept { return warnings_; }
  /// @param layer  of the segments.
  /// @param first  0 to the number of slices less count.
  /// @param count  at least 1.
  /// @return a label per voxel of these slices; i runs fastest, then j, k.
  /// @throws InputError  if they cannot be read. O(voxels of the slices).
  std::vector<std::uint16_t> read(Index layer, Index first, Index count) const;

 private:
  const Scratch& scratch_;
  LabelMap head_;
  std::vector<std::string> warnings_;
};

}  // namespace mesamis::detail::slabs
