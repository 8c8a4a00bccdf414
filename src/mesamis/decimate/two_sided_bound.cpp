// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/two_sided_bound.h"

#include <algorithm>
#include <cmath>

#include "mesamis/surface/box_tree.h"

namespace mesamis::detail::decimate {

TwoSidedBound::TwoSidedBound(const TriMesh& original, const Cover& cover,
                             const std::vector<char>& held, double tolerance)
    : cover_(cover), tolerance_(tolerance), covering_(tolerance) {
  for (std::size_t t = 0; t < cover.triangles.size(); ++t) {
    const Triangle& k = cover.triangles[t];
    stays_.push_back(held[k[0]] != 0 && held[k[1]] != 0 && held[k[2]] != 0 ? 1 : 0);
    if (stays_[t] != 0) continue;
    numbers_.insert(numbers_.end(), cover.originals[t].begin(), cover.originals[t].end());
  }
  std::sort(numbers_.begin(), numbers_.end());
  numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
  for (const Index t : numbers_) {
    originals_.emplace_back(corners_of(original, original.triangles[t]));
  }
  lists_.resize(stays_.size());
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
}

std::vector<Index> TwoSidedBound::originals_of(Index triangle) const {
  std::vector<Index> numbers;
  if (stays_[triangle] != 0) numbers = cover_.originals[triangle];
  for (const Index o : lists_[triangle]) numbers.push_back(numbers_[o]);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

bool TwoSidedBound::allows(const EditableSurface& surface, const std::vector<Vec3>& points,
                           const Collapse& collapse) {
  if (!ends_are_near(points, collapse)) return false;
  gather(collapse);
  uses_.clear();
  next_.clear();
  after_.clear();
  for (const Corners& t : collapse.after) after_.emplace_back(t);
  Bounds lifted = bounds_before(collapse);
  lifted.to_originals += collapse.height;
  lifted.from_originals += collapse.height;
  if (std::max(lifted.to_originals, lifted.from_originals) <= tolerance_) {
    lift(lifted, collapse);
    return true;
  }
  look_around(surface, collapse);
  if (!old_are_near()) return false;
  next_.assign(collapse.faces.size(), {lifted.to_originals, 0});
  return lifted.to_originals <= tolerance_ || new_are_near(collapse);
}

void TwoSidedBound::apply(const Collapse& collapse) {
  for (const Index t : collapse.gone) lists_[t].clear();
  for (std::size_t i = 0; i < collapse.faces.size(); ++i) {
    lists_[collapse.faces[i]].clear();
    bounds_[collapse.faces[i]] = next_[i];
    triangles_[collapse.faces[i]] = after_[i];
  }
  for (const Use& use : uses_) {
    std::vector<Index>& list = lists_[use.triangle];
    double& distance = bounds_[use.triangle].from_originals;
    distance = std::max(distance, use.distance);
    if (std::find(list.begin(), list.end(), use.original) == list.end()) {
      list.push_back(use.original);
    }
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

/// The originals that triangles stand for which change or go.
void TwoSidedBound::gather(const Collapse& collapse) {
  ++collapse_count_;
  affected_.clear();
  const auto add = [this](Index t, std::size_t guess) {
    for (const Index o : lists_[t]) {
      if (seen_[o] == collapse_count_) continue;
      seen_[o] = collapse_count_;
      affected_.push_back({o, guess, 0});
    }
  };
  for (std::size_t i = 0; i < collapse.faces.size(); ++i) add(collapse.faces[i], i);
  for (const Index t : collapse.gone) add(t, 0);
}

TwoSidedBound::Bounds TwoSidedBound::bounds_before(const Collapse& collapse) const {
  Bounds greatest;
  const auto see = [&](Index t) {
    greatest.to_originals = std::max(greatest.to_originals, bounds_[t].to_originals);
    greatest.from_originals = std::max(greatest.from_originals, bounds_[t].from_originals);
  };
  for (const Index t : collapse.faces) see(t);
  for (const Index t : collapse.gone) see(t);
  return greatest;
}

/// Each triangle that comes stands for the originals that it may be near.
void TwoSidedBound::lift(const Bounds& bounds, const Collapse& collapse) {
  next_.assign(collapse.faces.size(), bounds);
  for (std::size_t i = 0; i < collapse.faces.size(); ++i) {
    Box reach = after_[i].box();
    for (int axis = 0; axis < 3; ++axis) {
      reach.lo[axis] -= bounds.from_originals;
      reach.hi[axis] += bounds.from_originals;
    }
    for (const Affected& a : affected_) {
      const TrianglePlanes& original = originals_[a.original];
      if (overlap(reach, original.box()) &&
          !after_[i].is_beyond(original.corners(), bounds.from_originals)) {
        uses_.push_back({a.original, collapse.faces[i], bounds.from_originals});
      }
    }
  }
}

/// The triangles after a collapse, and those at the ends of what changes.
void TwoSidedBound::look_around(const EditableSurface& surface, const Collapse& collapse) {
  around_.clear();
  for (const TrianglePlanes& t : after_) around_.push_back(&t);
  around_number_ = collapse.faces;
  const auto see = [&](Index p) {
    surface.for_each_leaving(p, [&](Index h) {
      const Index t = h / 3;
      if (t == collapse.gone[0] || t == collapse.gone[1]) return;
      if (std::find(around_number_.begin(), around_number_.end(), t) != around_number_.end()) {
        return;
      }
      around_number_.push_back(t);
      around_.push_back(&triangles_[t]);
    });
  };
  for (const Index h : collapse.outer) see(surface.from(h));
  see(surface.to(collapse.outer.back()));
  if (!collapse.moves) see(collapse.kept);
}

/// Whether the centres of the originals are near; what is farthest comes first from now on, and most
/// refusals are found there.
bool TwoSidedBound::centers_are_near() {
  const double most = tolerance_ * tolerance_;
  for (Affected& a : affected_) {
    const Corners& t = originals_[a.original].corners();
    const Vec3 center = (1.0 / 3) * (t[0] + t[1] + t[2]);
    a.distance = around_[a.guess]->squared_distance_up_to(most, center);
    for (std::size_t n = 0; a.distance > most && n < around_.size(); ++n) {
      const double distance =
          around_[n]->squared_distance_up_to(std::min(most, a.distance), center);
      if (distance >= a.distance) continue;
      a.distance = distance;
      a.guess = n;
    }
    if (a.distance > most) return false;
  }
  std::sort(affected_.begin(), affected_.end(), [](const Affected& a, const Affected& b) {
    return std::pair{-a.distance, a.original} < std::pair{-b.distance, b.original};
  });
  return true;
}

bool TwoSidedBound::old_are_near() {
  if (!centers_are_near()) return false;
  for (const auto& [o, guess, squared] : affected_) {
    const double distance = covering_.bound(originals_[o].corners(), around_, guess);
    if (!std::isfinite(distance)) return false;
    for (const Index used : covering_.used()) uses_.push_back({o, around_number_[used], distance});
  }
  return true;
}

bool TwoSidedBound::new_are_near(const Collapse& collapse) {
  for (std::size_t i = 0; i < collapse.faces.size(); ++i) {
    near_.clear();
    for (const Use& use : uses_) {
      if (use.triangle == collapse.faces[i]) near_.push_back(&originals_[use.original]);
    }
    double distance = covering_.bound(collapse.after[i], near_, near_.size());
    if (!std::isfinite(distance)) {
      near_.clear();
      for (const Affected& a : affected_) near_.push_back(&originals_[a.original]);
      distance = covering_.bound(collapse.after[i], near_, near_.size());
    }
    if (!std::isfinite(distance)) return false;
    next_[i].to_originals = distance;
  }
  return true;
}

}  // namespace mesamis::detail::decimate
