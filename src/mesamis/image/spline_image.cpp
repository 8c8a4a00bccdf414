// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/spline_image.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/image/grey_values.h"

namespace mesamis::detail::image {
namespace {

/// Rows of samples one after the other along an axis; each sample of a row belongs to a line of its
/// own.
struct Rows {
  float* first;
  std::size_t stride, width;
  Index count;

  float* row(Index k) const { return first + static_cast<std::size_t>(k) * stride; }
};

/// Solves c[k - 1] + 4 c[k] + c[k + 1] = 6 s[k] along the axis, with c = s at both ends (the second
/// derivative is zero there, so that linear images are reproduced), in place. The rows are
/// eliminated downwards, then solved upwards.
void solve_along(const Rows& rows) {
  const auto last = static_cast<std::size_t>(rows.count) - 1;
  std::vector<float> pivot(last + 1, 0);
  for (std::size_t k = 1; k < last; ++k) {
    pivot[k] = 1 / (4 - pivot[k - 1]);
    float* row = rows.row(static_cast<Index>(k));
    const float* before = rows.row(static_cast<Index>(k) - 1);
    for (std::size_t x = 0; x < rows.width; ++x) row[x] = (6 * row[x] - before[x]) * pivot[k];
  }
  for (std::size_t k = last; k-- > 1;) {
    float* row = rows.row(static_cast<Index>(k));
    const float* next = rows.row(static_cast<Index>(k) + 1);
    for (std::size_t x = 0; x < rows.width; ++x) row[x] -= pivot[k] * next[x];
  }
}

constexpr std::size_t kLines = 16;

/// The same for `lines` lines of contiguous samples, side by side: their samples do not wait for
/// each other, as those of one line do.
void solve_lines(float* first, std::size_t length, std::size_t lines) {
  std::vector<float> turned(length * lines);
  for (std::size_t n = 0; n < lines; ++n) {
    for (std::size_t i = 0; i < length; ++i) turned[i * lines + n] = first[n * length + i];
  }
  solve_along({turned.data(), lines, lines, static_cast<Index>(length)});
  for (std::size_t n = 0; n < lines; ++n) {
    for (std::size_t i = 0; i < length; ++i) first[n * length + i] = turned[i * lines + n];
  }
}

/// The cubic B-spline's weights for the four coefficients around a fraction of a voxel.
std::array<double, 4> spline_weights(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, 2.0 / 3 - t * t * (2 - t) / 2, 2.0 / 3 - s * s * (2 - s) / 2,
          t * t * t / 6};
}

/// Their derivatives, per voxel.
std::array<double, 4> spline_slopes(double t) {
  const double s = 1 - t;
  return {-s * s / 2, t * (1.5 * t - 2), s * (2 - 1.5 * s), t * t / 2};
}

/// Where a coordinate falls: the voxel below it and the rest.
struct Place {
  Place(double x, Index size) {
    const double inside = x > 0 ? std::min<double>(x, size - 1) : 0;  // NaN goes to 0
    cell = std::min(static_cast<Index>(inside), size - 2);
    fraction = inside - cell;
  }
  /// The n-th of the four coefficients; the ends stand in for those beyond them.
  Index tap(std::size_t n, Index size) const {
    return std::clamp(cell - 1 + static_cast<Index>(n), 0, size - 1);
  }
  Index cell;
  double fraction;
};

/// Beyond the ends, c[-1] = 2 c[0] - c[1]: the weights that this puts on the coefficients there
/// are.
std::array<double, 4> folded(std::array<double, 4> w, const Place& place, Index size) {
  const double below = place.cell == 0 ? w[0] : 0, above = place.cell == size - 2 ? w[3] : 0;
  return {w[0] + below, w[1] - above, w[2] - below, w[3] + above};
}

/// What the coefficients around a point are weighted with along an axis.
struct Taps {
  std::array<double, 4> weights, slopes;  // slopes only if asked for
  std::array<std::size_t, 4> offset;      // of each coefficient
};

template <bool kGradient>
Taps taps_at(double x, Index size, std::size_t step) {
  const Place place(x, size);
  Taps taps;
  taps.weights = folded(spline_weights(place.fraction), place, size);
  if constexpr (kGradient) taps.slopes = folded(spline_slopes(place.fraction), place, size);
  for (std::size_t n = 0; n < 4; ++n) {
    taps.offset[n] = static_cast<std::size_t>(place.tap(n, size)) * step;
  }
  return taps;
}

/// The spline at a point and, if it is asked for, its gradient, else zero.
template <bool kGradient>
ImageValue spline_sum(const SplineImage& image, const Vec3& p) {
  const VoxelGrid& grid = image.grid;
  const auto nx = static_cast<std::size_t>(grid.size[0]);
  const Vec3& s = grid.spacing;
  const Taps x = taps_at<kGradient>(p.x / s.x, grid.size[0], 1);
  const Taps y = taps_at<kGradient>(p.y / s.y, grid.size[1], nx);
  const Taps z =
      taps_at<kGradient>(p.z / s.z, grid.size[2], nx * static_cast<std::size_t>(grid.size[1]));
  ImageValue sum;
  for (std::size_t k = 0; k < 4; ++k) {
    std::array<double, 4> value{}, slope{};  // of the rows, side by side
    for (std::size_t i = 0; i < 4; ++i) {
      const float* at = image.coefficients.data() + z.offset[k] + x.offset[i];
      for (std::size_t j = 0; j < 4; ++j) {
        const double coefficient = at[y.offset[j]];
        value[j] += x.weights[i] * coefficient;
        if constexpr (kGradient) slope[j] += x.slopes[i] * coefficient;
      }
    }
    for (std::size_t j = 0; j < 4; ++j) {
      sum.value += y.weights[j] * z.weights[k] * value[j];
      if constexpr (kGradient) {
        sum.gradient.x += y.weights[j] * z.weights[k] * slope[j];
        sum.gradient.y += y.slopes[j] * z.weights[k] * value[j];
        sum.gradient.z += y.weights[j] * z.slopes[k] * value[j];
      }
    }
  }
  for (int a = 0; a < 3; ++a) sum.gradient[a] /= grid.spacing[a];
  return sum;
}

}  // namespace

