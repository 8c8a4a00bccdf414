// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "mesamis/base/error.h"

namespace mesamis {
namespace {

/// Voxels, where beta is 2: influences fall by e within its root, so that beyond this a changed
/// voxel moves the fields by a few thousandths of its change. On meshes the cells count as well:
/// influences fall by about four from one to the next.
constexpr double kOverlap = 8;

Index default_count(const VoxelGrid& whole, Index thinnest) {
  constexpr double kMeanVoxels = 1 << 26;
  const auto by_memory =
      static_cast<Index>(std::ceil(static_cast<double>(whole.voxel_count()) / kMeanVoxels));
  return std::clamp(by_memory, 1, std::max(1, whole.size[2] / thinnest));
}

/// The first slices of the slabs, and the end of the last. No slab is thicker than twice the mean:
/// memory counts voxels.
/// @param thinnest  slices; count times that is no more than there are.
std::vector<Index> equal_shares(std::span<const double> work, Index count, Index thinnest) {
  const auto slices = static_cast<Index>(work.size());
  const Index thickest = 2 * ((slices + count - 1) / count);
  std::vector<double> before(work.size() + 1, 0);
  std::partial_sum(work.begin(), work.end(), before.begin() + 1);
  std::vector<Index> cuts{0};
  for (Index s = 1; s < count; ++s) {
    const double share = before.back() * s / count;
    const auto place = std::lower_bound(before.begin(), before.end(), share) - before.begin();
    const Index after = count - s;
    cuts.push_back(std::clamp(static_cast<Index>(place),
                              std::max(cuts.back() + thinnest, slices - after * thickest),
                              std::min(cuts.back() + thickest, slices - after * thinnest)));
  }
  cuts.push_back(slices);
  return cuts;
}

}  // namespace

Index SlabPlan::slices_in(double length) const noexcept {
  return static_cast<Index>(std::ceil(length * unit_mm / whole.spacing.z));
}

double SlabPlan::thinnest() const noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (Index s = 0; s < count(); ++s) least = std::min(least, height(s + 1) - height(s));
  return least;
}

SlabPlan plan_slabs(const VoxelGrid& whole, std::span<const double> work,
                    const SlabOptions& options) {
  SlabPlan plan{whole, options.unit_mm, 0, {0, whole.size[2]}};
  const double voxels = std::max(1.0, std::sqrt(options.beta / 2)) * whole.voxel_size();
  plan.overlap = kOverlap * voxels / options.unit_mm;
  const Index thinnest = kOverlapsInSlab * plan.slices_in(plan.overlap);
  const Index count = options.slabs.value_or(default_count(whole, thinnest));
  if (count < 1 || (count > 1 && whole.size[2] / count < thinnest)) {
    throw InputError("slabs: expected 1 to " +
                     std::to_string(std::max(1, whole.size[2] / thinnest)) + ", of at least " +
                     std::to_string(thinnest) + " of the " + std::to_string(whole.size[2]) +
                     " slices each, found " + std::to_string(count));
  }
  plan.cuts = equal_shares(work, count, thinnest);
  return plan;
}

}  // namespace mesamis
