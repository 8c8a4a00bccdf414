// SPDX-License-Identifier: Apache-2.0
#include "mesamis/phantom/phantom_truth.h"

#include <algorithm>

namespace mesamis::detail::phantom {
namespace {

constexpr double kToleranceVoxel = 0.012;  // leaves room below kTruthErrorVoxel between the samples

}  // namespace

PhantomTruth make_truth(const Phantom& phantom) {
  const Vec3& spacing = phantom.spacing;
  const double voxel = std::min({spacing.x, spacing.y, spacing.z});
  PhantomTruth truth;
  truth.surface = extract_implicit(phantom.lines, phantom.inside, kToleranceVoxel * voxel);
  truth.check = check_surface(truth.surface);
  truth.error = implicit_error(truth.surface, phantom.inside);
  truth.error_bound = kTruthErrorVoxel * voxel;
  return truth;
}

}  // namespace mesamis::detail::phantom
