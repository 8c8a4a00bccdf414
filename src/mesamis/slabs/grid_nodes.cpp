// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/grid_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/slabs/mapped_items.h"

namespace mesamis::detail::slabs {
namespace {

/// u, v and the six entries of the metric's logarithm.
using PackedNode = std::array<std::int16_t, 8>;
static_assert(sizeof(PackedNode) == kBytesOfNode);

/// Steps per unit. Sizes of 1e-3 to 1e3 length units have logarithms of metrics up to 14.
constexpr float kStepsOfU = 100, kStepsOfV = 32000, kStepsOfLog = 2000;

std::int16_t rounded(float value, float steps) {
  constexpr float kMost = std::numeric_limits<std::int16_t>::max();
  return static_cast<std::int16_t>(std::lround(std::clamp(value * steps, -kMost, kMost)));
}

std::size_t nodes_in_slice(const GridWindow& window) {
  return static_cast<std::size_t>(window.size[0]) * static_cast<std::size_t>(window.size[1]);
}

}  // namespace

void write_nodes(const std::filesystem::path& path, const GridWindow& window) {
  const std::size_t slice = nodes_in_slice(window);
  make_item_file<PackedNode>(path, window.u.size());
  std::vector<PackedNode> packed(slice);
  for (std::size_t first = 0; first < window.u.size(); first += slice) {
    parallel_for(slice, [&](std::size_t at) {
      const std::size_t n = first + at;
      packed[at] = {rounded(window.u[n], kStepsOfU), rounded(window.v[n], kStepsOfV)};
      for (std::size_t i = 0; i < 6; ++i) {
        packed[at][2 + i] = rounded(window.log_metrics[n][i], kStepsOfLog);
      }
    });
    write_items<PackedNode>(path, first, packed);
  }
}

GridWindow read_nodes(const std::filesystem::path& path, const GridWindow& frame, double low,
                      double high) {
  const SliceRange range = slice_range(frame, low, high);
  const std::size_t slice = nodes_in_slice(frame);
  const auto file = map_items<PackedNode>(path, slice * static_cast<std::size_t>(frame.size[2]));
  const auto packed = file.values.subspan(slice * static_cast<std::size_t>(range.first),
                                          slice * static_cast<std::size_t>(range.count));
  GridWindow window = frame_of(frame, range);
  window.u.resize(packed.size());
  window.v.resize(packed.size());
  window.log_metrics.resize(packed.size());
  parallel_for(packed.size(), [&](std::size_t n) {
    window.u[n] = packed[n][0] / kStepsOfU;
    window.v[n] = packed[n][1] / kStepsOfV;
    for (std::size_t i = 0; i < 6; ++i) window.log_metrics[n][i] = packed[n][2 + i] / kStepsOfLog;
  });
  return window;
}

}  // namespace mesamis::detail::slabs
