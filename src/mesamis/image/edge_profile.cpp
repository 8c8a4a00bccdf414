// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/edge_profile.h"

#include <Eigen/Dense>
#include <cmath>

#include "mesamis/base/median.h"
#include "mesamis/base/parallel.h"

namespace mesamis {
namespace {

double normal_distribution(double t) { return 0.5 * std::erfc(-t / std::sqrt(2)); }

/// mm of a place in voxels.
Vec3 in_mm(const Volume& volume, const Vec3& voxels) {
  const Vec3& s = volume.spacing;
  return {voxels.x * s.x, voxels.y * s.y, voxels.z * s.z};
}

/// What is not linear in an edge.
struct Shape {
  double sigma, thickness, place;
};

/// An edge and what it costs: its misfit, squared, and its core's price.
struct Fit {
  Edge edge;
  double cost = 0;
};

/// The best values for a shape, by linear least squares, without a core if it came out brighter. A
/// core has a price: a shell that explains no more than noise or a bend is not there.
Fit fit_values(const Profile& profile, const Shape& shape) {
  constexpr int kSamples = 2 * kProfileHalf + 1;
  constexpr double kPrice = 3e-5;
  Eigen::Matrix<double, kSamples, 3> steps;
  for (int n = 0; n < kSamples; ++n) {
    const double t = (n - kProfileHalf) * kProfileStep - shape.place;
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
  return {{x[0], x[0] + x[1], x[0] + x[1] + x[2], shape.thickness, shape.sigma, shape.place,
           std::sqrt(square)},
          square + kPrice * std::abs(x[1] * x[2])};
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

Vec3 voxel_direction(const Volume& volume, const Vec3& n) {
  const Vec3& s = volume.spacing;
  const Vec3 d{n.x / s.x, n.y / s.y, n.z / s.z};
  return (1 / norm(d)) * d;
}

Profile median_profile(const Volume& volume, const PointGroup& points) {
  Profile profile;
  parallel_for_each(profile.size(), [&](std::size_t n) {
    const double offset = (static_cast<double>(n) - kProfileHalf) * kProfileStep;
    std::vector<double> values;
    values.reserve(points.size());
    for (const SurfacePoint* point : points) {
      const Vec3 step = in_mm(volume, voxel_direction(volume, point->normal));
      values.push_back(interpolate(volume, point->position - offset * step));
    }
    profile[n] = median(values);
  });
  return profile;
}

double Edge::level() const {
  return (outside + shell) / 2 + (core - shell) * normal_distribution(-thickness / sigma);
}

Edge fit_edge(const Profile& profile) {
  // One inside the other, for the three make up for each other: steps along axes would get stuck.
  const Fit best = least(1, 2.5, [&](double thickness) {
    return least(0.2, 2.6, [&](double sigma) {
      return least(-1, 1, [&](double place) {
        return fit_values(profile, {sigma, thickness, place});
      });
    });
  });
  return best.edge;
}

}  // namespace mesamis
