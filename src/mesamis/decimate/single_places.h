// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>

#include "mesamis/base/error.h"
#include "mesamis/base/single_precision.h"
#include "mesamis/base/types.h"

/// Places that single precision can name.
namespace mesamis::detail::decimate {

/// @throws InputError  if a coordinate exceeds single precision.
inline void require_single(std::span<const Vec3> points) {
  constexpr double kLargest = 1e38;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    // Comparisons with NaN are false.
    if (std::abs(p.x) < kLargest && std::abs(p.y) < kLargest && std::abs(p.z) < kLargest) continue;
    throw InputError("surface: point " + std::to_string(i) +
                     ": expected coordinates below 1e38, which single precision holds, found more");
  }
}

struct ByPlace {
  bool operator()(const Vec3& a, const Vec3& b) const {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  }
};

/// The k-th single precision number after x (before it, if k < 0).
inline double stepped(double x, int k) {
  auto y = static_cast<float>(x);
  const float end = std::numeric_limits<float>::infinity();
  for (; k > 0; --k) y = std::nextafter(y, end);
  for (; k < 0; ++k) y = std::nextafter(y, -end);
  return y + 0.0f;
}

/// The places that points have taken, each by one point.
class SinglePlaces {
 public:
  /// @return  whether the place was free.
  bool take(const Vec3& place) { return taken_.insert(place).second; }

  /// Takes the free place around a taken one that is nearest to the exact point.
  Vec3 take_nearest(const Vec3& place, const Vec3& exact) {
    std::optional<Vec3> free;
    for (int reach = 1; !free; ++reach) free = nearest_free(place, exact, reach);
    taken_.insert(*free);
    return *free;
  }

 private:
  std::optional<Vec3> nearest_free(const Vec3& place, const Vec3& exact, int reach) const {
    std::optional<Vec3> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (int i = -reach; i <= reach; ++i) {
      for (int j = -reach; j <= reach; ++j) {
        for (int k = -reach; k <= reach; ++k) {
          const Vec3 p{stepped(place.x, i), stepped(place.y, j), stepped(place.z, k)};
          const double d = norm(p - exact);
          if (d >= least || taken_.count(p)) continue;
          least = d;
          nearest = p;
        }
      }
    }
    return nearest;
  }

  std::set<Vec3, ByPlace> taken_;
};

}  // namespace mesamis::detail::decimate
