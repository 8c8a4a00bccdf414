// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/two_sided_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesamis/base/each_once.h"
#include "mesamis/surface/box_tree.h"

namespace mesamis::detail::decimate {
namespace {

/// The originals, increasing, of the triangles that do not stay, and those at their corners.
std::vector<Index> originals_at_stake(const TriMesh& original, const Cover& cover,
                                      const std::vector<char>& stays) {
  std::vector<Index> numbers;
  for (std::size_t t = 0; t < stays.size(); ++t) {
    if (stays[t] != 0) continue;
    numbers.insert(numbers.end(), cover.originals[t].begin(), cover.originals[t].end());
  }
  std::vector<bool> is_corner(original.points.size());
  for (const Index o : numbers) {
    for (const Index p : original.triangles[o]) is_corner[p] = true;
  }
  for (std::size_t t = 0; t < stays.size(); ++t) {
    if (stays[t] == 0) continue;
    for (const Index o : cover.originals[t]) {
      const Triangle& k = original.triangles[o];
      if (is_corner[k[0]] || is_corner[k[1]] || is_corner[k[2]]) numbers.push_back(o);
    }
  }
  sort_once(numbers);
  return numbers;
}

/// Of each triangle 1 if its corners are held.
std::vector<char> staying(const Cover& cover, const std::vector<char>& held) {
  std::vector<char> stays;
  for (const Triangle& k : cover.triangles) {
    stays.push_back(held[k[0]] != 0 && held[k[1]] != 0 && held[k[2]] != 0 ? 1 : 0);
  }
  return stays;
}

/// Some triangles of a surface, by themselves.
EditableSurface part_of(const TriMesh& surface, const std::vector<Index>& numbers) {
  std::vector<Index> points;
  for (const Index t : numbers) {
    points.insert(points.end(), surface.triangles[t].begin(), surface.triangles[t].end());
  }
  sort_once(points);
  std::vector<Triangle> triangles;
  for (const Index t : numbers) {
    Triangle k = surface.triangles[t];
    for (Index& p : k) {
      p = static_cast<Index>(std::lower_bound(points.begin(), points.end(), p) - points.begin());
    }
    triangles.push_back(k);
  }
  return {points.size(), triangles};
}

}  // namespace

TwoSidedBound::TwoSidedBound(const TriMesh& original, const Cover& cover,
                             const std::vector<char>& held, double tolerance)
    : cover_(cover),
      tolerance_(tolerance),
      walk_(tolerance),
      covering_(tolerance),
      stays_(staying(cover, held)),
      numbers_(originals_at_stake(original, cover, stays_)),
      original_surface_(part_of(original, numbers_)) {
  originals_.reserve(numbers_.size());
  for (const Index t : numbers_) {
    originals_.emplace_back(corners_of(original, original.triangles[t]));
  }
  lists_.resize(stays_.size());
  bounds_.reserve(stays_.size());
  triangles_.reserve(stays_.size());
  for (std::size_t t = 0; t < lists_.size(); ++t) {
    bounds_.push_back({cover.to_originals[t], cover.from_originals[t]});
    if (stays_[t] != 0) continue;
    for (const Index o : cover.originals[t]) {
      lists_[t].push_back(static_cast<Index>(std::lower_bound(numbers_.begin(), numbers_.end(), o) -
                                             numbers_.begin()));
    }
  }
  for (const Triangle& t : cover.triangles) {
    triangles_.emplace_back(Corners{cover.points[t[0]], cover.points[t[1]], cover.points[t[2]]});
  }
  seen_.assign(numbers_.size(), 0);
  seen_points_.assign(original_surface_.points(), 0);
}

std::vector<Index> TwoSidedBound::originals_of(Index triangle) const {
  std::vector<Index> numbers;
  if (stays_[triangle] != 0) numbers = cover_.originals[triangle];
  for (const Index o : lists_[triangle]) numbers.push_back(numbers_[o]);
  sort_once(numbers);
  return numbers;
}

bool TwoSidedBound::allows(const EditableSurface& surface, const std::vector<Vec3>& points,
                           const Collapse& collapse) {
  if (!ends_are_near(points, collapse)) return false;
  start(collapse.faces);
  gather(collapse);
  see_after(collapse);
  const Bounds lifted = bounds_after(collapse.height, {collapse.faces, collapse.gone()});
  if (lift(lifted, collapse.faces)) return true;
  if (!old_are_near({surface, triangles_, &collapse}, collapse.faces)) return false;
  next_.assign(collapse.faces.size(), {lifted.to_originals, 0});
  return lifted.to_originals <= tolerance_ || new_are_near(collapse.faces);
}

bool TwoSidedBound::allows(const EditableSurface& surface, const Flip& flip) {
  start(flip.faces);
  for (const Index t : flip.faces) gather(t, t);
  for (const Corners& t : flip.after) after_.emplace_back(t);
  const Bounds lifted = bounds_after(flip.height, {flip.faces});
  if (lift(lifted, flip.faces)) return true;
  if (!old_are_near({surface, triangles_}, flip.faces)) return false;
  next_.assign(flip.faces.size(), {lifted.to_originals, 0});
  return lifted.to_originals <= tolerance_ || new_are_near(flip.faces);
}

/// @param faces  that change.
void TwoSidedBound::start(std::span<const Index> faces) {
  ++collapse_count_;
  affected_.clear();
  after_.clear();
  around_.clear();
  around_number_.assign(faces.begin(), faces.end());
  uses_.clear();
  next_.clear();
}

/// The triangles that come: their sides lie at the half-edges of the same numbers.
void TwoSidedBound::see_after(const Collapse& collapse) {
  for (std::size_t i = 0; i < collapse.after.size(); ++i) {
    const Corners& t = collapse.after[i];
    const auto at = static_cast<std::size_t>(collapse.outer[i] % 3);
    Corners turned;
    for (std::size_t k = 0; k < 3; ++k) turned[(at + k) % 3] = t[(k + 1) % 3];
    after_.emplace_back(turned);
  }
}

/// Puts the triangles that come in the place of those before, or back.
void TwoSidedBound::swap_after(std::span<const Index> faces) {
  for (std::size_t i = 0; i < after_.size(); ++i) std::swap(after_[i], triangles_[faces[i]]);
}

void TwoSidedBound::apply(const Collapse& collapse) {
  for (const Index t : collapse.gone()) lists_[t].clear();
  replace(collapse.faces);
}

/// Puts what was found for the triangles that come in the place of those before.
void TwoSidedBound::replace(std::span<const Index> faces) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    lists_[faces[i]].clear();
    bounds_[faces[i]] = next_[i];
    triangles_[faces[i]] = after_[i];
  }
  for (const Use& use : uses_) {
    std::vector<Index>& list = lists_[use.triangle];
    double& distance = bounds_[use.triangle].from_originals;
    distance = std::max(distance, use.distance);
    add_once(list, use.original);
  }
}