SplineImage interpolating_spline(Volume volume) {
  const auto held = std::make_shared<std::vector<float>>(std::move(volume.samples));
  std::vector<float>& c = *held;
  SplineImage image{.grid = volume, .coefficients = c, .owner = held};
  std::tie(image.low, image.high) = sample_range(c);
  const auto& size = image.grid.size;
  const auto nx = static_cast<std::size_t>(size[0]), ny = static_cast<std::size_t>(size[1]);
  parallel_for_each(static_cast<std::size_t>(size[2]), [&](std::size_t k) {
    float* slice = c.data() + k * nx * ny;
    for (std::size_t j = 0; j < ny; j += kLines) {
      solve_lines(slice + j * nx, nx, std::min(kLines, ny - j));
    }
    solve_along({slice, nx, nx, size[1]});
  });
  parallel_for_each(ny, [&](std::size_t j) {
    solve_along({c.data() + j * nx, nx * ny, nx, size[2]});
  });
  return image;
}

ImageValue spline_at(const SplineImage& image, const Vec3& p) { return spline_sum<true>(image, p); }

double spline_value_at(const SplineImage& image, const Vec3& p) {
  return spline_sum<false>(image, p).value;
}

SplineLine::SplineLine(const SplineImage& image, double z) : image_(image) {
  const auto& size = image.grid.size;
  const Place place(z, size[2]);
  slice_weights_ = folded(spline_weights(place.fraction), place, size[2]);
  for (std::size_t k = 0; k < 4; ++k) {
    slices_[k] = image.coefficients.data() + image.grid.offset(0, 0, place.tap(k, size[2]));
  }
}

SplineLine::SplineLine(const SplineImage& image, double y, double z) : SplineLine(image, z) {
  move_to(y);
}

