// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "mesamis/surface/label_parts.h"
#include "mesamis/surface/part_filter.h"
#include "mesamis/surface/smooth_memberships.h"

namespace mesamis {

/// Labels that own their memory.
struct OwnedLabels {
  std::array<Index, 3> size{};
  Vec3 spacing{1, 1, 1};
  std::vector<std::uint16_t> labels{};

  LabelGrid grid() const { return {size, spacing, labels}; }

  std::uint16_t& at(Index i, Index j, Index k) {
    return labels[static_cast<std::size_t>(i + size[0] * (j + size[1] * k))];
  }

  /// What a label's nodes are worth in mm^3, as far as they lie within the grid.
  double volume_of(std::uint16_t label) const {
    double sum = 0;
    std::size_t n = 0;
    for (Index k = 0; k < size[2]; ++k) {
      for (Index j = 0; j < size[1]; ++j) {
        for (Index i = 0; i < size[0]; ++i, ++n) {
          if (labels[n] != label) continue;
          sum += (i == 0 || i + 1 == size[0] ? 0.5 : 1) * (j == 0 || j + 1 == size[1] ? 0.5 : 1) *
                 (k == 0 || k + 1 == size[2] ? 0.5 : 1);
        }
      }
    }
    return sum * spacing.x * spacing.y * spacing.z;
  }

  double box_volume() const {
    return spacing.x * (size[0] - 1) * spacing.y * (size[1] - 1) * spacing.z * (size[2] - 1);
  }
};

/// The label of each node, a function of its place in mm.
template <class LabelAt>
OwnedLabels labels_where(const std::array<Index, 3>& size, const Vec3& spacing, LabelAt label_at) {
  OwnedLabels labels{.size = size, .spacing = spacing};
  for (Index k = 0; k < size[2]; ++k) {
    for (Index j = 0; j < size[1]; ++j) {
      for (Index i = 0; i < size[0]; ++i) {
        labels.labels.push_back(static_cast<std::uint16_t>(
            label_at(Vec3{i * spacing.x, j * spacing.y, k * spacing.z})));
      }
    }
  }
  return labels;
}

/// Blobs: the cells nearest to random points, of so many labels; label 0 beyond a ball.
inline OwnedLabels random_blobs(Index n, int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, n - 1);
  std::vector<Vec3> centers;
  for (int c = 0; c < count; ++c) {
    const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
    centers.push_back({x, y, z});
  }
  const Vec3 middle{0.5 * (n - 1), 0.5 * (n - 1), 0.5 * (n - 1)};
  return labels_where({n, n, n}, {1, 1, 1}, [&](const Vec3& p) {
    if (norm(p - middle) > 0.46 * n) return 0;
    int nearest = 0;
    for (int c = 1; c < count; ++c) {
      if (norm(p - centers[static_cast<std::size_t>(c)]) <
          norm(p - centers[static_cast<std::size_t>(nearest)])) {
        nearest = c;
      }
    }
    return nearest + 1;
  });
}

/// The parts of labels, one material each; nothing is listed yet.
inline GridMemberships parts_of(const OwnedLabels& labels) {
  LabelParts parts = find_label_parts(labels.grid());
  return {.size = labels.size,
          .spacing = labels.spacing,
          .material = std::move(parts.of_node),
          .label = std::move(parts.label),
          .first = {},
          .listed = {},
          .value = {}};
}

/// The parts of labels and their memberships by filter_parts().
inline GridMemberships filtered(const OwnedLabels& labels, double sigma_voxel = 1.5) {
  GridMemberships grid = parts_of(labels);
  const std::vector<Index> part = grid.material;
  filter_parts(part, sigma_voxel, grid);
  return grid;
}

}  // namespace mesamis
