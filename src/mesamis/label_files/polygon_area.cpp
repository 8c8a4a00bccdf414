// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/polygon_area.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mesamis::detail::label_files {
namespace {

/// Sums of signed areas. Each edge adds, in the rows that it crosses, the area between it and the
/// right end of the window; each row holds the differences from pixel to pixel, so that an edge
/// changes only the pixels that it crosses. The sum over all edges is the area times the winding
/// number. All coordinates are those of the window: pixel (0, 0) is the square from (0, 0) to
/// (1, 1).
class SignedArea {
 public:
  explicit SignedArea(const PixelWindow& window)
      : columns_(static_cast<std::size_t>(window.columns)),
        rows_(static_cast<std::size_t>(window.rows)),
        sums_((columns_ + 2) * rows_) {}

  /// Splits the edge where it crosses the left and the right end: left of the window it counts as
  /// if it lay on its end, right of it nothing is left to count.
  void add(PlanePoint p, PlanePoint q) {
    const double right = static_cast<double>(columns_);
    for (const double end : {0.0, right}) {
      if ((p.x < end) == (q.x < end) || p.x == end || q.x == end) continue;
      const PlanePoint middle{end, p.y + (end - p.x) / (q.x - p.x) * (q.y - p.y)};
      add(p, middle);
      add(middle, q);
      return;
    }
    p.x = std::clamp(p.x, 0.0, right);
    q.x = std::clamp(q.x, 0.0, right);
    add_clipped(p, q);
  }

  std::vector<float> shares() const {
    std::vector<float> out;
    out.reserve(columns_ * rows_);
    for (std::size_t row = 0; row < rows_; ++row) {
      double sum = 0;
      for (std::size_t column = 0; column < columns_; ++column) {
        sum += sums_[row * (columns_ + 2) + column];
        out.push_back(static_cast<float>(std::min(std::abs(sum), 1.0)));
      }
    }
    return out;
  }

 private:
  void add_clipped(PlanePoint p, PlanePoint q) {
    if (p.y == q.y) return;
    const double sign = p.y < q.y ? 1 : -1;
    if (sign < 0) std::swap(p, q);
    const double slope = (q.x - p.x) / (q.y - p.y);
    const double begin = std::max(p.y, 0.0), end = std::min(q.y, static_cast<double>(rows_));
    for (double y = begin; y < end;) {
      const double row = std::floor(y), next = std::min(row + 1, end);
      const auto at = [&](double height) {
        return std::clamp(p.x + slope * (height - p.y), std::min(p.x, q.x), std::max(p.x, q.x));
      };
      add_in_row(static_cast<std::size_t>(row), std::minmax(at(y), at(next)), sign * (next - y));
      y = next;
    }
  }

  /// An edge within one row, from left to right; `height` has its sign.
  void add_in_row(std::size_t row, std::pair<double, double> x, double height) {
    const auto [left, right] = x;
    double* sums = &sums_[row * (columns_ + 2)];
    const auto first = static_cast<std::size_t>(left);
    const auto last = std::max(static_cast<std::size_t>(std::ceil(right)), first + 1) - 1;
    double before = 0;  // of the area right of the edge, what the pixels so far have
    for (std::size_t column = first; column <= last; ++column) {
      const double from = std::max(left, static_cast<double>(column));
      const double to = std::min(right, static_cast<double>(column + 1));
      const double share = right > left ? (to - from) / (right - left) : 1;
      // Of the part of the edge in this pixel, and all parts left of it.
      const double passed = column == first ? 0 : (from - left) / (right - left);
      const double area = passed + share * (static_cast<double>(column + 1) - (from + to) / 2);
      sums[column] += height * (area - before);
      before = area;
    }
    sums[last + 1] += height * (1 - before);
  }

  std::size_t columns_, rows_;
  std::vector<double> sums_;
};

}  // namespace

PixelWindow window_of(std::span<const PlanePoint> polygon, const PixelWindow& plane) {
  PlanePoint least = polygon.front(), most = polygon.front();
  for (const PlanePoint& p : polygon) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y)};
  }
  const auto first = [](double x, Index begin, Index count) {
    return static_cast<Index>(std::clamp(std::floor(x + 0.5), static_cast<double>(begin),
                                         static_cast<double>(begin) + count));
  };
  PixelWindow out;
  out.left = first(least.x, plane.left, plane.columns);
  out.top = first(least.y, plane.top, plane.rows);
  out.columns = first(most.x + 1, plane.left, plane.columns) - out.left;
  out.rows = first(most.y + 1, plane.top, plane.rows) - out.top;
  return out;
}

std::vector<float> pixel_shares(std::span<const PlanePoint> polygon, const PixelWindow& window) {
  if (window.pixels() == 0) return {};
  SignedArea area(window);
  const auto inside = [&](const PlanePoint& p) {
    return PlanePoint{p.x - window.left + 0.5, p.y - window.top + 0.5};
  };
  PlanePoint last = inside(polygon.back());
  for (const PlanePoint& point : polygon) {
    const PlanePoint next = inside(point);
    area.add(last, next);
    last = next;
  }
  return area.shares();
}

}  // namespace mesamis::detail::label_files