void SplineLine::move_to(double y) {
  const VoxelGrid& grid = image_.grid;
  const Place place(y, grid.size[1]);
  const auto wy = folded(spline_weights(place.fraction), place, grid.size[1]);
  std::array<std::size_t, 4> offsets;
  for (std::size_t j = 0; j < 4; ++j) offsets[j] = grid.offset(0, place.tap(j, grid.size[1]), 0);
  rows_ = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t j = 0; j < 4; ++j) {
      const double weight = wy[j] * slice_weights_[k];
      row_[rows_] = slices_[k] + offsets[j];
      weight_[rows_] = weight;
      rows_ += weight != 0 ? 1 : 0;  // on lines through voxels seven of them are 0
    }
  }
  known_ = 0;
}

void SplineLine::find_columns(Index first, double* columns) const {
  const Index last = image_.grid.size[0] - 1;
  std::array<double, 4> sums{};
  if (first >= 0 && first + 3 <= last) {
    for (std::size_t n = 0; n < rows_; ++n) {
      const float* row = row_[n] + first;
      for (std::size_t i = 0; i < 4; ++i) sums[i] += weight_[n] * row[i];
    }
  } else {
    for (std::size_t i = 0; i < 4; ++i) {
      const Index at = std::clamp(first + static_cast<Index>(i), 0, last);
      for (std::size_t n = 0; n < rows_; ++n) sums[i] += weight_[n] * row_[n][at];
    }
  }
  std::copy(sums.begin(), sums.end(), columns);
}

double SplineLine::at(double x) {
  const Place place(x, image_.grid.size[0]);
  const Index before = place.cell - 1;
  if (before < first_ || before >= first_ + known_) {
    first_ = before;
    known_ = 0;
  }
  while (before + 4 > first_ + known_) {
    if (known_ == 8) {
      std::copy(columns_.begin() + 4, columns_.end(), columns_.begin());
      first_ += 4;
      known_ = 4;
    }
    find_columns(first_ + known_, columns_.data() + known_);
    known_ += 4;
  }
  const auto w = folded(spline_weights(place.fraction), place, image_.grid.size[0]);
  const double* c = columns_.data() + (before - first_);
  const double value = w[0] * c[0] + w[1] * c[1] + w[2] * c[2] + w[3] * c[3];
  return std::clamp<double>(value, image_.low, image_.high);
}

double SplinePatch::at(const Vec3& p) {
  const auto& size = image_.grid.size;
  const std::array<Place, 3> place{Place(p.x, size[0]), Place(p.y, size[1]), Place(p.z, size[2])};
  const std::array<Index, 3> cell{place[0].cell, place[1].cell, place[2].cell};
  if (cell != cell_) move_to(cell);
  std::array<std::array<double, 4>, 3> w;
  for (std::size_t a = 0; a < 3; ++a) {
    w[a] = folded(spline_weights(place[a].fraction), place[a], size[a]);
  }
  std::array<double, 16> weight;
  for (std::size_t n = 0; n < 16; ++n) weight[n] = w[1][n % 4] * w[2][n / 4];
  std::array<double, 4> sums{};
  for (std::size_t n = 0; n < 16; ++n) {
    for (std::size_t i = 0; i < 4; ++i) sums[i] += weight[n] * coefficients_[4 * n + i];
  }
  const double value =
      w[0][0] * sums[0] + w[0][1] * sums[1] + w[0][2] * sums[2] + w[0][3] * sums[3];
  return std::clamp<double>(value, image_.low, image_.high);
}

void SplinePatch::move_to(const std::array<Index, 3>& cell) {
  cell_ = cell;
  const VoxelGrid& grid = image_.grid;
  const auto tap = [&](std::size_t axis, Index n) {
    return std::clamp(cell[axis] - 1 + n, 0, grid.size[axis] - 1);
  };
  double* to = coefficients_.data();
  for (Index k = 0; k < 4; ++k) {
    for (Index j = 0; j < 4; ++j) {
      const float* row = image_.coefficients.data() + grid.offset(0, tap(1, j), tap(2, k));
      for (Index i = 0; i < 4; ++i) *to++ = row[tap(0, i)];
    }
  }
}

}  // namespace mesamis::detail::image
