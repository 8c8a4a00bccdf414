// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/part_filter.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "mesamis/base/parallel.h"
#include "mesamis/base/types.h"
#include "mesamis/surface/list_materials.h"

namespace mesamis::detail::surface {
namespace {

using Place = std::array<Index, 3>;

/// Nodes along each side of the bricks that are filtered at once.
constexpr Index kBrick = 16;

/// A box of values; i runs fastest.
struct Values {
  Place size{};
  std::vector<float> at;
};

/// Filters along one axis; what the kernel does not reach whole falls away.
Values filtered(const Values& in, std::size_t axis, const std::vector<float>& kernel) {
  Values out{in.size, {}};
  out.size[axis] -= static_cast<Index>(kernel.size()) - 1;
  const std::array<std::size_t, 3> step{
      1, static_cast<std::size_t>(in.size[0]),
      static_cast<std::size_t>(in.size[0]) * static_cast<std::size_t>(in.size[1])};
  const auto [nx, ny, nz] =
      std::array{static_cast<std::size_t>(out.size[0]), static_cast<std::size_t>(out.size[1]),
                 static_cast<std::size_t>(out.size[2])};
  out.at.assign(nx * ny * nz, 0);
  for (std::size_t k = 0; k < nz; ++k) {
    for (std::size_t j = 0; j < ny; ++j) {
      float* const to = out.at.data() + (k * ny + j) * nx;
      for (std::size_t w = 0; w < kernel.size(); ++w) {
        const float* const from = in.at.data() + k * step[2] + j * step[1] + w * step[axis];
        for (std::size_t i = 0; i < nx; ++i) to[i] += kernel[w] * from[i];
      }
    }
  }
  return out;
}

Values smoothed_once(const Values& in, const std::vector<float>& kernel) {
  return filtered(filtered(filtered(in, 2, kernel), 1, kernel), 0, kernel);
}

/// A Gaussian, cut off at three standard deviations, of sum 1.
std::vector<float> gaussian_kernel(double sigma) {
  const Index radius = filter_radius(sigma);
  std::vector<double> weights;
  double sum = 0;
  for (Index x = -radius; x <= radius; ++x) {
    weights.push_back(std::exp(-0.5 * x * x / (sigma * sigma)));
    sum += weights.back();
  }
  std::vector<float> kernel;
  kernel.reserve(weights.size());
  for (const double w : weights) kernel.push_back(static_cast<float>(w / sum));
  return kernel;
}

/// Filters the parts of a grid brick by brick, at the nodes that list them.
class PartFilter {
 public:
  PartFilter(const std::vector<Index>& part, double sigma, GridMemberships& grid)
      : size_(grid.size), part_(part), kernel_(gaussian_kernel(sigma)), grid_(grid) {
    for (std::size_t a = 0; a < 3; ++a) bricks_[a] = (size_[a] + kBrick - 1) / kBrick;
  }

  std::size_t brick_count() const {
    return static_cast<std::size_t>(bricks_[0]) * static_cast<std::size_t>(bricks_[1]) *
           static_cast<std::size_t>(bricks_[2]);
  }

  void run(std::size_t brick) const {
    const std::vector<Entry> entries = entries_by_part(corner_of(brick));
    for (auto begin = entries.begin(); begin != entries.end();) {
      const auto end =
          std::find_if(begin, entries.end(), [&](const Entry& e) { return e.part != begin->part; });
      fill_in({begin, end});
      begin = end;
    }
  }

 private:
  /// A part in the list of a node.
  struct Entry {
    Index part, node;
    std::size_t place;  // in the lists
  };

  /// What the nodes of a brick list.
  std::vector<Entry> entries_by_part(const Place& corner) const {
    std::vector<Entry> entries;
    Place at;
    for (at[2] = corner[2]; at[2] < std::min(corner[2] + kBrick, size_[2]); ++at[2]) {
      for (at[1] = corner[1]; at[1] < std::min(corner[1] + kBrick, size_[1]); ++at[1]) {
        for (at[0] = corner[0]; at[0] < std::min(corner[0] + kBrick, size_[0]); ++at[0]) {
          add_entries(node_at(at), entries);
        }
      }
    }
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.part < b.part; });
    return entries;
  }

