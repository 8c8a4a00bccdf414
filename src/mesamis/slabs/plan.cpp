// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "mesamis/base/error.h"

namespace mesamis::detail::slabs {
namespace {

/// Voxels, where beta is 2: influences fall by e within its root, so that beyond this a changed
/// voxel moves the fields by a few thousandths of its change. On meshes the cells count as well:
/// influences fall by about four from one to the next.
constexpr double kOverlap = 8;
constexpr double kRoundOff = 1e-6;  // slices

Index default_count(const VoxelGrid& whole, Index thinnest) {
  constexpr std::size_t kMostVoxels = std::size_t{1} << 28;
  const Index twice_as_thick = whole.size[2] / (2 * thinnest);
  return std::clamp(std::max(slabs::parts_of(whole, kMostVoxels), twice_as_thick), 1,
                    std::max(1, whole.size[2] / thinnest));
}

/// Bounds of slabs, slices.
struct Bounds {
  Index count = 1;                   ///< of the slabs
  Index thinnest = 1, thickest = 1;  ///< count times that is no more, no less than there are
  Index again = 0;                   ///< on each side of a cut
};

/// Cuts work into slabs that have equal shares of it.
class EqualShares {
 public:
  EqualShares(std::span<const double> work, const Bounds& bounds)
      : bounds_(bounds), slices_(static_cast<Index>(work.size())), before_(work.size() + 1, 0) {
    std::partial_sum(work.begin(), work.end(), before_.begin() + 1);
  }

  /// The first slices of the slabs, and the end of the last.
  std::vector<Index> cuts() const {
    double low = 0, high = 2 * before_.back();  // of the share
    for (int i = 0; i < 50; ++i) {
      const double share = (low + high) / 2;
      const std::vector<Index> found = cuts_for(share);
      (between(found[found.size() - 2], slices_) > share ? low : high) = share;
    }
    constexpr double kALittleLess = 1 - 1e-9;
    return cuts_for(kALittleLess * high);
  }

 private:
  double between(Index begin, Index end) const {
    return before_[static_cast<std::size_t>(std::min(end, slices_))] -
           before_[static_cast<std::size_t>(std::max(begin, 0))];
  }
  /// Every slab but the last has this share.
  std::vector<Index> cuts_for(double share) const {
    const auto& [count, thinnest, thickest, again] = bounds_;
    std::vector<Index> cuts{0};
    for (Index s = 1; s < count; ++s) {
      const Index after = count - s, last = cuts.back();
      Index cut = std::max(last + thinnest, slices_ - after * thickest);
      const Index most = std::min(last + thickest, slices_ - after * thinnest);
      while (cut < most && between(last, cut) + between(cut - again, cut + again) < share) ++cut;
      cuts.push_back(cut);
    }
    cuts.push_back(slices_);
    return cuts;
  }

  Bounds bounds_;
  Index slices_;
  std::vector<double> before_;
};

}  // namespace

Index parts_of(const VoxelGrid& whole, std::size_t voxels) noexcept {
  return static_cast<Index>(std::max<std::size_t>(1, (whole.voxel_count() + voxels - 1) / voxels));
}

Index SlabPlan::slices_in(double length) const noexcept {
  return static_cast<Index>(std::ceil(length * unit_mm / whole.spacing.z - kRoundOff));
}

std::size_t SlabPlan::slice_at(double height) const noexcept {
  const double slice = height * unit_mm / whole.spacing.z + kRoundOff;
  return static_cast<std::size_t>(std::clamp(slice, 0.0, whole.size[2] - 1.0));
}

double SlabPlan::thinnest() const noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (Index s = 0; s < count(); ++s) least = std::min(least, thickness(s));
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
  const Index slices = whole.size[2];
  const Index thickest = options.bounded ? 2 * ((slices + count - 1) / count) : slices;
  plan.cuts = EqualShares(work, {count, thinnest, thickest, plan.slices_in(options.again)}).cuts();
  return plan;
}

}  // namespace mesamis::detail::slabs
