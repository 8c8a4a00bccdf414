// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/rim_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/base/each_once.h"

namespace mesamis::detail::decimate {
namespace {

/// Triangles that a walk crosses between two corners.
constexpr int kMostCrossed = 64;
/// Steps towards a point.
constexpr int kMostStepsToPoint = 16;
constexpr std::size_t kNoSide = 3;

/// Where a segment leaves a triangle.
struct Exit {
  std::size_t side = kNoSide;
  double share = 2;  ///< of the way
};

/// @param entry  a side that it does not leave by, or kNoSide.
Exit exit_of(const TrianglePlanes& t, const Vec3& from, const Vec3& to, std::size_t entry) {
  Exit exit;
  double farthest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double there = t.beyond(i, to);
    if (i == entry || !(there > 0)) continue;
    const double here = t.beyond(i, from), share = here < 0 ? here / (here - there) : 0;
    if (share > exit.share || (share == exit.share && there <= farthest)) continue;
    exit = {i, share};
    farthest = there;
  }
  return exit;
}

/// Points of a surface, each once, by a half-edge that leaves it.
template <std::size_t kMostPoints>
class PointSet {
 public:
  /// @return false  if there is no room.
  bool add(const WalkedSurface& on, Index leaving) {
    const Index p = on.from(leaving);
    if (std::find(points_.begin(), points_.begin() + count_, p) != points_.begin() + count_)
      return true;
    if (count_ == kMostPoints) return false;
    points_[static_cast<std::size_t>(count_)] = p;
    leaving_[static_cast<std::size_t>(count_++)] = leaving;
    return true;
  }
  std::ptrdiff_t count() const { return count_; }
  Index leaving(std::ptrdiff_t n) const { return leaving_[static_cast<std::size_t>(n)]; }

 private:
  std::array<Index, kMostPoints> points_, leaving_;
  std::ptrdiff_t count_ = 0;
};

}  // namespace

Index WalkedSurface::opposite(Index h) const {
  Index o = surface.opposite(h);
  if (o == kNoIndex) return o;
  if (collapse != nullptr) {
    for (const Index edge : {collapse->half_edge, surface.opposite(collapse->half_edge)}) {
      if (edge == kNoIndex || o / 3 != edge / 3) continue;
      const Index next = EditableSurface::next(edge);
      return surface.opposite(o == next ? EditableSurface::previous(edge) : next);
    }
  }
  if (marks.empty()) return o;
  const Triangle k = surface.triangle(o / 3);
  const bool is_there = std::any_of(
      k.begin(), k.end(), [this](Index p) { return marks[static_cast<std::size_t>(p)] == mark; });
  return is_there ? o : kNoIndex;
}

Index RimWalk::triangle_at(const WalkedSurface& on, const Vec3& p, Index start) {
  Index t = start, last = kNoIndex;
  for (int step = 0; step < kMostStepsToPoint; ++step) {
    const TrianglePlanes& here = on.triangles[t];
    const std::array<double, 3> beyond{here.beyond(0, p), here.beyond(1, p), here.beyond(2, p)};
    const auto side = std::max_element(beyond.begin(), beyond.end());
    if (!(*side > 0)) return t;
    const Index o = on.opposite(3 * t + static_cast<Index>(side - beyond.begin()));
    if (o == kNoIndex || o / 3 == last) return t;
    last = t;
    t = o / 3;
  }
  return t;
}

double RimWalk::bound(const TrianglePlanes& triangle, const WalkedSurface& on, Index start) {
  found_ = 0;
  enclosed_.clear();
  return goes_round(triangle, on, start) ? std::sqrt(found_)
                                         : std::numeric_limits<double>::infinity();
}

bool RimWalk::is_near(const Vec3& p, const TrianglePlanes& other) {
  const double distance = other.squared_distance_up_to(most_, p);
  if (distance > most_) return false;
  found_ = std::max(found_, distance);
  return true;
}

bool RimWalk::goes_round(const TrianglePlanes& triangle, const WalkedSurface& on, Index start) {
  const Corners& corners = triangle.corners();
  std::size_t first = 0;
  while (first < 3 && !is_near(corners[first], on.triangles[start])) ++first;
  if (first == 3) {
    first = 0;
    stop_ = corners[0];
    start = triangle_at(on, stop_, start);
    if (!is_near(stop_, on.triangles[start])) return false;
  }
  now_ = start;
  used_.assign(1, start);
  exit_count_ = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!goes_on(corners[(first + i) % 3], corners[(first + i + 1) % 3], on)) return false;
  }
  // The ends of what is near one of two triangles are near the other one.
  if (used_.size() <= 2) return true;
  if (!goes_back(corners[first], start, on)) return false;
  close_chain(on);
  return exit_count_ == 0 || is_filled(triangle, on);
}