/// The cheapest test: whether the points that go or move are near what comes.
bool TwoSidedBound::ends_are_near(const std::vector<Vec3>& points, const Collapse& collapse) const {
  const auto is_near = [&](Index p) {
    return std::any_of(collapse.after.begin(), collapse.after.end(), [&](const Corners& t) {
      return squared_distance(points[p], t) <= tolerance_ * tolerance_;
    });
  };
  return is_near(collapse.removed) && (!collapse.moves || is_near(collapse.kept));
}

/// The originals that a triangle stands for which changes or goes.
void TwoSidedBound::gather(Index triangle, Index guess) {
  for (const Index o : lists_[triangle]) {
    if (seen_[o] == collapse_count_) continue;
    seen_[o] = collapse_count_;
    affected_.push_back({o, guess, 0});
    for (const Index p : original_surface_.triangle(o)) seen_points_[p] = collapse_count_;
  }
}

void TwoSidedBound::gather(const Collapse& collapse) {
  for (const Index t : collapse.faces) gather(t, t);
  for (const Index t : collapse.gone()) gather(t, collapse.faces[0]);
}

/// What holds for all of some triangles after a change that is nowhere higher.
TwoSidedBound::Bounds TwoSidedBound::bounds_after(
    double height, std::initializer_list<std::span<const Index>> triangles) const {
  Bounds greatest;
  for (const auto some : triangles) {
    for (const Index t : some) {
      greatest.to_originals = std::max(greatest.to_originals, bounds_[t].to_originals);
      greatest.from_originals = std::max(greatest.from_originals, bounds_[t].from_originals);
    }
  }
  return {greatest.to_originals + height, greatest.from_originals + height};
}

/// Whether bounds are within the tolerance; then each triangle that comes stands for the originals that
/// it may be near.
bool TwoSidedBound::lift(const Bounds& bounds, std::span<const Index> faces) {
  if (!(std::max(bounds.to_originals, bounds.from_originals) <= tolerance_)) return false;
  next_.assign(faces.size(), bounds);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    Box reach = after_[i].box();
    for (int axis = 0; axis < 3; ++axis) {
      reach.lo[axis] -= bounds.from_originals;
      reach.hi[axis] += bounds.from_originals;
    }
    for (const Affected& a : affected_) {
      const TrianglePlanes& original = originals_[a.original];
      if (overlap(reach, original.box()) &&
          !after_[i].is_beyond(original.corners(), bounds.from_originals)) {
        uses_.push_back({a.original, faces[i], bounds.from_originals});
      }
    }
  }
  return true;
}

