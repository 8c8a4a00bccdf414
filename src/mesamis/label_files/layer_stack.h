// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mesamis/files/memory_budget.h"
#include "mesamis/files/refuse.h"
#include "mesamis/image/label_map.h"

namespace mesamis::detail::label_files {

/// Puts objects one after another into the layers of a label map: each into the first layer where
/// none of its voxels is taken. The map and the budget must live as long.
class LayerStack {
 public:
  /// @param allow  called with the number of layers before one is added; may throw, may be empty.
  LayerStack(LabelMap& map, MemoryBudget& budget, std::function<void(std::size_t)> allow = {})
      : map_(map), budget_(budget), allow_(std::move(allow)) {}

  /// Adds a layer without labels.
  /// @throws InputError  as MemoryBudget::claim().
  void add_layer() {
    if (allow_) allow_(map_.layers.size() + 1);
    budget_.claim(map_.voxel_count(), sizeof(std::uint16_t), "labels");
    map_.layers.emplace_back(map_.voxel_count());
  }

  /// Adds an object and sets its layer.
  /// @param for_each  for_each(visit) calls visit(offset) for each voxel of the object, the same
  ///                  ones each time.
  /// @throws InputError  as add_layer().
  ///
  /// O(voxels of the object * layers).
  template <class ForEach>
  void add(Segment& segment, const ForEach& for_each) {
    const std::size_t layer = free_layer(segment, for_each);
    if (layer == map_.layers.size()) add_layer();
    segment.layer = static_cast<Index>(layer);
    for_each([&](std::size_t voxel) {
      map_.layers[layer][voxel] = static_cast<std::uint16_t>(segment.label);
    });
    placed_.push_back(segment);
  }

  /// One line about the objects that overlap others; empty if none does.
  std::string overlap_note() const {
    if (objects_ == 0) return {};
    return message(objects_, objects_ == 1 ? " object overlaps" : " objects overlap",
                   " others: each stays whole. The first is ", in_quotes(first_), " with ",
                   first_voxels_, first_voxels_ == 1 ? " voxel of " : " voxels of ",
                   in_quotes(first_other_));
  }

 private:
  template <class ForEach>
  std::size_t free_layer(const Segment& segment, const ForEach& for_each) {
    std::vector<std::size_t> taken(map_.layers.size());
    std::vector<std::uint16_t> by(map_.layers.size());
    for_each([&](std::size_t voxel) {
      for (std::size_t n = 0; n < taken.size(); ++n) {
        const std::uint16_t label = map_.layers[n][voxel];
        if (label == 0) continue;
        ++taken[n];
        by[n] = label;
      }
    });
    const auto first = std::find_if(taken.begin(), taken.end(), [](auto n) { return n > 0; });
    if (first != taken.end())
      note(segment, static_cast<std::size_t>(first - taken.begin()), taken, by);
    return static_cast<std::size_t>(std::find(taken.begin(), taken.end(), 0u) - taken.begin());
  }

  void note(const Segment& segment, std::size_t layer, const std::vector<std::size_t>& taken,
            const std::vector<std::uint16_t>& by) {
    if (objects_++ > 0) return;
    first_ = segment.name;
    first_voxels_ = taken[layer];
    for (const Segment& other : placed_) {
      if (other.label == by[layer]) first_other_ = other.name;
    }
  }

  LabelMap& map_;
  MemoryBudget& budget_;
  std::function<void(std::size_t)> allow_;
  std::vector<Segment> placed_;
  std::size_t objects_ = 0, first_voxels_ = 0;
  std::string first_, first_other_;
};

}  // namespace mesamis::detail::label_files
