// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/cell_quadrature.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mesamis/mesh/tet_mesh.h"

namespace mesamis::detail::fem {
namespace {

using Vec4 = std::array<double, 4>;

constexpr int kFinestLattice = 2;  // points per voxel and direction
constexpr double kEnoughSamples = 40;
constexpr double kLeastPivot = 0.02;  // of the normal matrix, against evenly spread samples

/// What a row of samples adds up to: how many there are, the sum of their values I_k, and the sum
/// of k I_k.
struct RowSums {
  double count, sum, moment;
};

/// Normal equations of the fit: sums over samples of l l' and l I, l the barycentric coordinates.
class NormalEquations {
 public:
  /// Adds samples in a row, the k-th at l + k step, k from 0. Sums of k and k^2 are known.
  void add_row(const Vec4& l, const Vec4& step, const RowSums& row) {
    const auto [count, sum, moment] = row;
    const double ones = count, ks = count * (count - 1) / 2, squares = ks * (2 * count - 1) / 3;
    std::size_t e = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      right_[i] += l[i] * sum + step[i] * moment;
      for (std::size_t j = i; j < 4; ++j) {
        matrix_[e++] += ones * l[i] * l[j] + ks * (l[i] * step[j] + step[i] * l[j]) +
                        squares * step[i] * step[j];
      }
    }
    count_ += count;
  }
  double count() const { return count_; }

  /// Cholesky; false if the samples do not determine all four values well.
  bool solve(Vec4& x) const {
    std::array<Vec4, 4> a{};
    std::size_t e = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i; j < 4; ++j) a[j][i] = matrix_[e++];
    }
    const double even = count_ / 20;  // smallest eigenvalue when evenly spread
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < j; ++k) a[j][j] -= a[j][k] * a[j][k];
      if (a[j][j] < kLeastPivot * even) return false;
      a[j][j] = std::sqrt(a[j][j]);
      for (std::size_t i = j + 1; i < 4; ++i) {
        for (std::size_t k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
        a[i][j] /= a[j][j];
      }
    }
    x = right_;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < i; ++k) x[i] -= a[i][k] * x[k];
      x[i] /= a[i][i];
    }
    for (std::size_t i = 4; i-- > 0;) {
      for (std::size_t k = i + 1; k < 4; ++k) x[i] -= a[k][i] * x[k];
      x[i] /= a[i][i];
    }
    return true;
  }

 private:
  std::array<double, 10> matrix_{};
  Vec4 right_{};
  double count_ = 0;
};

/// std::ceil() calls a function on processors without SSE4.1.
Index ceiling(double x) {
  const auto whole = static_cast<Index>(x);
  return whole + (whole < x ? 1 : 0);
}

/// Walkington's rule of 14 points, exact for polynomials of degree 5 on a tetrahedron of volume 1: so
/// the fit is the L2 projection of a polynomial of degree 4.
class FixedSamples {
 public:
  FixedSamples() {
    for (const auto& [a, weight] : {std::pair{0.31088591926330060980, 0.11268792571801585080},
                                    std::pair{0.092735250310891226402, 0.073493043116361949544}}) {
      for (std::size_t i = 0; i < 4; ++i) {
        Vec4 l{a, a, a, a};
        l[i] = 1 - 3 * a;
        points_.push_back({l, weight});
      }
    }
    constexpr double kBeside = 0.045503704125649649492;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        Vec4 l{kBeside, kBeside, kBeside, kBeside};
        l[i] = l[j] = 0.5 - kBeside;
        points_.push_back({l, 0.042546020777081466438});
      }
    }
  }

  /// @param value  of the image at barycentric coordinates.
  template <class Value>
  Vec4 fit(Value&& value) const {
    Vec4 right{};
    for (const auto& [l, weight] : points_) {
      const double v = weight * value(l);
      for (std::size_t i = 0; i < 4; ++i) right[i] += l[i] * v;
    }
    const double sum = right[0] + right[1] + right[2] + right[3];
    for (double& x : right) x = 20 * x - 4 * sum;  // the inverse of (1 + delta_ij) / 20
    return right;
  }

 private:
  std::vector<std::pair<Vec4, double>> points_;
};

