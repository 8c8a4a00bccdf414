// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/impulses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::restore {
namespace {

/// Calls visit(value) for the 26 voxels around, cut off at the border, until it says stop (true).
template <class Visit>
void visit_neighbors(const VolumeView& volume, const std::array<Index, 3>& voxel, Visit&& visit) {
  std::array<Index, 3> low, high;
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] = std::max(voxel[a] - 1, 0);
    high[a] = std::min(voxel[a] + 1, volume.size[a] - 1);
  }
  for (Index k = low[2]; k <= high[2]; ++k) {
    for (Index j = low[1]; j <= high[1]; ++j) {
      for (Index i = low[0]; i <= high[0]; ++i) {
        const bool is_itself = i == voxel[0] && j == voxel[1] && k == voxel[2];
        if (!is_itself && visit(volume.at(i, j, k))) return;
      }
    }
  }
}

bool is_impulse(const VolumeView& volume, const std::array<Index, 3>& voxel, float difference) {
  const float value = volume.at(voxel[0], voxel[1], voxel[2]);
  int alike = 0;
  visit_neighbors(volume, voxel, [&](float other) {
    alike += std::abs(other - value) <= difference;
    return alike == 2;
  });
  return alike < 2;
}

float median_around(const VolumeView& volume, const std::array<Index, 3>& voxel) {
  std::vector<double> values;
  visit_neighbors(volume, voxel, [&values](float value) {
    values.push_back(value);
    return false;
  });
  return static_cast<float>(median(values));
}

}  // namespace

WithoutImpulses remove_impulses(Volume volume, double difference, double least_share) {
  const VolumeView view = volume;
  const auto layers = static_cast<std::size_t>(volume.size[2]);
  const auto found = parallel_collect<std::pair<std::size_t, float>>(
      layers, 1, [&](std::size_t layer, std::size_t, auto& impulses) {
        const auto k = static_cast<Index>(layer);
        for (Index j = 0; j < view.size[1]; ++j) {
          for (Index i = 0; i < view.size[0]; ++i) {
            if (is_impulse(view, {i, j, k}, static_cast<float>(difference))) {
              impulses.emplace_back(view.offset(i, j, k), median_around(view, {i, j, k}));
            }
          }
        }
      });
  const double share =
      static_cast<double>(found.size()) / static_cast<double>(volume.voxel_count());
  if (share < least_share) return {std::move(volume), 0};
  for (const auto& [voxel, value] : found) volume.samples[voxel] = value;
  return {std::move(volume), found.size()};
}

}  // namespace mesamis::detail::restore
