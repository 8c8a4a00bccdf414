// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/bending.h"

#include "mesamis/base/parallel.h"

namespace mesamis::detail::fit {
namespace {

double product(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return parallel_sum(a.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t p = begin; p < end; ++p) sum += dot(a[p], b[p]);
    return sum;
  });
}

/// The matrix of the energy, without rows of points that are held.
class Matrix {
 public:
  Matrix(const Umbrella& umbrella, const Springs& springs, double bending)
      : umbrella_(umbrella), springs_(springs), bending_(bending) {}

  std::vector<Vec3> operator*(const std::vector<Vec3>& x) const {
    std::vector<Vec3> y = umbrella_.transposed(umbrella_.bent(x));
    parallel_for(x.size(), [&](std::size_t p) {
      y[p] = is_free(p) ? springs_.weight[p] * x[p] + bending_ * y[p] : Vec3{};
    });
    return y;
  }

  /// Divided by about the diagonal.
  std::vector<Vec3> preconditioned(const std::vector<Vec3>& r) const {
    constexpr double kOwn = 1.2, kOfOthers = 0.2;  // with six neighbours
    std::vector<Vec3> z(r.size());
    parallel_for(r.size(), [&](std::size_t p) {
      const double bent = umbrella_.smooths(p) ? kOwn : kOfOthers;
      z[p] = (1 / (springs_.weight[p] + bent * bending_)) * r[p];
    });
    return z;
  }

  bool is_free(std::size_t p) const { return springs_.held[p] == 0; }

 private:
  const Umbrella& umbrella_;
  const Springs& springs_;
  double bending_;
};

}  // namespace

Umbrella::Umbrella(const Neighbors& neighbors, const std::vector<char>& on_curve)
    : neighbors_(neighbors), on_curve_(on_curve), degree_(on_curve.size()) {
  for (std::size_t p = 0; p < degree_.size(); ++p) {
    int count = 0;
    for (std::size_t n = neighbors_.start[p]; n < neighbors_.start[p + 1]; ++n) {
      count += on_curve_[p] <= on_curve_[neighbors_.points[n]] ? 1 : 0;
    }
    degree_[p] = count > 1 ? count : 0;
  }
}

std::vector<Vec3> Umbrella::bent(const std::vector<Vec3>& x) const {
  std::vector<Vec3> y(x.size());
  parallel_for(x.size(), [&](std::size_t p) {
    if (degree_[p] == 0) return;
    Vec3 sum;
    for (std::size_t n = neighbors_.start[p]; n < neighbors_.start[p + 1]; ++n) {
      const Index q = neighbors_.points[n];
      if (on_curve_[p] <= on_curve_[q]) sum += x[q];
    }
    y[p] = x[p] - (1.0 / degree_[p]) * sum;
  });
  return y;
}

std::vector<Vec3> Umbrella::transposed(const std::vector<Vec3>& y) const {
  std::vector<Vec3> x(y.size());
  parallel_for(y.size(), [&](std::size_t p) {
    x[p] = y[p];
    for (std::size_t n = neighbors_.start[p]; n < neighbors_.start[p + 1]; ++n) {
      const Index q = neighbors_.points[n];
      if (degree_[q] > 0 && on_curve_[q] <= on_curve_[p]) x[p] = x[p] - (1.0 / degree_[q]) * y[q];
    }
  });
  return x;
}

Springs springs_at(const SurfaceSpace& space, const std::vector<Vec3>& points, double weight) {
  Springs springs{std::vector<double>(points.size(), weight), points,
                  std::vector<char>(points.size())};
  parallel_for(points.size(),
               [&](std::size_t p) { springs.held[p] = space.on_box(points[p]) ? 1 : 0; });
  return springs;
}

std::vector<Vec3> relax(const Umbrella& umbrella, const Springs& springs, double bending,
                        std::vector<Vec3> x) {
  constexpr int kMostSteps = 120;
  constexpr double kAccuracy = 1e-4;
  const Matrix matrix(umbrella, springs, bending);
  std::vector<Vec3> residual = matrix * x;
  parallel_for(x.size(), [&](std::size_t p) {
    if (matrix.is_free(p)) residual[p] = springs.weight[p] * springs.goal[p] - residual[p];
  });
  std::vector<Vec3> steep = matrix.preconditioned(residual), direction = steep;
  double size = product(residual, steep);
  const double enough = kAccuracy * kAccuracy * size;
  for (int step = 0; step < kMostSteps && size > enough; ++step) {
    const std::vector<Vec3> image = matrix * direction;
    const double length = size / product(direction, image);
    parallel_for(x.size(), [&](std::size_t p) {
      x[p] += length * direction[p];
      residual[p] = residual[p] - length * image[p];
    });
    steep = matrix.preconditioned(residual);
    const double next = product(residual, steep);
    parallel_for(x.size(),
                 [&](std::size_t p) { direction[p] = steep[p] + (next / size) * direction[p]; });
    size = next;
  }
  return x;
}

}  // namespace mesamis::detail::fit
