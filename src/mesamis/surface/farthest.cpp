// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/farthest.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mesamis::detail::surface {
namespace {

/// Pieces smaller than this, relative to what is enough, are not cut again.
constexpr double kHalfSlack = 1.002;  // the rest is for the smallest pieces
constexpr double kSmallest = 5e-4;
constexpr double kThin = 0.01;  // relative to these

using Polygon = std::vector<Vec3>;  // convex and flat

Vec3 center_of(const Polygon& piece) {
  Vec3 sum{0, 0, 0};
  for (const Vec3& p : piece) sum += p;
  return (1 / static_cast<double>(piece.size())) * sum;
}

/// Takes the part where n . (x - p) > 0 off the piece and returns it, unless it reaches no farther
/// than `thin`: round-off would cut along the same line for ever.
Polygon cut_off(Polygon& piece, const Vec3& p, const Vec3& n, double thin) {
  std::vector<double> side;
  for (const Vec3& x : piece) side.push_back(dot(n, x - p));
  Polygon inside, outside;
  if (*std::max_element(side.begin(), side.end()) <= thin * norm(n)) return outside;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const std::size_t j = (i + 1) % piece.size();
    (side[i] <= 0 ? inside : outside).push_back(piece[i]);
    if ((side[i] < 0 && side[j] > 0) || (side[i] > 0 && side[j] < 0)) {
      const Vec3 x = piece[i] + (side[i] / (side[i] - side[j])) * (piece[j] - piece[i]);
      inside.push_back(x);
      outside.push_back(x);
    } else if (side[i] == 0) {
      outside.push_back(piece[i]);
    }
  }
  piece = std::move(inside);
  return outside;
}

class Search {
 public:
  Search(const TriangleTree& tree, const Enough& enough, std::size_t& hint)
      : tree_(tree), enough_(enough), smallest_(kSmallest * enough.below), hint_(hint) {}

  double run(const Corners& triangle) {
    if (is_near(triangle, tree_.triangle(hint_))) return upper_;
    pieces_.push_back({triangle[0], triangle[1], triangle[2]});
    while (!pieces_.empty() && lower_ <= enough_.above) {
      Polygon piece = std::move(pieces_.back());
      pieces_.pop_back();
      examine(std::move(piece));
    }
    return std::max(upper_, lower_);
  }

 private:
  void examine(Polygon piece) {
    // Most pieces are near enough to the triangle that the last one was near to: no search.
    if (is_near(piece, tree_.triangle(hint_))) return;
    see(center_of(piece));
    const Corners near = tree_.triangle(hint_);
    if (settles(piece, near)) return;
    Polygon above = keep_above(piece, near);
    if (above.empty()) {
      halve_or_accept(std::move(piece), near);
    } else if (above.size() >= 3 && !settles(above, near)) {
      halve_or_accept(std::move(above), near);
    }
  }

  /// A point of the triangle: its distance is a lower bound.
  void see(const Vec3& p) {
    lower_ = std::max(lower_, std::sqrt(tree_.squared_distance_to(p, hint_)));
  }

  template <class Points>
  bool is_near(const Points& piece, const Corners& near) {
    double greatest = 0;
    for (const Vec3& p : piece) {
      greatest = std::max(greatest, squared_distance(p, near));
      if (greatest > enough_.below * enough_.below) return false;
    }
    upper_ = std::max(upper_, std::sqrt(greatest));
    return true;
  }

  bool settles(const Polygon& piece, const Corners& near) {
    std::size_t worst = 0;
    const double upper = bound(piece, near, worst);
    if (upper > std::max(enough_.below, kHalfSlack * lower_)) return false;
    upper_ = std::max(upper_, upper);
    return true;
  }

  /// The greatest distance of a corner to one triangle; no point of the piece is farther from it.
  static double bound(const Polygon& piece, const Corners& near, std::size_t& worst) {
    double greatest = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const double d = squared_distance(piece[i], near);
      if (d <= greatest) continue;
      greatest = d;
      worst = i;
    }
    return std::sqrt(greatest);
  }

  /// The part of the piece in the prism over the triangle; what lies beside it waits. Empty if the
  /// piece's centre is not in the prism: cutting would leave most of it.
  Polygon keep_above(const Polygon& piece, const Corners& near) {
    const Vec3 normal = cross(near[1] - near[0], near[2] - near[0]), center = center_of(piece);
    std::array<Vec3, 3> out;
    for (std::size_t i = 0; i < 3; ++i) {
      out[i] = cross(near[(i + 1) % 3] - near[i], normal);
      if (dot(out[i], center - near[i]) >= 0) return {};
    }
    Polygon above = piece;
    for (std::size_t i = 0; i < 3 && above.size() >= 3; ++i) {
      Polygon beside = cut_off(above, near[i], out[i], kThin * smallest_);
      if (beside.size() >= 3) pieces_.push_back(std::move(beside));
    }
    return above;
  }

  void halve_or_accept(Polygon piece, const Corners& near) {
    std::size_t worst = 0, a = 0, b = 0;
    const double upper = bound(piece, near, worst);
    see(piece[worst]);
    if (widest(piece, a, b) <= smallest_ || settles(piece, near)) {
      upper_ = std::max(upper_, upper);
      return;
    }
    const Vec3 middle = 0.5 * (piece[a] + piece[b]);
    Polygon other = cut_off(piece, middle, piece[b] - piece[a], 0);
    if (piece.size() >= 3) pieces_.push_back(std::move(piece));
    if (other.size() >= 3) pieces_.push_back(std::move(other));
  }

  static double widest(const Polygon& piece, std::size_t& a, std::size_t& b) {
    double longest = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double d = norm(piece[i] - piece[j]);
        if (d <= longest) continue;
        longest = d;
        a = j;
        b = i;
      }
    }
    return longest;
  }

  const TriangleTree& tree_;
  Enough enough_;
  double lower_ = 0, upper_ = 0, smallest_;
  std::size_t& hint_;
  std::vector<Polygon> pieces_;
};

}  // namespace

double farthest_distance(const Corners& triangle, const TriangleTree& tree, const Enough& enough,
                         std::size_t& hint) {
  return Search(tree, enough, hint).run(triangle);
}

}  // namespace mesamis::detail::surface
