// SPDX-License-Identifier: Apache-2.0
#include "label_lines.h"

#include <iostream>

#include "arguments.h"

namespace mesamis {

void print_labels(const LabelMap& map) {
  const std::vector<std::size_t> counts = voxel_counts(map);
  for (std::size_t n = 0; n < map.segments.size(); ++n) {
    const Segment& segment = map.segments[n];
    std::cout << "  " << segment.label << "  " << one_line(segment.name) << "  " << counts[n]
              << (counts[n] == 1 ? " voxel  " : " voxels  ")
              << static_cast<double>(counts[n]) * map.voxel_volume() << " mm^3\n";
  }
}

}  // namespace mesamis
