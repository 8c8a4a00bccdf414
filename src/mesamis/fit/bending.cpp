// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/bending.h"

#include <algorithm>
#include <utility>

#include "mesamis/base/parallel.h"

namespace mesamis::detail::fit {
namespace {

/// Voxels: shorter steps do not change a surface that anybody sees.
constexpr double kLeastStep = 1e-4;

/// The matrix of the energy, without rows of points that are held.
class Matrix {
 public:
  Matrix(const Umbrella& umbrella, const Springs& springs, double bending)
      : umbrella_(umbrella), springs_(springs), bending_(bending), bent_(umbrella.row_count()) {
    constexpr double kOwn = 1.2, kOfOthers = 0.2;  // with six neighbours
    inverse_diagonal_.resize(springs.weight.size());
    parallel_for(inverse_diagonal_.size(), [&](std::size_t p) {
      double bent = umbrella_.smooths(p) ? kOwn : kOfOthers;
      if (umbrella_.smooths_twice(p)) bent += 1;
      inverse_diagonal_[p] = 1 / (springs_.weight[p] + bent * bending_);
    });
  }

  /// @param y  becomes the product with x.
  /// @return the scalar product of x and y.
  double multiply(const std::vector<Vec3>& x, std::vector<Vec3>& y) {
    umbrella_.bend(x, bent_);
    return parallel_sum(x.size(), [&](std::size_t begin, std::size_t end) {
      double sum = 0;
      for (std::size_t p = begin; p < end; ++p) {
        y[p] = is_free(p) ? springs_.weight[p] * x[p] + bending_ * umbrella_.transposed(p, bent_)
                          : Vec3{};
        sum += dot(x[p], y[p]);
      }
      return sum;
    });
  }

  /// Divided by about the diagonal.
  Vec3 preconditioned(std::size_t p, const Vec3& r) const { return inverse_diagonal_[p] * r; }

  /// About the trace, of points that are free.
  double trace() const {
    return parallel_sum(inverse_diagonal_.size(), [&](std::size_t begin, std::size_t end) {
      double sum = 0;
      for (std::size_t p = begin; p < end; ++p) sum += is_free(p) ? 1 / inverse_diagonal_[p] : 0;
      return sum;
    });
  }

  bool is_free(std::size_t p) const { return springs_.held[p] == 0; }