  void add_entries(Index node, std::vector<Entry>& entries) const {
    const auto n = static_cast<std::size_t>(node);
    const auto end = static_cast<std::size_t>(grid_.first[n + 1]);
    for (auto i = static_cast<std::size_t>(grid_.first[n]); i < end; ++i) {
      entries.push_back({grid_.listed[i], node, i});
    }
  }

  Place corner_of(std::size_t brick) const {
    const Place b = grid_place(bricks_, brick);
    return {b[0] * kBrick, b[1] * kBrick, b[2] * kBrick};
  }
  Index node_at(const Place& p) const { return p[0] + size_[0] * (p[1] + size_[1] * p[2]); }
  Index part_at(Index node) const { return part_[static_cast<std::size_t>(node)]; }

  /// 2 G p - G G p for the indicator p of a part, at the nodes that list it.
  void fill_in(std::span<const Entry> same) const {
    Place lo = size_, hi{-1, -1, -1};
    for (const Entry& entry : same) {
      const Place at = grid_place(size_, entry.node);
      for (std::size_t a = 0; a < 3; ++a) {
        lo[a] = std::min(lo[a], at[a]);
        hi[a] = std::max(hi[a], at[a]);
      }
    }
    const auto radius = static_cast<Index>(kernel_.size() / 2);
    const Values once = smoothed_once(indicator(same.front().part, lo, hi, 2 * radius), kernel_);
    const Values twice = smoothed_once(once, kernel_);
    for (const Entry& entry : same) {
      const Place at = grid_place(size_, entry.node);
      const Place in{at[0] - lo[0], at[1] - lo[1], at[2] - lo[2]};
      grid_.value[entry.place] = 2 * value_at(once, in, radius) - value_at(twice, in, 0);
    }
  }

  static float value_at(const Values& values, const Place& p, Index margin) {
    const Index row = p[1] + margin + values.size[1] * (p[2] + margin);
    const Index place = p[0] + margin + values.size[0] * row;
    return values.at[static_cast<std::size_t>(place)];
  }

  /// 1 in a part, else 0; beyond the grid as at its nearest node.
  Values indicator(Index part, const Place& lo, const Place& hi, Index margin) const {
    Values values;
    for (std::size_t a = 0; a < 3; ++a) values.size[a] = hi[a] - lo[a] + 1 + 2 * margin;
    const auto [nx, ny, nz] = values.size;
    values.at.reserve(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) *
                      static_cast<std::size_t>(nz));
    const auto clamped = [&](Index x, std::size_t a) {
      return std::clamp(lo[a] - margin + x, 0, size_[a] - 1);
    };
    for (Index k = 0; k < nz; ++k) {
      for (Index j = 0; j < ny; ++j) {
        const Index row = node_at({0, clamped(j, 1), clamped(k, 2)});
        for (Index i = 0; i < nx; ++i) {
          values.at.push_back(part_at(row + clamped(i, 0)) == part ? 1.0F : 0.0F);
        }
      }
    }
    return values;
  }

  Place size_, bricks_{};
  const std::vector<Index>& part_;
  std::vector<float> kernel_;
  GridMemberships& grid_;  // bricks fill in values of their own nodes
};

}  // namespace

Index filter_radius(double sigma_voxel) { return static_cast<Index>(std::ceil(3 * sigma_voxel)); }

void filter_parts(const std::vector<Index>& part, double sigma_voxel, GridMemberships& grid) {
  list_materials(grid);
  const PartFilter filter(part, sigma_voxel, grid);
  parallel_for_each(filter.brick_count(), [&](std::size_t b) { filter.run(b); });
}

}  // namespace mesamis::detail::surface
