// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/edge_profile.h"

#include <Eigen/Dense>
#include <cmath>

#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::restore {
namespace {

double normal_distribution(double t) { return 0.5 * std::erfc(-t / std::sqrt(2)); }

/// The parameters in which the model is not linear.
struct Shape {
  double sigma, thickness, shift;
};

/// A model and its cost: the mean square of the residual, and the penalty of its core.
struct Fit {
  EdgeModel edge;
  double cost = 0;
};

/// The best values for a shape, by linear least squares, without a core if it came out brighter
/// than the shell. The penalty removes shells that explain no more than noise or a bend.
Fit fit_values(const Profile& profile, const Shape& shape) {
  constexpr int kSamples = 2 * kProfileHalf + 1;
  constexpr double kPenalty = 3e-5;
  Eigen::Matrix<double, kSamples, 3> steps;
  for (int n = 0; n < kSamples; ++n) {
    const double t = (n - kProfileHalf) * kProfileStep - shape.shift;
    steps.row(n) << 1, normal_distribution(t / shape.sigma),
        normal_distribution((t - shape.thickness) / shape.sigma);
  }
  const Eigen::Map<const Eigen::Matrix<double, kSamples, 1>> values(profile.data());
  const auto solve = [&](int columns) {
    const auto used = steps.leftCols(columns);
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.head(columns) = (used.transpose() * used).ldlt().solve(used.transpose() * values);
    return x;
  };
  Eigen::Vector3d x = solve(3);
  if (x[2] > 0) x = solve(2);
  const double square = (steps * x - values).squaredNorm() / kSamples;
  return {{x[0], x[0] + x[1], x[0] + x[1] + x[2], shape.thickness, shape.sigma, shape.shift,
           std::sqrt(square)},
          square + kPenalty * std::abs(x[1] * x[2])};
}

/// The least cost between two bounds, by golden section.
template <class FitAt>
Fit least(double low, double high, FitAt&& fit_at) {
  constexpr double kGolden = 0.6180339887498949, kPrecision = 1e-3;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  Fit at_left = fit_at(left), at_right = fit_at(right);
  while (high - low > kPrecision) {
    if (at_left.cost < at_right.cost) {
      high = right, right = left, at_right = at_left;
      at_left = fit_at(left = high - kGolden * (high - low));
    } else {
      low = left, left = right, at_left = at_right;
      at_right = fit_at(right = low + kGolden * (high - low));
    }
  }
  return at_left.cost < at_right.cost ? at_left : at_right;
}

}  // namespace

PointGroup with_normals(const std::vector<SurfacePoint>& points) {
  PointGroup group;
  for (const SurfacePoint& point : points) {
    if (norm(point.normal) > 0) group.push_back(&point);
  }
  return group;
}

Vec3 voxel_step(const VoxelGrid& grid, const Vec3& n) {
  const Vec3& s = grid.spacing;
  return (1 / norm({n.x / s.x, n.y / s.y, n.z / s.z})) * n;
}

Profile median_profile(const VolumeView& volume, const PointGroup& points) {
  Profile profile;
  parallel_for_each(profile.size(), [&](std::size_t n) {
    const double offset = (static_cast<double>(n) - kProfileHalf) * kProfileStep;
    std::vector<double> values;
    values.reserve(points.size());
    for (const SurfacePoint* point : points) {
      const Vec3 step = voxel_step(volume, point->normal);
      values.push_back(interpolate(volume, point->position - offset * step));
    }
    profile[n] = median(values);
  });
  return profile;
}

double EdgeModel::level() const {
  return (background + shell) / 2 + (core - shell) * normal_distribution(-thickness / sigma);
}

EdgeModel fit_edge_model(const Profile& profile, double thickest) {
  // Nested searches: the three parameters compensate for each other, so that a descent along one
  // of them at a time would get stuck.
  const Fit best = least(1, thickest, [&](double thickness) {
    return least(0.2, 2.6, [&](double sigma) {
      return least(-1, 1, [&](double shift) {
        return fit_values(profile, {sigma, thickness, shift});
      });
    });
  });
  return best.edge;
}

}  // namespace mesamis::detail::restore
