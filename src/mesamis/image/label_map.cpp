// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/label_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/message.h"
#include "mesamis/base/parallel.h"

namespace mesamis {
namespace {

/// From the voxels of one grid to those of another: both in voxels, the centre of the first at 0.
class VoxelTransform {
 public:
  VoxelTransform(const VoxelGrid& from, const VoxelGrid& to) : origin_(in_voxels(to, from.origin)) {
    for (int a = 0; a < 3; ++a) {
      Vec3 step;
      step[a] = from.spacing[a];
      steps_[static_cast<std::size_t>(a)] = in_voxels(to, from.to_world(step)) - origin_;
    }
  }
  /// Of the voxel (0, j, k).
  Vec3 line(Index j, Index k) const {
    return origin_ + static_cast<double>(j) * steps_[1] + static_cast<double>(k) * steps_[2];
  }
  const Vec3& step() const { return steps_[0]; }

  static Vec3 in_voxels(const VoxelGrid& grid, const Vec3& world) {
    const Vec3 p = grid.to_grid(world);
    return {p.x / grid.spacing.x, p.y / grid.spacing.y, p.z / grid.spacing.z};
  }

 private:
  Vec3 origin_;
  std::array<Vec3, 3> steps_;
};

/// Rounding must not decide on which side of a face a point lies.
constexpr double kOnFace = 1e-6;

/// The voxel whose centre is nearest to a point in voxels; -1 outside of the grid.
std::int64_t nearest_voxel(const VoxelGrid& grid, const Vec3& p) {
  std::array<Index, 3> voxel;
  for (int a = 0; a < 3; ++a) {
    const double up = std::floor(p[a] + (0.5 + kOnFace));
    if (!(up >= 0) || !(up < grid.size[static_cast<std::size_t>(a)])) return -1;
    voxel[static_cast<std::size_t>(a)] = static_cast<Index>(up);
  }
  return static_cast<std::int64_t>(grid.offset(voxel[0], voxel[1], voxel[2]));
}

/// Calls visit(offset in the grid, point in voxels of `from`) for each voxel of the grid, line by
/// line in threads.
template <class Visit>
void for_each_voxel(const VoxelGrid& from, const VoxelGrid& grid, Visit visit) {
  const VoxelTransform transform(grid, from);
  const auto rows = static_cast<std::size_t>(grid.size[1]);
  parallel_blocks(rows * static_cast<std::size_t>(grid.size[2]), 64,
                  [&](std::size_t begin, std::size_t end) {
                    for (std::size_t line = begin; line < end; ++line) {
                      const auto j = static_cast<Index>(line % rows);
                      const auto k = static_cast<Index>(line / rows);
                      const Vec3 first = transform.line(j, k);
                      const std::size_t offset = grid.offset(0, j, k);
                      for (Index i = 0; i < grid.size[0]; ++i) {
                        visit(offset + static_cast<std::size_t>(i),
                              first + static_cast<double>(i) * transform.step());
                      }
                    }
                  });
}

/// Calls visit(label, {i, j, k}) for each voxel of a layer that is not background.
template <class Visit>
void for_each_label(const LabelMap& map, Index layer, Visit visit) {
  const auto& labels = map.layers[static_cast<std::size_t>(layer)];
  std::size_t at = 0;
  for (Index k = 0; k < map.size[2]; ++k) {
    for (Index j = 0; j < map.size[1]; ++j) {
      for (Index i = 0; i < map.size[0]; ++i, ++at) {
        if (labels[at] != 0) visit(labels[at], std::array<Index, 3>{i, j, k});
      }
    }
  }
}

/// The ranges of the segments of a map while its voxels are visited; one more for labels without.
class RangeFinder {
 public:
  explicit RangeFinder(const LabelMap& map)
      : ranges_(map.segments.size() + 1, CropRange{map.size, {0, 0, 0}}) {}
  void include(std::size_t n, const std::array<Index, 3>& voxel) {
    for (std::size_t a = 0; a < 3; ++a) {
      ranges_[n].begin[a] = std::min(ranges_[n].begin[a], voxel[a]);
      ranges_[n].end[a] = std::max(ranges_[n].end[a], voxel[a] + 1);
    }
  }
  std::optional<CropRange> range(std::size_t n) const {
    return ranges_[n].end[0] > 0 ? std::optional(ranges_[n]) : std::nullopt;
  }

