// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/base/parallel.h"

namespace mesamis::detail::picture {
namespace {

constexpr int kSamples = 3;  // per pixel, each way
constexpr int kBandRows = 16;
constexpr int kNone = -1;

/// Twice the signed area between a side and a place. It is computed alike, but for its sign, for
/// both triangles of a side, so that each place belongs to one of them at least.
class Side {
 public:
  Side(const Vec3& from, const Vec3& to)
      : swapped_(to.x < from.x || (to.x == from.x && to.y < from.y)),
        start_(swapped_ ? to : from),
        along_((swapped_ ? from : to) - start_) {}
  double area(double x, double y) const {
    const double value = along_.x * (y - start_.y) - along_.y * (x - start_.x);
    return swapped_ ? -value : value;
  }
  double length() const { return std::sqrt(along_.x * along_.x + along_.y * along_.y); }

 private:
  bool swapped_;
  Vec3 start_, along_;
};

/// A triangle on the page and its sides, each opposite to the corner of its number.
class Outline {
 public:
  Outline(const PageTriangles& shown, std::size_t triangle)
      : corners_(corners_of(shown, triangle)),
        sides_{Side(corners_[1], corners_[2]), Side(corners_[2], corners_[0]),
               Side(corners_[0], corners_[1])},
        area_(sides_[0].area(corners_[0].x, corners_[0].y)) {}

  bool has_area() const { return std::abs(area_) > 0 && std::isfinite(area_); }
  const std::array<Vec3, 3>& corners() const { return corners_; }
  /// Barycentric coordinates of a place; it lies in the triangle if none is negative.
  std::array<double, 3> weights(double x, double y) const {
    return {sides_[0].area(x, y) / area_, sides_[1].area(x, y) / area_,
            sides_[2].area(x, y) / area_};
  }
  double side_distance(double x, double y) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Side& side : sides_) {
      least = std::min(least, std::abs(side.area(x, y)) / side.length());
    }
    return least;
  }
  double near(const std::array<double, 3>& w) const {
    return w[0] * corners_[0].z + w[1] * corners_[1].z + w[2] * corners_[2].z;
  }

 private:
  static std::array<Vec3, 3> corners_of(const PageTriangles& shown, std::size_t triangle) {
    const auto& t = shown.triangles[triangle];
    const auto at = [&](std::size_t n) { return shown.points[static_cast<std::size_t>(t[n])]; };
    return {at(0), at(1), at(2)};
  }

  std::array<Vec3, 3> corners_;
  std::array<Side, 3> sides_;
  double area_;
};

/// The first and the last of `count` steps of a unit whose middles lie between two places.
std::array<int, 2> steps_between(double lo, double hi, int count) {
  return {static_cast<int>(std::clamp(std::ceil(lo - 0.5), 0.0, double{1} * count)),
          static_cast<int>(std::clamp(std::floor(hi - 0.5), -1.0, count - 1.0))};
}

/// Rows of a picture, each pixel with its samples.
class Band {
 public:
  Band(int width, int first_row, int rows)
      : columns_(kSamples * width),
        first_(kSamples * first_row),
        rows_(kSamples * rows),
        near_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
              -std::numeric_limits<double>::infinity()),
        seen_(near_.size(), kNone) {}

  void add(const PageTriangles& shown, Index triangle) {
    const Outline outline(shown, static_cast<std::size_t>(triangle));
    if (!outline.has_area()) return;
    const auto& [a, b, c] = outline.corners();
    const auto [left, right] = steps_between(kSamples * std::min({a.x, b.x, c.x}),
                                             kSamples * std::max({a.x, b.x, c.x}), columns_);
    const auto [top, bottom] = steps_between(kSamples * std::min({a.y, b.y, c.y}) - first_,
                                             kSamples * std::max({a.y, b.y, c.y}) - first_, rows_);
    for (int row = top; row <= bottom; ++row) {
      for (int column = left; column <= right; ++column) {
        const auto w = outline.weights(x_of(column), y_of(row));
        if (!(w[0] >= 0 && w[1] >= 0 && w[2] >= 0)) continue;
        const double near = outline.near(w);
        const std::size_t at = index(row, column);
        if (!(near > near_[at])) continue;
        near_[at] = near;
        seen_[at] = triangle;
      }
    }
  }

  /// The mean of the samples of a pixel.
  /// @param pixel  its column, and its row in the band.
  Colour mean(const std::array<int, 2>& pixel, const PageTriangles& shown, const Shader& shader,
              const Colour& background) const {
    std::array<int, 3> sum{};
    for (int s = 0; s < kSamples * kSamples; ++s) {
      const int column = kSamples * pixel[0] + s % kSamples;
      const int row = kSamples * pixel[1] + s / kSamples;
      const Index triangle = seen_[index(row, column)];
      Colour colour = background;
      if (triangle != kNone) {
        const Outline outline(shown, static_cast<std::size_t>(triangle));
        const double px = x_of(column), py = y_of(row);
        colour = shader({static_cast<std::size_t>(triangle), outline.weights(px, py),
                         outline.side_distance(px, py)});
      }
      for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c];
    }
    constexpr int kCount = kSamples * kSamples;
    const auto mean_of = [](int total) {
      return static_cast<std::uint8_t>((total + kCount / 2) / kCount);
    };
    return {mean_of(sum[0]), mean_of(sum[1]), mean_of(sum[2])};
  }

 private:
  double x_of(int column) const { return (column + 0.5) / kSamples; }
  double y_of(int row) const { return (first_ + row + 0.5) / kSamples; }
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int columns_, first_, rows_;
  std::vector<double> near_;
  std::vector<Index> seen_;
};

/// Which triangles reach into each band, in their order.
std::vector<std::vector<Index>> in_bands(const PageTriangles& shown, int bands) {
  std::vector<std::vector<Index>> found(static_cast<std::size_t>(bands));
  for (std::size_t t = 0; t < shown.triangles.size(); ++t) {
    std::array<double, 2> reach{std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity()};
    for (const Index p : shown.triangles[t]) {
      const double y = shown.points[static_cast<std::size_t>(p)].y;
      reach = {std::min(reach[0], y), std::max(reach[1], y)};
    }
    const double first = std::clamp(std::floor(reach[0] / kBandRows), 0.0, double{1} * bands);
    const double last = std::clamp(std::floor(reach[1] / kBandRows), -1.0, bands - 1.0);
    for (int b = static_cast<int>(first); b <= static_cast<int>(last); ++b) {
      found[static_cast<std::size_t>(b)].push_back(static_cast<Index>(t));
    }
  }
  return found;
}

}  // namespace

void draw_triangles(Raster& on, const PageTriangles& shown, const Shader& shader) {
  const auto bands = in_bands(shown, (on.height + kBandRows - 1) / kBandRows);
  parallel_for_each(bands.size(), [&](std::size_t b) {
    if (bands[b].empty()) return;
    const int first = static_cast<int>(b) * kBandRows;
    const int rows = std::min(kBandRows, on.height - first);
    Band band(on.width, first, rows);
    for (const Index triangle : bands[b]) band.add(shown, triangle);
    for (int row = 0; row < rows; ++row) {
      for (int x = 0; x < on.width; ++x) {
        std::uint8_t* bytes = on.bytes.data() + on.offset(x, first + row);
        const Colour mean = band.mean({x, row}, shown, shader, {bytes[0], bytes[1], bytes[2]});
        std::copy(mean.begin(), mean.end(), bytes);
      }
    }
  });
}

}  // namespace mesamis::detail::picture