/// Goes along the rim to a corner.
bool RimWalk::goes_on(const Vec3& from, const Vec3& to, const WalkedSurface& on) {
  Vec3 at = from;
  std::size_t entry = kNoSide;
  for (int crossed = 0; crossed < kMostCrossed; ++crossed) {
    const TrianglePlanes& here = on.triangles[now_];
    if (is_near(to, here)) return true;
    const Exit exit = exit_of(here, at, to, entry);
    stop_ = to;
    if (exit.side == kNoSide) return false;
    const Index h = 3 * now_ + static_cast<Index>(exit.side), o = on.opposite(h);
    if (o == kNoIndex) return false;
    at += exit.share * (to - at);
    stop_ = at;
    if (!is_near(at, here) || !is_near(at, on.triangles[o / 3]) || !cross(h, o)) return false;
    entry = static_cast<std::size_t>(o % 3);
  }
  return false;
}

/// Goes from the triangle at the end to that at the start, both near one corner, by others that are.
bool RimWalk::goes_back(const Vec3& at, Index first, const WalkedSurface& on) {
  const Corners& t = on.triangles[first].corners();
  const Vec3 center = (1.0 / 3) * (t[0] + t[1] + t[2]);
  std::size_t entry = kNoSide;
  stop_ = at;
  for (int crossed = 0; now_ != first && crossed < kMostCrossed; ++crossed) {
    const Exit exit = exit_of(on.triangles[now_], at, center, entry);
    if (exit.side == kNoSide) return false;
    const Index h = 3 * now_ + static_cast<Index>(exit.side), o = on.opposite(h);
    if (o == kNoIndex || !is_near(at, on.triangles[o / 3]) || !cross(h, o)) return false;
    entry = static_cast<std::size_t>(o % 3);
  }
  return now_ == first;
}

/// @return false  if there is no room.
bool RimWalk::cross(Index exit, Index entry) {
  if (std::max(used_.size(), exit_count_) == kMost) return false;
  now_ = entry / 3;
  add_once(used_, now_);
  if (exit_count_ > 0 && exits_[exit_count_ - 1] == entry) {
    --exit_count_;
  } else {
    exits_[exit_count_++] = exit;
  }
  return true;
}

/// Shortens the chain where its ends meet.
void RimWalk::close_chain(const WalkedSurface& on) {
  std::size_t begin = 0;
  while (exit_count_ >= begin + 2 && on.opposite(exits_[exit_count_ - 1]) == exits_[begin]) {
    ++begin;
    --exit_count_;
  }
  std::copy(exits_.begin() + static_cast<std::ptrdiff_t>(begin),
            exits_.begin() + static_cast<std::ptrdiff_t>(exit_count_), exits_.begin());
  exit_count_ -= begin;
}

/// Whether the points to the left of the chain are near their feet, triangles lie all around each, and
/// the chain goes round them once.
bool RimWalk::is_filled(const TrianglePlanes& triangle, const WalkedSurface& on) {
  if (triangle.is_flat()) return false;
  const auto end = exits_.begin() + static_cast<std::ptrdiff_t>(exit_count_);
  const auto is_exit = [&](Index h) { return std::find(exits_.begin(), end, h) != end; };
  PointSet<kMost> left;
  for (auto exit = exits_.begin(); exit != end; ++exit) {
    if (!left.add(on, EditableSurface::next(*exit))) return false;
  }
  std::size_t exits = 0;
  for (std::ptrdiff_t n = 0; n < left.count(); ++n) {
    Index h = left.leaving(n);
    const Vec3& p = on.triangles[h / 3].corners()[static_cast<std::size_t>(h % 3)];
    const Vec3 foot = triangle.foot_of(p), way = p - foot;
    const double distance = dot(way, way);
    const bool point_is_near = distance <= most_;  // which is in all triangles around it
    if (point_is_near) found_ = std::max(found_, distance);
    do {
      const Index o = on.opposite(h);
      if (o == kNoIndex || is_exit(h)) return false;  // a rim; or it is to the right of the chain
      if (!point_is_near && !is_near(foot, on.triangles[h / 3])) return false;
      if (is_exit(o)) {
        ++exits;
      } else if (!left.add(on, o)) {
        return false;
      }
      h = EditableSurface::next(o);
    } while (h != left.leaving(n));
  }
  if (exits != exit_count_) return false;
  for (std::ptrdiff_t n = 0; n < left.count(); ++n) enclosed_.push_back(left.leaving(n));
  return true;
}

const std::vector<Index>& RimWalk::used(const WalkedSurface& on) {
  for (const Index leaving : enclosed_) {
    Index h = leaving;
    do {
      add_once(used_, h / 3);
      h = EditableSurface::next(on.opposite(h));
    } while (h != leaving);
  }
  return used_;
}

}  // namespace mesamis::detail::decimate