 private:
  std::vector<CropRange> ranges_;
};

/// The labels of each layer, in ascending order.
std::vector<std::uint16_t> labels_of(const std::vector<std::uint16_t>& layer,
                                     std::vector<bool>& seen) {
  std::vector<std::uint16_t> labels;
  for (const std::uint16_t label : layer) {
    if (label == 0 || seen[label]) continue;
    seen[label] = true;
    labels.push_back(label);
  }
  for (const std::uint16_t label : labels) seen[label] = false;
  std::sort(labels.begin(), labels.end());
  return labels;
}

void require_count(std::size_t segments) {
  if (segments <= static_cast<std::size_t>(kMaxLabel)) return;
  throw InputError(message("label map: expected at most ", kMaxLabel, " segments, found more"));
}

/// Layer and label of each label that occurs and has no segment.
std::vector<std::pair<Index, Index>> labels_without_segment(const LabelMap& map) {
  std::set<std::pair<Index, Index>> named;
  for (const Segment& s : map.segments) named.emplace(s.layer, s.label);
  std::vector<bool> seen(std::size_t{kMaxLabel} + 1);
  std::vector<std::pair<Index, Index>> missing;
  for (std::size_t n = 0; n < map.layers.size(); ++n) {
    for (const std::uint16_t label : labels_of(map.layers[n], seen)) {
      const std::pair<Index, Index> key(static_cast<Index>(n), label);
      if (!named.count(key)) missing.push_back(key);
    }
    require_count(map.segments.size() + missing.size());
  }
  return missing;
}

void require_segments(const LabelMap& map) {
  require_count(map.segments.size());
  std::set<std::pair<Index, Index>> named;
  for (const Segment& s : map.segments) {
    if (s.label < 1 || s.label > kMaxLabel) {
      throw InputError(
          message("label map: expected labels of 1 to ", kMaxLabel, ", found ", s.label));
    }
    if (s.layer < 0 || static_cast<std::size_t>(s.layer) >= map.layers.size()) {
      throw InputError(message("label map: expected a segment of one of ", map.layers.size(),
                               " layers, found layer ", s.layer));
    }
    if (s.name.empty())
      throw InputError(
          message("label map: expected a name for the label ", s.label, ", found none"));
    if (!named.emplace(s.layer, s.label).second) {
      throw InputError(
          message("label map: expected one segment per layer and label, found two for label ",
                  s.label, " of layer ", s.layer));
    }
  }
}

}  // namespace

Index label_at(const LabelMap& map, Index layer, const Vec3& world) {
  const std::int64_t voxel = nearest_voxel(map, VoxelTransform::in_voxels(map, world));
  const auto& labels = map.layers[static_cast<std::size_t>(layer)];
  return voxel < 0 ? 0 : labels[static_cast<std::size_t>(voxel)];
}

LabelMap labels_on(const LabelMap& map, const VoxelGrid& grid) {
  LabelMap out{grid, {}, map.segments};
  out.layers.assign(map.layers.size(), std::vector<std::uint16_t>(grid.voxel_count()));
  for_each_voxel(map, grid, [&](std::size_t at, const Vec3& p) {
    const std::int64_t voxel = nearest_voxel(map, p);
    if (voxel < 0) return;
    for (std::size_t n = 0; n < map.layers.size(); ++n) {
      out.layers[n][at] = map.layers[n][static_cast<std::size_t>(voxel)];
    }
  });
  return out;
}

std::vector<std::uint8_t> mask_on(const LabelMap& map, std::span<const Segment> segments,
                                  const VoxelGrid& grid) {
  std::map<Index, std::vector<std::uint8_t>> wanted;  // per layer, whether a label is meant
  for (const Segment& s : segments) {
    auto& labels = wanted.try_emplace(s.layer, std::size_t{kMaxLabel} + 1).first->second;
    labels[static_cast<std::size_t>(s.label)] = 1;
  }
  std::vector<std::uint8_t> mask(grid.voxel_count());
  for_each_voxel(map, grid, [&](std::size_t at, const Vec3& p) {
    const std::int64_t voxel = nearest_voxel(map, p);
    if (voxel < 0) return;
    for (const auto& [layer, labels] : wanted) {
      const auto& layer_labels = map.layers[static_cast<std::size_t>(layer)];
      mask[at] |= labels[layer_labels[static_cast<std::size_t>(voxel)]];
    }
  });
  return mask;
}

std::vector<float> probability_on(const Probabilities& from, Index layer, const VoxelGrid& grid) {
  if (std::min({from.size[0], from.size[1], from.size[2]}) < 2) {
    throw InputError(message("probabilities: expected at least 2 voxels in each direction, found ",
                             from.size[0], " x ", from.size[1], " x ", from.size[2]));
  }
  const std::span<const float> values = from.layers[static_cast<std::size_t>(layer)];
  std::vector<float> out(grid.voxel_count());
  for_each_voxel(from, grid, [&](std::size_t at, const Vec3& p) {
    if (nearest_voxel(from, p) < 0) return;
    out[at] = static_cast<float>(interpolate(values, from.size, {1, 1, 1}, p));
  });
  return out;
}

LabelMap most_probable(const Probabilities& from) {
  LabelMap map;
  static_cast<VoxelGrid&>(map) = from;
  map.segments = from.segments;
  for (Segment& segment : map.segments) segment.layer = 0;
  map.layers.assign(1, std::vector<std::uint16_t>(from.voxel_count(), 0));
  parallel_for(map.layers[0].size(), [&](std::size_t n) {
    float rest = 1, most = 0;
    std::uint16_t best = 0;
    for (std::size_t layer = 0; layer < from.layers.size(); ++layer) {
      const float p = from.layers[layer][n];
      rest -= p;
      if (p > most) {
        most = p;
        best = static_cast<std::uint16_t>(from.segments[layer].label);
      }
    }
    map.layers[0][n] = rest > most ? std::uint16_t{0} : best;
  });
  return map;
}

std::optional<CropRange> range_of(const LabelMap& map, const Segment& segment) {
  RangeFinder finder(map);
  for_each_label(map, segment.layer, [&](std::uint16_t label, const std::array<Index, 3>& voxel) {
    if (label == segment.label) finder.include(0, voxel);
  });
  return finder.range(0);
}

std::vector<std::optional<CropRange>> ranges_of(const LabelMap& map) {
  RangeFinder finder(map);
  std::vector<std::size_t> segment_of(std::size_t{kMaxLabel} + 1);
  for (Index layer = 0; static_cast<std::size_t>(layer) < map.layers.size(); ++layer) {
    std::fill(segment_of.begin(), segment_of.end(), map.segments.size());
    for (std::size_t n = 0; n < map.segments.size(); ++n) {
      const Segment& s = map.segments[n];
      if (s.layer == layer) segment_of[static_cast<std::size_t>(s.label)] = n;
    }
    for_each_label(map, layer, [&](std::uint16_t label, const std::array<Index, 3>& voxel) {
      finder.include(segment_of[label], voxel);
    });
  }
  std::vector<std::optional<CropRange>> ranges;
  for (std::size_t n = 0; n < map.segments.size(); ++n) ranges.push_back(finder.range(n));
  return ranges;
}

bool look_like_labels(const VoxelGrid& grid, std::span<const float> samples) {
  constexpr double kMostlyEqual = 0.8;
  constexpr float kNear = 0.01f;  // of a whole number
  std::size_t pairs = 0, equal = 0;
  float only = 0, last = 0;
  bool several = false;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const float label = std::round(samples[n]);
    if (!(std::abs(samples[n] - label) <= kNear) || label < 0) return false;
    if (n % static_cast<std::size_t>(grid.size[0]) == 0) last = 0;
    if (label != 0) {
      several |= only != 0 && label != only;
      only = label;
      if (last != 0) ++pairs;
      if (last == label) ++equal;
    }
    last = label;
  }
  if (pairs == 0) return only != 0 && !several;
  return static_cast<double>(equal) >= kMostlyEqual * static_cast<double>(pairs);
}