/// A cell in voxel coordinates, with its barycentric coordinates as linear functions.
class CellInVoxels {
 public:
  CellInVoxels(const SplineImage& image, const std::array<Vec3, 4>& points) : image_(image) {
    const Vec3& spacing = image.grid.spacing;
    for (std::size_t i = 0; i < 4; ++i) {
      p_[i] = {points[i].x / spacing.x, points[i].y / spacing.y, points[i].z / spacing.z};
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& [a, b, c] = kCellFaces[i];
      const Vec3 normal = cross(p_[c] - p_[a], p_[b] - p_[a]);
      const double height = dot(normal, p_[i] - p_[a]);
      slope_[i] = (1 / height) * normal;
      base_[i] = -dot(slope_[i], p_[a]);
    }
    volume_ = six_volume(p_[0], p_[1], p_[2], p_[3]) / 6;
    for (std::size_t i = 0; i < 4; ++i) {
      if (slope_[i].x == 0) continue;
      crossing_[i] = (-1 / slope_[i].x) * Vec3{base_[i], slope_[i].y, slope_[i].z};
    }
  }

  double volume() const { return volume_; }

  /// Samples at (m + 1/2) / density - 1/2 per direction, m whole: with density 1 the voxels.
  NormalEquations sample_lattice(int density) const {
    const Box box = bounding_box(p_);
    const auto first = [density](double x) { return ceiling((x + 0.5) * density - 0.5); };
    const auto last = [density](double x) { return -ceiling(-((x + 0.5) * density - 0.5)); };
    const auto coordinate = [step = 1.0 / density](Index m) { return (m + 0.5) * step - 0.5; };
    const Vec4 step = slopes_along_x(density);
    NormalEquations sums;
    for (Index mz = first(box.lo.z); mz <= last(box.hi.z); ++mz) {
      SplineLine line(image_, coordinate(mz));
      for (Index my = first(box.lo.y); my <= last(box.hi.y); ++my) {
        Vec3 q{0, coordinate(my), coordinate(mz)};
        double low = box.lo.x, high = box.hi.x;
        if (!clip_row(q, low, high)) continue;
        const Index begin = first(low), count = last(high) - begin + 1;
        if (count <= 0) continue;
        line.move_to(q.y);
        double sum = 0, moment = 0;
        for (Index k = 0; k < count; ++k) {
          const double value = line.at(coordinate(begin + k));
          sum += value;
          moment += k * value;
        }
        q.x = coordinate(begin);
        sums.add_row(barycentric(q), step, {static_cast<double>(count), sum, moment});
      }
    }
    return sums;
  }

  /// The fit to samples at fixed places.
  Vec4 fit_fixed() const {
    static const FixedSamples samples;
    SplinePatch patch(image_);
    return samples.fit([&](const Vec4& l) {
      return patch.at(l[0] * p_[0] + l[1] * p_[1] + l[2] * p_[2] + l[3] * p_[3]);
    });
  }

 private:
  /// Of the barycentric coordinates, from sample to sample.
  Vec4 slopes_along_x(int density) const {
    return {slope_[0].x / density, slope_[1].x / density, slope_[2].x / density,
            slope_[3].x / density};
  }

  Vec4 barycentric(const Vec3& q) const {
    Vec4 l;
    for (std::size_t i = 0; i < 4; ++i) l[i] = base_[i] + dot(slope_[i], q);
    return l;
  }

  /// The part of the row through q (along x) that lies in the cell.
  /// @return false if none does.
  bool clip_row(const Vec3& q, double& low, double& high) const {
    for (std::size_t i = 0; i < 4; ++i) {
      const double x = crossing_[i].x + crossing_[i].y * q.y + crossing_[i].z * q.z;
      if (slope_[i].x > 0) {
        low = std::max(low, x);
      } else if (slope_[i].x < 0) {
        high = std::min(high, x);
      } else if (base_[i] + slope_[i].y * q.y + slope_[i].z * q.z < 0) {
        return false;
      }
    }
    return low <= high;
  }

  const SplineImage& image_;
  std::array<Vec3, 4> p_, slope_;
  std::array<Vec3, 4> crossing_{};  // where a row meets face i: x = this . (1, y, z)
  Vec4 base_{};
  double volume_;
};

}  // namespace

std::array<double, 4> fit_image_on_cell(const SplineImage& image,
                                        const std::array<Vec3, 4>& points) {
  const CellInVoxels cell(image, points);
  Vec4 fit{};
  for (int density = 1; density <= kFinestLattice; ++density) {
    if (cell.volume() * density * density * density < kEnoughSamples) continue;
    const NormalEquations sums = cell.sample_lattice(density);
    if (sums.count() >= kEnoughSamples / 2 && sums.solve(fit)) return fit;
  }
  return cell.fit_fixed();
}

}  // namespace mesamis::detail::fem
