// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/label_image.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::labels {
namespace {

/// For each label those that it meets.
using Meetings = std::map<Index, std::set<Index>>;

Meetings meetings_of(const GridMemberships& grid) {
  Meetings meetings;
  for (const Index label : grid.label) meetings[label];
  for (std::size_t n = 0; n < grid.material.size(); ++n) {
    const Index own = grid.label[static_cast<std::size_t>(grid.material[n])];
    for (auto i = grid.first[n]; i < grid.first[n + 1]; ++i) {
      const Index material = grid.listed[static_cast<std::size_t>(i)];
      const Index other = grid.label[static_cast<std::size_t>(material)];
      if (other == own) continue;
      meetings[own].insert(other);
      meetings[other].insert(own);
    }
  }
  return meetings;
}

/// The least number that none of some has.
float least_not_in(const std::set<float>& taken) {
  float number = 0;
  while (taken.count(number) != 0) ++number;
  return number;
}

/// The number of each material's label.
std::vector<float> numbers_of(const GridMemberships& grid) {
  std::map<Index, float> number;
  for (const auto& [label, others] : meetings_of(grid)) {
    std::set<float> taken;
    for (const Index other : others) {
      if (number.count(other) != 0) taken.insert(number[other]);
    }
    number[label] = least_not_in(taken);
  }
  std::vector<float> numbers;
  numbers.reserve(grid.label.size());
  for (const Index label : grid.label) numbers.push_back(number[label]);
  return numbers;
}

float mean_at(const GridMemberships& grid, const std::vector<float>& numbers, std::size_t node) {
  const auto begin = static_cast<std::size_t>(grid.first[node]);
  const auto end = static_cast<std::size_t>(grid.first[node + 1]);
  float sum = 0, weights = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const float weight = std::max(grid.value[i], 0.0F);
    sum += weight * numbers[static_cast<std::size_t>(grid.listed[i])];
    weights += weight;
  }
  return weights > 0 ? sum / weights : numbers[static_cast<std::size_t>(grid.material[node])];
}

}  // namespace

Volume label_image(const GridMemberships& memberships, const VoxelGrid& grid) {
  if (memberships.size != grid.size || memberships.material.size() != grid.voxel_count()) {
    throw InputError("label image: expected one voxel per node, found " +
                     std::to_string(grid.voxel_count()) + " for " +
                     std::to_string(memberships.material.size()));
  }
  const std::vector<float> numbers = numbers_of(memberships);
  Volume image;
  static_cast<VoxelGrid&>(image) = grid;
  image.samples.resize(grid.voxel_count());
  parallel_for(image.samples.size(),
               [&](std::size_t n) { image.samples[n] = mean_at(memberships, numbers, n); });
  return image;
}

}  // namespace mesamis::detail::labels
