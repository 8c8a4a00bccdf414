// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/padding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/written_number.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/object/voxel_neighbours.h"

namespace mesamis {
namespace {

constexpr float kAir = -1000, kLikeAir = 100;  // HU

/// Marks what is darker than anything in CT can be; empty if there is hardly anything.
VoxelMask darker_than_air(const VolumeView& volume) {
  constexpr std::size_t kOneIn = 1000;
  if (!is_hounsfield(volume)) return {};
  VoxelMask mask(volume.samples.size(), 0);
  for (std::size_t n = 0; n < mask.size(); ++n) mask[n] = volume.samples[n] <= kPaddingHu;
  if (count_marked(mask) * kOneIn < mask.size()) return {};
  const VoxelMask sure = mask;
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (sure[n] == 0) continue;
    for_each_neighbour(volume, n, [&](std::size_t next, int) {
      if (volume.samples[next] < kAir - kLikeAir) mask[next] = 1;
    });
  }
  return mask;
}

/// The value of most corners, of several the smallest; nothing if no two are equal.
std::optional<float> value_of_corners(const VolumeView& volume) {
  std::map<float, int> count;
  const auto& s = volume.size;
  for (const Index k : {0, s[2] - 1}) {
    for (const Index j : {0, s[1] - 1}) {
      for (const Index i : {0, s[0] - 1}) ++count[volume.at(i, j, k)];
    }
  }
  const auto most = std::max_element(
      count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most->second > 1 ? std::optional(most->first) : std::nullopt;
}

/// Marks the voxels of a value that are connected to the border.
VoxelMask flooded_from_border(const VolumeView& volume, float value) {
  VoxelMask mask(volume.samples.size(), 0);
  std::vector<std::size_t> open;
  const auto mark = [&](std::size_t n) {
    if (mask[n] != 0 || volume.samples[n] != value) return;
    mask[n] = 1;
    open.push_back(n);
  };
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (volume.samples[n] == value && is_at_border(volume, n)) mark(n);
  }
  while (!open.empty()) {
    const std::size_t n = open.back();
    open.pop_back();
    for_each_neighbour(volume, n, [&](std::size_t next, int) { mark(next); });
  }
  return mask;
}

/// How lines of one direction meet what is not marked.
struct Runs {
  std::size_t lines = 0;  // that meet it
  std::size_t runs = 0;   // of its voxels, in all
};

bool is_within(const VoxelGrid& grid, const std::array<Index, 3>& at) {
  return at[0] >= 0 && at[1] >= 0 && at[2] >= 0 && at[0] < grid.size[0] && at[1] < grid.size[1] &&
         at[2] < grid.size[2];
}

std::array<Index, 3> moved(const std::array<Index, 3>& at, const std::array<Index, 3>& by,
                           Index times) {
  return {at[0] + times * by[0], at[1] + times * by[1], at[2] + times * by[2]};
}

std::size_t runs_on_line(const VoxelGrid& grid, const VoxelMask& marked, std::array<Index, 3> at,
                         const std::array<Index, 3>& direction) {
  std::size_t runs = 0;
  bool before = true;  // marked
  for (; is_within(grid, at); at = moved(at, direction, 1)) {
    const bool here = marked[grid.offset(at[0], at[1], at[2])] != 0;
    if (before && !here) ++runs;
    before = here;
  }
  return runs;
}

Runs runs_along(const VoxelGrid& grid, const VoxelMask& marked,
                const std::array<Index, 3>& direction) {
  Runs all;
  for (Index k = 0; k < grid.size[2]; ++k) {
    for (Index j = 0; j < grid.size[1]; ++j) {
      for (Index i = 0; i < grid.size[0]; ++i) {
        if (is_within(grid, moved({i, j, k}, direction, -1))) continue;
        const std::size_t runs = runs_on_line(grid, marked, {i, j, k}, direction);
        all.lines += runs > 0;
        all.runs += runs;
      }
    }
  }
  return all;
}

/// Whether what is not marked is convex, but for single lines.
bool leaves_convex(const VoxelGrid& grid, const VoxelMask& marked) {
  constexpr double kMost = 0.005;  // of the lines
  constexpr std::array<std::array<Index, 3>, 9> kDirections{{{1, 0, 0},
                                                             {0, 1, 0},
                                                             {0, 0, 1},
                                                             {1, 1, 0},
                                                             {1, -1, 0},
                                                             {1, 0, 1},
                                                             {1, 0, -1},
                                                             {0, 1, 1},
                                                             {0, 1, -1}}};
  return std::all_of(kDirections.begin(), kDirections.end(), [&](const auto& direction) {
    const Runs all = runs_along(grid, marked, direction);
    return static_cast<double>(all.runs - all.lines) <= kMost * static_cast<double>(all.lines);
  });
}

/// Three samples in a row from a marked voxel inwards.
using Inward = std::array<float, 3>;

/// All rows along the axes that begin next to a marked voxel and hold none.
std::vector<Inward> rows_inward(const VolumeView& volume, const VoxelMask& marked) {
  std::vector<Inward> rows;
  const std::array<std::size_t, 3> step{1, volume.offset(0, 1, 0), volume.offset(0, 0, 1)};
  for (std::size_t n = 0; n < marked.size(); ++n) {
    if (marked[n] != 0) continue;
    for_each_neighbour(volume, n, [&](std::size_t next, int axis) {
      if (marked[next] == 0) return;
      const auto a = static_cast<std::size_t>(axis);
      const std::size_t size = static_cast<std::size_t>(volume.size[a]);
      const std::size_t place = n / step[a] % size;
      if (next < n ? place + 2 >= size : place < 2) return;
      const std::size_t second = n + n - next, third = second + n - next;
      if (marked[second] != 0 || marked[third] != 0) return;
      rows.push_back({volume.samples[n], volume.samples[second], volume.samples[third]});
    });
  }
  return rows;
}

/// Whether the second voxels lie far from the marked value and close together: the value and they
/// are then the two sides of an object's surface.
bool is_edge(const std::vector<Inward>& rows, float value, double range) {
  constexpr double kFar = 0.3, kClose = 0.5;  // of the range; of the step
  std::vector<float> second;
  second.reserve(rows.size());
  for (const Inward& row : rows) second.push_back(row[1]);
  const auto q = quantiles(second, {0.05, 0.5, 0.95});
  const double step = std::abs(q[1] - static_cast<double>(value));
  return step > kFar * range && q[2] - q[0] < kClose * step;
}

/// Whether the field of view ends at the marked voxels, rather than an object: it begins in the
/// dark, at another value, does not get brighter inwards, and has noise.
bool is_cut(const VolumeView& volume, const VoxelMask& marked, float value) {
  constexpr double kDark = 0.3, kAway = 0.02;  // of the range
  constexpr double kLeastDiffer = 0.05, kLeastDark = 0.25, kMostRise = 0.75, kLeastNoise = 0.1;
  const std::vector<float> seen = samples_outside(volume, marked);
  const auto ends = quantiles(seen, {0.001, 0.999});
  const double range = ends[1] - ends[0];
  const std::vector<Inward> rows = rows_inward(volume, marked);
  double differ = 0, dark = 0, rise = 0, change = 0;
  for (const Inward& row : rows) {
    const bool is_dark = row[1] <= ends[0] + kDark * range;
    differ += std::abs(row[0] - value) > kAway * range;
    dark += is_dark;
    rise += is_dark && row[2] > row[1];
    change += is_dark && row[2] != row[1];
  }
  const auto all = static_cast<double>(rows.size());
  return differ > kLeastDiffer * all && dark > kLeastDark * all && rise < kMostRise * dark &&
         change > kLeastNoise * dark && !is_edge(rows, value, range);
}

/// Marks the even value around a field of view; empty if there is none.
VoxelMask around_field_of_view(const VolumeView& volume) {
  constexpr double kLeastShare = 0.005;
  const auto value = value_of_corners(volume);
  if (!value || (is_hounsfield(volume) && std::abs(*value - kAir) < kLikeAir)) return {};
  VoxelMask mask = flooded_from_border(volume, *value);
  const std::size_t count = count_marked(mask);
  const auto least = kLeastShare * static_cast<double>(mask.size());
  if (static_cast<double>(count) < least || count == mask.size()) return {};
  if (!is_cut(volume, mask, *value) || !leaves_convex(volume, mask)) return {};
  return mask;
}

/// The value of most of the marked voxels, of several the smallest.
double common_value(const VolumeView& volume, const VoxelMask& mask) {
  std::map<float, std::size_t> count;
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (mask[n] != 0) ++count[volume.samples[n]];
  }
  return std::max_element(count.begin(), count.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

VoxelMask of_value(const VolumeView& volume, float value) {
  VoxelMask mask(volume.samples.size());
  for (std::size_t n = 0; n < mask.size(); ++n) mask[n] = volume.samples[n] == value;
  return mask;
}

/// Both signs of padding.
VoxelMask searched(const VolumeView& volume) {
  VoxelMask mask = darker_than_air(volume);
  VoxelMask around = around_field_of_view(volume);
  if (mask.empty()) return around;
  for (std::size_t n = 0; n < around.size(); ++n) mask[n] |= around[n];
  return mask;
}

}  // namespace

PaddingRule parse_padding(std::string_view text) {
  if (text == "auto") return {};
  if (text == "none") return {.search = false};
  const auto value = written_number(text);
  if (!value) {
    throw InputError("padding: expected auto, none or a number, found " + quoted_text(text));
  }
  return {.search = false, .value = value};
}

namespace detail::object {

std::optional<Padding> find_padding(const VolumeView& volume, const PaddingRule& rule) {
  if (volume.samples.empty()) return std::nullopt;
  Padding padding;
  if (rule.value) {
    padding.mask = of_value(volume, static_cast<float>(*rule.value));
  } else if (rule.search) {
    padding.mask = searched(volume);
  }
  padding.voxels = count_marked(padding.mask);
  if (padding.voxels == 0 || padding.voxels == volume.samples.size()) return std::nullopt;
  padding.value = common_value(volume, padding.mask);
  return padding;
}

std::vector<float> samples_outside(const VolumeView& volume, std::span<const std::uint8_t> mask) {
  require_mask_of(mask, volume);
  std::vector<float> samples;
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (mask[n] == 0) samples.push_back(volume.samples[n]);
  }
  return samples;
}

Volume filled(Volume volume, std::span<const std::uint8_t> mask, double value) {
  require_mask_of(mask, volume);
  parallel_for(volume.samples.size(), [&](std::size_t n) {
    if (mask[n] != 0) volume.samples[n] = static_cast<float>(value);
  });
  return volume;
}

double share_at_border(const VolumeView& volume, std::span<const std::uint8_t> mask, double level) {
  require_mask_of(mask, volume);
  std::size_t all = 0, at_border = 0;
  for (std::size_t n = 0; n < mask.size(); ++n) {
    for_each_neighbour(volume, n, [&](std::size_t next, int) {
      if (next < n || (volume.samples[n] > level) == (volume.samples[next] > level)) return;
      ++all;
      at_border += (mask[n] != 0) != (mask[next] != 0);
    });
  }
  return all > 0 ? static_cast<double>(at_border) / static_cast<double>(all) : 0;
}

}  // namespace detail::object

}  // namespace mesamis
