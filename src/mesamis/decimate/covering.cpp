// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/covering.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/surface/box_tree.h"

namespace mesamis::detail::decimate {
namespace {

/// So often a piece is halved; more help hardly ever.
constexpr int kMostHalvings = 6;
/// Pieces of a triangle that are looked at.
constexpr int kMostPieces = 500;

}  // namespace

double Covering::bound(const Corners& triangle, std::span<const TrianglePlanes* const> others) {
  used_.clear();
  found_ = 0;
  pieces_ = 0;
  Piece whole;
  for (const Vec3& p : triangle) whole.add(p);
  near_.clear();
  for (std::size_t n = 0; n < others.size(); ++n) {
    near_.push_back({others[n], static_cast<Index>(n)});
  }
  return is_covered(whole, 0, kMostHalvings) ? std::sqrt(found_)
                                             : std::numeric_limits<double>::infinity();
}

bool Covering::is_near(const Piece& piece, const TrianglePlanes& other) {
  double farthest = 0;
  for (int i = 0; i < piece.count(); ++i) {
    farthest = std::max(farthest, other.squared_distance_up_to(most_, piece.at(i)));
    if (farthest > most_) return false;
  }
  found_ = std::max(found_, farthest);
  return true;
}

/// @param begin  of the candidates, in the stack.
bool Covering::is_covered(const Piece& piece, std::size_t begin, int halvings) {
  if (++pieces_ > kMostPieces) return false;
  const std::size_t end = near_.size();
  Box box{piece.at(0), piece.at(0)};
  for (int i = 0; i < piece.count(); ++i) {
    const Vec3 p = piece.at(i);
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], p[axis] - tolerance_);
      box.hi[axis] = std::max(box.hi[axis], p[axis] + tolerance_);
    }
  }
  for (std::size_t n = begin; n < end; ++n) {
    if (overlap(near_[n].triangle->box(), box)) near_.push_back(near_[n]);
  }
  const bool covered = is_covered_by(piece, end, near_.size(), halvings);
  near_.resize(end);
  return covered;
}

bool Covering::is_covered_by(const Piece& piece, std::size_t begin, std::size_t end, int halvings) {
  Vec3 center{0, 0, 0};
  for (int i = 0; i < piece.count(); ++i) center += piece.at(i);
  center = (1.0 / piece.count()) * center;
  std::size_t nearest = end;
  double least = most_;
  for (std::size_t n = begin; n < end; ++n) {
    const double d = near_[n].triangle->squared_distance_up_to(least, center);
    if (d > least || (d == least && nearest < end)) continue;
    least = d;
    nearest = n;
  }
  if (nearest == end) return false;
  const TrianglePlanes& other = *near_[nearest].triangle;
  if (is_near(piece, other)) {
    used_.push_back(near_[nearest].number);
    return true;
  }
  if (!(other.beyond(center) < 0))
    return halvings > 0 && halves_are_covered(piece, begin, halvings - 1);
  Piece above = piece;
  for (std::size_t i = 0; i < 3; ++i) {
    const Piece beside = cut_off(above, other.corners()[i], other.outward(i));
    if (above.count() > kMostCorners || beside.count() > kMostCorners) return false;
    if (beside.count() >= 3 && !is_covered(beside, begin, halvings)) return false;
  }
  if (above.count() < 3) return true;
  if (!is_near(above, other)) return false;
  used_.push_back(near_[nearest].number);
  return true;
}

/// Takes the part where n . (x - p) > 0 off the piece and returns it.
Covering::Piece Covering::cut_off(Piece& piece, const Vec3& p, const Vec3& n) {
  std::array<double, kMostCorners> side;
  bool any = false;
  for (int i = 0; i < piece.count(); ++i) {
    side[static_cast<std::size_t>(i)] = dot(n, piece.at(i) - p);
    any |= side[static_cast<std::size_t>(i)] > 0;
  }
  Piece outside;
  if (!any) return outside;
  Piece inside;
  for (int i = 0; i < piece.count(); ++i) {
    const int j = (i + 1) % piece.count();
    const double here = side[static_cast<std::size_t>(i)],
                 there = side[static_cast<std::size_t>(j)];
    (here <= 0 ? inside : outside).add(piece.at(i));
    if ((here < 0 && there > 0) || (here > 0 && there < 0)) {
      const Vec3 x = piece.at(i) + (here / (here - there)) * (piece.at(j) - piece.at(i));
      inside.add(x);
      outside.add(x);
    } else if (here == 0) {
      outside.add(piece.at(i));
    }
  }
  piece = inside;
  return outside;
}

bool Covering::halves_are_covered(const Piece& piece, std::size_t begin, int halvings) {
  int a = 0, b = 0;
  double longest = 0;
  for (int i = 0; i < piece.count(); ++i) {
    for (int j = 0; j < i; ++j) {
      const Vec3 way = piece.at(i) - piece.at(j);
      if (dot(way, way) <= longest) continue;
      longest = dot(way, way);
      a = i;
      b = j;
    }
  }
  Piece half = piece;
  const Piece other = cut_off(half, 0.5 * (piece.at(a) + piece.at(b)), piece.at(b) - piece.at(a));
  if (half.count() > kMostCorners || other.count() > kMostCorners) return false;
  return (half.count() < 3 || is_covered(half, begin, halvings)) &&
         (other.count() < 3 || is_covered(other, begin, halvings));
}

}  // namespace mesamis::detail::decimate