LabelPairs count_pairs(const LabelMap& map) {
  const std::array<std::size_t, 3> steps{1, map.offset(0, 1, 0), map.offset(0, 0, 1)};
  LabelPairs sum;
  for (const auto& labels : map.layers) {
    const auto of_blocks = parallel_collect<LabelPairs>(
        labels.size(), kBlock, [&](std::size_t begin, std::size_t end, auto& out) {
          LabelPairs pairs;
          for (std::size_t n = begin; n < end; ++n) {
            const auto at = map.voxel(n);
            for (std::size_t a = 0; a < 3; ++a) {
              if (at[a] + 1 >= map.size[a]) continue;
              const std::uint16_t here = labels[n], there = labels[n + steps[a]];
              pairs.all += here != 0 || there != 0 ? 1U : 0U;
              pairs.different += here != there ? 1U : 0U;
            }
          }
          out.push_back(pairs);
        });
    for (const LabelPairs& pairs : of_blocks) {
      sum.all += pairs.all;
      sum.different += pairs.different;
    }
  }
  return sum;
}

std::vector<std::size_t> voxel_counts(const LabelMap& map) {
  std::vector<std::vector<std::size_t>> counts(map.layers.size());
  for (std::size_t n = 0; n < map.layers.size(); ++n) {
    counts[n].resize(std::size_t{kMaxLabel} + 1);
    for (const std::uint16_t label : map.layers[n]) ++counts[n][label];
  }
  std::vector<std::size_t> out;
  out.reserve(map.segments.size());
  for (const Segment& segment : map.segments) {
    out.push_back(
        counts[static_cast<std::size_t>(segment.layer)][static_cast<std::size_t>(segment.label)]);
  }
  return out;
}