/// The triangles that come, and those at the ends of what changes; once for a change.
void TwoSidedBound::look_around(const WalkedSurface& on) {
  if (!around_.empty()) return;
  const EditableSurface& surface = on.surface;
  const Collapse* const collapse = on.collapse;
  const auto see = [&](Index p) {
    surface.for_each_leaving(p, [&](Index h) {
      const Index t = h / 3;
      const bool goes =
          collapse != nullptr && (t == collapse->beside[0] || t == collapse->beside[1]);
      if (!goes) add_once(around_number_, t);
    });
  };
  if (collapse != nullptr) {
    for (const Index h : collapse->outer) see(surface.from(h));
    see(surface.to(collapse->outer.back()));
    if (!collapse->moves) see(collapse->kept);
  } else {
    const std::array flipped{around_number_[0], around_number_[1]};
    for (const Index t : flipped) {
      for (const Index p : surface.triangle(t)) see(p);
    }
  }
  for (const Index t : around_number_) around_.push_back(&triangles_[t]);
}

/// Whether the centres of the originals are near; what is farthest comes first from now on, and most
/// refusals are found there.
bool TwoSidedBound::centers_are_near(const WalkedSurface& on) {
  const double most = tolerance_ * tolerance_;
  for (Affected& a : affected_) {
    const Corners& t = originals_[a.original].corners();
    const Vec3 center = (1.0 / 3) * (t[0] + t[1] + t[2]);
    a.guess = RimWalk::triangle_at(on, center, a.guess);
    a.distance = triangles_[a.guess].squared_distance_up_to(most, center);
    if (a.distance <= most) continue;
    look_around(on);
    for (std::size_t n = 0; a.distance > most && n < around_.size(); ++n) {
      const double distance =
          around_[n]->squared_distance_up_to(std::min(most, a.distance), center);
      if (distance >= a.distance) continue;
      a.distance = distance;
      a.guess = around_number_[n];
    }
    if (a.distance > most) return false;
  }
  std::sort(affected_.begin(), affected_.end(), [](const Affected& a, const Affected& b) {
    return std::pair{-a.distance, a.original} < std::pair{-b.distance, b.original};
  });
  return true;
}

bool TwoSidedBound::old_are_near(const WalkedSurface& on, std::span<const Index> faces) {
  swap_after(faces);
  const bool are_near =
      centers_are_near(on) && std::all_of(affected_.begin(), affected_.end(),
                                          [&](const Affected& a) { return is_near(a, on); });
  swap_after(faces);
  return are_near;
}

/// Whether an original is near the surface; then it says which triangles stand for it.
bool TwoSidedBound::is_near(const Affected& a, const WalkedSurface& on) {
  double distance = walk_.bound(originals_[a.original], on, a.guess);
  if (std::isfinite(distance)) {
    for (const Index used : walk_.used(on)) uses_.push_back({a.original, used, distance});
    return true;
  }
  look_around(on);
  const double most = tolerance_ * tolerance_;
  if (std::none_of(around_.begin(), around_.end(), [&](const TrianglePlanes* t) {
        return t->squared_distance_up_to(most, walk_.stop()) <= most;
      })) {
    return false;
  }
  distance = covering_.bound(originals_[a.original].corners(), around_);
  if (!std::isfinite(distance)) return false;
  for (const Index used : covering_.used()) {
    uses_.push_back({a.original, around_number_[used], distance});
  }
  return true;
}

bool TwoSidedBound::new_are_near(std::span<const Index> faces) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    next_[i].to_originals = distance_of_new(faces[i], after_[i]);
    if (!std::isfinite(next_[i].to_originals)) return false;
  }
  return true;
}

/// From a triangle that comes to the originals, mm; infinity: too far.
double TwoSidedBound::distance_of_new(Index face, const TrianglePlanes& after) {
  if (affected_.empty()) return std::numeric_limits<double>::infinity();
  near_.clear();
  Index start = affected_.front().original;
  for (const Use& use : uses_) {
    if (use.triangle != face) continue;
    near_.push_back(&originals_[use.original]);
    start = use.original;
  }
  const WalkedSurface affected{original_surface_, originals_, nullptr, seen_points_,
                               collapse_count_};
  double distance = walk_.bound(after, affected, start);
  if (!std::isfinite(distance)) distance = covering_.bound(after.corners(), near_);
  if (!std::isfinite(distance)) {
    near_.clear();
    for (const Affected& a : affected_) near_.push_back(&originals_[a.original]);
    distance = covering_.bound(after.corners(), near_);
  }
  return distance;
}

}  // namespace mesamis::detail::decimate
