// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::slabs {

/// Numbers points in the order in which they come. Points are the same if their coordinates are, to
/// the bit; 0 and -0 are one.
class PointNumbers {
 public:
  struct Number {
    Index number;
    bool is_new;
  };
  Number of(const Vec3& p) {
    const auto [place, is_new] = known_.try_emplace(bits_of(p), static_cast<Index>(known_.size()));
    return {place->second, is_new};
  }
  /// kNoIndex for one that has none.
  Index find(const Vec3& p) const {
    const auto place = known_.find(bits_of(p));
    return place == known_.end() ? kNoIndex : place->second;
  }

 private:
  using Bits = std::array<std::uint64_t, 3>;
  static Bits bits_of(const Vec3& p) {
    return {std::bit_cast<std::uint64_t>(p.x + 0.0), std::bit_cast<std::uint64_t>(p.y + 0.0),
            std::bit_cast<std::uint64_t>(p.z + 0.0)};
  }
  struct Hash {
    std::size_t operator()(const Bits& bits) const noexcept {
      std::uint64_t hash = 0;
      for (const std::uint64_t word : bits) {
        hash = (hash ^ word) * 0x9e3779b97f4a7c15;
        hash ^= hash >> 32;
      }
      return hash;
    }
  };
  std::unordered_map<Bits, Index, Hash> known_;
};

}  // namespace mesamis::detail::slabs
