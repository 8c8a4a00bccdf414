// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/cell_quadrature.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/mesh/tet_mesh.h"

namespace mesamis {
namespace {

using Vec4 = std::array<double, 4>;

constexpr int kFinestLattice = 4;  // points per voxel and direction
constexpr double kEnoughSamples = 40;
constexpr double kLeastPivot = 0.02;  // of the normal matrix, against evenly spread samples

/// Normal equations of the fit: sums over samples of l l' and l I, l the barycentric coordinates.
class NormalEquations {
 public:
  void add(const Vec4& l, double value) {
    std::size_t e = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      right_[i] += l[i] * value;
      for (std::size_t j = i; j < 4; ++j) matrix_[e++] += l[i] * l[j];
    }
    ++count_;
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

/// A cell in voxel coordinates, with its barycentric coordinates as linear functions.
class CellInVoxels {
 public:
  CellInVoxels(const Volume& image, const std::array<Vec3, 4>& points) : image_(image) {
    for (std::size_t i = 0; i < 4; ++i) {
      p_[i] = {points[i].x / image.spacing.x, points[i].y / image.spacing.y,
               points[i].z / image.spacing.z};
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& [a, b, c] = kCellFaces[i];
      const Vec3 normal = cross(p_[c] - p_[a], p_[b] - p_[a]);
      const double height = dot(normal, p_[i] - p_[a]);
      slope_[i] = (1 / height) * normal;
      base_[i] = -dot(slope_[i], p_[a]);
    }
    volume_ = six_volume(p_[0], p_[1], p_[2], p_[3]) / 6;
  }

  double volume() const { return volume_; }

  /// Samples at (m + 1/2) / density - 1/2 per direction, m whole: with density 1 the voxels.
  NormalEquations sample_lattice(int density) const {
    const Box box = bounding_box(p_);
    auto first = [&](double x) { return std::ceil((x + 0.5) * density - 0.5); };
    auto last = [&](double x) { return std::floor((x + 0.5) * density - 0.5); };
    auto coordinate = [&](double m) { return (m + 0.5) / density - 0.5; };
    NormalEquations sums;
    for (double mz = first(box.lo.z); mz <= last(box.hi.z); ++mz) {
      for (double my = first(box.lo.y); my <= last(box.hi.y); ++my) {
        Vec3 q{0, coordinate(my), coordinate(mz)};
        double low = box.lo.x, high = box.hi.x;
        clip_row(q, low, high);
        for (double mx = first(low); mx <= last(high); ++mx) {
          q.x = coordinate(mx);
          sums.add(barycentric(q), value_at(q));
        }
      }
    }
    return sums;
  }

  /// Samples at l = (i + 1/2) / 6 for all whole i >= 0 that add up to 4: 35 points.
  NormalEquations sample_fixed() const {
    NormalEquations sums;
    for (int a = 0; a <= 4; ++a) {
      for (int b = 0; a + b <= 4; ++b) {
        for (int c = 0; a + b + c <= 4; ++c) {
          const Vec4 l{(a + 0.5) / 6, (b + 0.5) / 6, (c + 0.5) / 6, (4 - a - b - c + 0.5) / 6};
          Vec3 q;
          for (std::size_t i = 0; i < 4; ++i) q += l[i] * p_[i];
          sums.add(l, value_at(q));
        }
      }
    }
    return sums;
  }

 private:
  Vec4 barycentric(const Vec3& q) const {
    Vec4 l;
    for (std::size_t i = 0; i < 4; ++i) l[i] = base_[i] + dot(slope_[i], q);
    return l;
  }

  /// The part of the row through q (along x) that lies in the cell.
  void clip_row(const Vec3& q, double& low, double& high) const {
    for (std::size_t i = 0; i < 4; ++i) {
      const double at_zero = base_[i] + slope_[i].y * q.y + slope_[i].z * q.z;
      if (slope_[i].x > 0) {
        low = std::max(low, -at_zero / slope_[i].x);
      } else if (slope_[i].x < 0) {
        high = std::min(high, -at_zero / slope_[i].x);
      } else if (at_zero < 0) {
        high = -std::numeric_limits<double>::infinity();
      }
    }
  }

  double value_at(const Vec3& q) const {
    return interpolate(image_,
                       {q.x * image_.spacing.x, q.y * image_.spacing.y, q.z * image_.spacing.z});
  }

  const Volume& image_;
  std::array<Vec3, 4> p_, slope_;
  Vec4 base_{};
  double volume_;
};

}  // namespace

std::array<double, 4> fit_image_on_cell(const Volume& image, const std::array<Vec3, 4>& points) {
  const CellInVoxels cell(image, points);
  Vec4 fit{};
  for (int density = 1; density <= kFinestLattice; ++density) {
    if (cell.volume() * density * density * density < kEnoughSamples) continue;
    const NormalEquations sums = cell.sample_lattice(density);
    if (sums.count() >= kEnoughSamples / 2 && sums.solve(fit)) return fit;
  }
  cell.sample_fixed().solve(fit);
  return fit;
}

}  // namespace mesamis