LabelMap with_all_segments(LabelMap map) {
  for (const auto& [layer, label] : labels_without_segment(map)) {
    map.segments.push_back({"label " + std::to_string(label), label, layer, default_colour(label)});
  }
  return map;
}

LabelMap with_names(LabelMap map, std::span<const Segment> table) {
  std::map<std::int64_t, const Segment*> rows;
  const auto number_of = [](const Segment& s) {
    return s.number_in_file > 0 ? s.number_in_file : std::int64_t{s.label};
  };
  for (const Segment& row : table) rows.emplace(number_of(row), &row);
  for (Segment& segment : map.segments) {
    const auto row = rows.find(number_of(segment));
    if (row == rows.end()) continue;
    segment.name = row->second->name;
    segment.colour = row->second->colour;
  }
  return map;
}

std::array<std::uint8_t, 3> default_colour(Index label) {
  // Hues a golden section of the circle apart never come close to their neighbours.
  const double hue = 6 * std::fmod(0.618033988749895 * label, 1.0);
  std::array<std::uint8_t, 3> colour;
  for (std::size_t c = 0; c < 3; ++c) {
    const double away = std::fmod(hue + 2.0 * static_cast<double>(3 - c), 6.0);  // 0: this colour
    const double share = std::clamp(std::abs(away - 3) - 1, 0.0, 1.0);
    colour[c] = static_cast<std::uint8_t>(std::lround(80 + 175 * share));
  }
  return colour;
}

void require_valid(const LabelMap& map) {
  if (map.layers.empty())
    throw InputError(message("label map: expected at least one layer, found none"));
  for (const auto& layer : map.layers) {
    if (layer.size() != map.voxel_count()) {
      throw InputError(message("label map: expected ", map.voxel_count(),
                               " labels in each layer, found ", layer.size()));
    }
  }
  require_segments(map);
  const auto missing = labels_without_segment(map);
  if (!missing.empty()) {
    throw InputError(message("label map: expected a segment for the label ", missing[0].second,
                             " of layer ", missing[0].first, ", found none"));
  }
}

}  // namespace mesamis