 private:
  const Umbrella& umbrella_;
  const Springs& springs_;
  double bending_;
  std::vector<Vec3> bent_;  // L x, for the time of a product
  std::vector<double> inverse_diagonal_;
};

}  // namespace

Links links_along_curves(const Neighbors& neighbors, const std::vector<char>& on_curve) {
  Links links(neighbors.points.size());
  parallel_for(on_curve.size(), [&](std::size_t p) {
    for (std::size_t n = neighbors.start[p]; n < neighbors.start[p + 1]; ++n) {
      links[n] = on_curve[p] <= on_curve[neighbors.points[n]] ? 1 : 0;
    }
  });
  return links;
}

Umbrella::Umbrella(const Neighbors& neighbors, Links links)
    : neighbors_(neighbors),
      links_(std::move(links)),
      back_(links_.size()),
      share_(neighbors.start.size() - 1, 0),
      alike_(share_.size()),
      other_row_(share_.size(), kNoIndex) {
  std::vector<int> others(share_.size(), 0);
  parallel_for(alike_.size(), [&](std::size_t p) {
    int count = 0;
    bool alike = true;
    for (std::size_t n = neighbors_.start[p]; n < neighbors_.start[p + 1]; ++n) {
      const Index q = neighbors_.points[n];
      back_[n] = links_[neighbors_.place_of(static_cast<Index>(p), q)];
      count += (links_[n] & kLinked) != 0 ? 1 : 0;
      others[p] += (links_[n] & kLinkedOther) != 0 ? 1 : 0;
      alike &= links_[n] == kLinked && back_[n] == kLinked;
    }
    if (count > 1) share_[p] = 1.0 / count;
    alike_[p] = alike ? 1 : 0;
  });
  for (std::size_t p = 0; p < others.size(); ++p) {
    if (others[p] < 2) continue;
    other_row_[p] = static_cast<Index>(share_.size());
    two_ways_.push_back(static_cast<Index>(p));
    share_.push_back(1.0 / others[p]);
  }
}

std::vector<Vec3> Umbrella::bent(const std::vector<Vec3>& x) const {
  std::vector<Vec3> y(row_count());
  bend(x, y);
  return y;
}

Vec3 Umbrella::row(const std::vector<Vec3>& x, std::size_t p, std::size_t row, char bit) const {
  Vec3 sum;
  const bool alike = alike_[p] != 0;
  for (std::size_t n = neighbors_.start[p]; n < neighbors_.start[p + 1]; ++n) {
    const Index q = neighbors_.points[n];
    if (alike || (links_[n] & bit) != 0) sum += x[q];
  }
  return x[p] - share_[row] * sum;
}

void Umbrella::bend(const std::vector<Vec3>& x, std::vector<Vec3>& y) const {
  parallel_for(x.size(),
               [&](std::size_t p) { y[p] = smooths(p) ? row(x, p, p, kLinked) : Vec3{}; });
  parallel_for(two_ways_.size(), [&](std::size_t i) {
    const std::size_t other = x.size() + i;
    y[other] = row(x, static_cast<std::size_t>(two_ways_[i]), other, kLinkedOther);
  });
}

Vec3 Umbrella::transposed(std::size_t p, const std::vector<Vec3>& y) const {
  Vec3 x = y[p];
  if (other_row_[p] != kNoIndex) x += y[other_row_[p]];
  const bool alike = alike_[p] != 0;
  for (std::size_t n = neighbors_.start[p]; n < neighbors_.start[p + 1]; ++n) {
    const Index q = neighbors_.points[n];
    if (alike || (back_[n] & kLinked) != 0) x = x - share_[q] * y[q];
    if (!alike && (back_[n] & kLinkedOther) != 0 && other_row_[q] != kNoIndex) {
      x = x - share_[other_row_[q]] * y[other_row_[q]];
    }
  }
  return x;
}

Springs springs_at(const SurfaceSpace& space, const std::vector<Vec3>& points, double weight) {
  Springs springs{std::vector<double>(points.size(), weight), points,
                  std::vector<char>(points.size())};
  springs.least_step = kLeastStep * space.voxel();
  parallel_for(points.size(),
               [&](std::size_t p) { springs.held[p] = space.on_box(points[p]) ? 1 : 0; });
  return springs;
}

std::vector<Vec3> relax(const Umbrella& umbrella, const Springs& springs, double bending,
                        std::vector<Vec3> x) {
  constexpr int kMostSteps = 120;
  Matrix matrix(umbrella, springs, bending);
  std::vector<Vec3> residual(x.size()), steep(x.size()), image(x.size());
  matrix.multiply(x, residual);
  parallel_for(x.size(), [&](std::size_t p) {
    if (matrix.is_free(p)) residual[p] = springs.weight[p] * springs.goal[p] - residual[p];
  });
  const auto precondition = [&](std::size_t p) {
    steep[p] = matrix.preconditioned(p, residual[p]);
    return dot(residual[p], steep[p]);
  };
  double size = parallel_sum(x.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t p = begin; p < end; ++p) sum += precondition(p);
    return sum;
  });
  std::vector<Vec3> direction = steep;
  const double enough = std::max(springs.accuracy * springs.accuracy * size,
                                 springs.least_step * springs.least_step * matrix.trace());
  for (int step = 0; step < kMostSteps && size > enough; ++step) {
    const double length = size / matrix.multiply(direction, image);
    const double next = parallel_sum(x.size(), [&](std::size_t begin, std::size_t end) {
      double sum = 0;
      for (std::size_t p = begin; p < end; ++p) {
        x[p] += length * direction[p];
        residual[p] = residual[p] - length * image[p];
        sum += precondition(p);
      }
      return sum;
    });
    parallel_for(x.size(),
                 [&](std::size_t p) { direction[p] = steep[p] + (next / size) * direction[p]; });
    size = next;
  }
  return x;
}

}  // namespace mesamis::detail::fit
