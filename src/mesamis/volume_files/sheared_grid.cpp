// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/sheared_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/base/parallel.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::volume_files {
namespace {

constexpr double kRoundOff = 1e-6;  // voxels

/// Orthonormal axes beside the steps: along the first, in the plane of two, across both.
std::array<Vec3, 3> axes_beside(const std::array<Vec3, 3>& steps) {
  const Vec3 u = unit_or_zero(steps[0]);
  const Vec3 v = unit_or_zero(steps[1] - dot(steps[1], u) * u);
  Vec3 w = cross(u, v);
  if (dot(steps[2], w) < 0) w = -w;
  return {u, v, w};
}

/// Where the corners of a sheared box end along an axis, mm from its first voxel.
std::array<double, 2> ends_along(const Vec3& axis, const std::array<Vec3, 3>& steps,
                                 const std::array<Index, 3>& size) {
  std::array<double, 2> ends{0, 0};
  for (std::size_t a = 0; a < 3; ++a) {
    const double reach = (size[a] - 1) * dot(steps[a], axis);
    ends[reach < 0 ? 0 : 1] += reach;
  }
  return ends;
}

/// The inverse of the matrix whose columns are the steps, by rows.
std::array<Vec3, 3> inverse_of(const std::array<Vec3, 3>& steps) {
  const double volume = dot(steps[0], cross(steps[1], steps[2]));
  return {(1 / volume) * cross(steps[1], steps[2]), (1 / volume) * cross(steps[2], steps[0]),
          (1 / volume) * cross(steps[0], steps[1])};
}

void require_space(const std::filesystem::path& file, const std::array<Vec3, 3>& steps) {
  constexpr double kLeast = 0.05;  // of the product of the lengths
  const double volume = std::abs(dot(steps[0], cross(steps[1], steps[2])));
  const double lengths = norm(steps[0]) * norm(steps[1]) * norm(steps[2]);
  if (volume > kLeast * lengths) return;
  refuse(file, "expected three axes that span space, found axes that nearly lie in a plane");
}

Index voxels_between(const std::filesystem::path& file, const std::array<double, 2>& ends,
                     double spacing) {
  const double count = std::ceil((ends[1] - ends[0]) / spacing - kRoundOff) + 1;
  if (!(count < std::numeric_limits<Index>::max())) {
    refuse(file, message("expected a grid that can be resampled, found ", count,
                         " voxels along an axis"));
  }
  return static_cast<Index>(count);
}

/// Samples between the voxels of a sheared grid.
class Between {
 public:
  Between(const std::array<Index, 3>& size, const std::vector<float>& samples)
      : size_(size), samples_(samples) {}

  /// Linear along each axis; false outside.
  bool at(const Vec3& index, float& value) const {
    std::array<std::size_t, 3> low{},
        step{1, static_cast<std::size_t>(size_[0]),
             static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1])};
    std::array<double, 3> weight{};
    std::size_t first = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double x = index[static_cast<int>(a)], last = size_[a] - 1;
      if (x < -kRoundOff || x > last + kRoundOff) return false;
      const double cell = std::clamp(std::floor(x + kRoundOff), 0.0, last);
      low[a] = static_cast<std::size_t>(cell);
      weight[a] = x - cell < kRoundOff || cell == last ? 0 : x - cell;
      first += low[a] * step[a];
    }
    double sum = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      double share = 1;
      std::size_t place = first;
      for (std::size_t a = 0; a < 3; ++a) {
        const bool above = (corner >> a & 1U) != 0;
        share *= above ? weight[a] : 1 - weight[a];
        place += above ? step[a] : 0;
      }
      if (share > 0) sum += share * static_cast<double>(samples_[place]);
    }
    value = static_cast<float>(sum);
    return true;
  }

 private:
  std::array<Index, 3> size_;
  const std::vector<float>& samples_;
};

/// The values of a function of the old grid's indices at the voxels of the new one.
template <class Value, class Find>
std::vector<Value> on_new_grid(const ShearPlan& plan, const Find& find) {
  const VoxelGrid& grid = plan.grid;
  std::vector<Value> out(grid.voxel_count());
  parallel_for_each(static_cast<std::size_t>(grid.size[2]), [&](std::size_t k) {
    Value* at = out.data() + grid.offset(0, 0, static_cast<Index>(k));
    for (Index j = 0; j < grid.size[1]; ++j) {
      for (Index i = 0; i < grid.size[0]; ++i, ++at) {
        const Vec3 local{i * grid.spacing.x, j * grid.spacing.y,
                         static_cast<double>(k) * grid.spacing.z};
        const Vec3 p = plan.first + grid.direction * local;
        *at = find({dot(plan.to_index[0], p), dot(plan.to_index[1], p), dot(plan.to_index[2], p)});
      }
    }
  });
  return out;
}

}  // namespace

ShearPlan plan_unsheared(const std::filesystem::path& file, const VoxelGrid& old,
                         const std::array<Vec3, 3>& steps) {
  constexpr double kMostPerVoxel = 64;
  require_space(file, steps);
  const auto axes = axes_beside(steps);
  ShearPlan plan{old, old.size, inverse_of(steps), {}, {}, {}};
  double voxels = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const double spacing = dot(steps[a], axes[a]);
    const auto ends = ends_along(axes[a], steps, old.size);
    plan.grid.spacing[static_cast<int>(a)] = spacing;
    plan.grid.size[a] = voxels_between(file, ends, spacing);
    plan.first += ends[0] * axes[a];
    voxels *= plan.grid.size[a];
  }
  if (voxels > kMostPerVoxel * static_cast<double>(old.voxel_count())) {
    refuse(file, message("expected a grid that can be resampled, found one that needs ", voxels,
                         " voxels for ", old.voxel_count()));
  }
  plan.grid.origin = old.origin + plan.first;
  plan.grid.direction = transpose(Mat3{axes});
  const double cosine = std::max({std::abs(dot(unit_or_zero(steps[0]), unit_or_zero(steps[1]))),
                                  std::abs(dot(unit_or_zero(steps[1]), unit_or_zero(steps[2]))),
                                  std::abs(dot(unit_or_zero(steps[2]), unit_or_zero(steps[0])))});
  const std::string sheared = message("the voxel axes are sheared (cosine ", cosine, "): ");
  const std::string onto = message(" onto ", plan.grid.size[0], " x ", plan.grid.size[1], " x ",
                                   plan.grid.size[2], " orthogonal voxels; what none covers ");
  plan.note = sheared + "interpolated" + onto + "has the least value";
  plan.label_note = sheared + "labels of the nearest voxels" + onto + "is background";
  return plan;
}

std::vector<float> unsheared(const ShearPlan& plan, const std::vector<float>& samples) {
  const float beyond = *std::min_element(samples.begin(), samples.end());
  const Between between(plan.size, samples);
  return on_new_grid<float>(plan, [&](const Vec3& index) {
    float value = beyond;
    return between.at(index, value) ? value : beyond;
  });
}

std::vector<std::uint16_t> unsheared(const ShearPlan& plan,
                                     const std::vector<std::uint16_t>& labels) {
  return on_new_grid<std::uint16_t>(plan, [&](const Vec3& index) -> std::uint16_t {
    std::size_t place = 0, step = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      const double nearest = std::floor(index[static_cast<int>(a)] + 0.5);
      if (!(nearest >= 0 && nearest < plan.size[a])) return 0;
      place += static_cast<std::size_t>(nearest) * step;
      step *= static_cast<std::size_t>(plan.size[a]);
    }
    return labels[place];
  });
}

}  // namespace mesamis::detail::volume_files
