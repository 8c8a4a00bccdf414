// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::surface {

/// Sets of items 0 ... n - 1 that grow together. The smallest item names its set, so that the
/// names do not depend on the order of the unions.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) {
    // Grown item by item: gcc 12 takes the fill of a sized vector for one out of bounds.
    parent_.reserve(n);
    for (std::size_t item = 0; item < n; ++item) parent_.push_back(item);
  }

  std::size_t find(std::size_t item) {
    while (parent_[item] != item) {
      parent_[item] = parent_[parent_[item]];
      item = parent_[item];
    }
    return item;
  }

  void unite(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a > b) std::swap(a, b);
    parent_[b] = a;
  }

  /// The number of the set of each item; sets are numbered in the order of their first items.
  struct Numbers {
    std::vector<Index> of_item;
    Index count = 0;  ///< of sets
  };
  Numbers numbers() {
    Numbers numbers;
    numbers.of_item.reserve(parent_.size());
    for (std::size_t item = 0; item < parent_.size(); ++item) {
      const std::size_t first = find(item);  // never after this item
      numbers.of_item.push_back(first == item ? numbers.count++ : numbers.of_item[first]);
    }
    return numbers;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace mesamis::detail::surface
