// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/metric_sampler.h"

#include <algorithm>
#include <cmath>

#include "mesamis/mesh/metric.h"

namespace mesamis::detail::remesh {
namespace {

MetricFactor factorise(const Sym3& m, double pivot_min, double scale) {
  const double xx = std::sqrt(std::max(m.xx, pivot_min));
  const double yx = m.xy / xx, zx = m.xz / xx;
  const double yy = std::sqrt(std::max(m.yy - yx * yx, pivot_min));
  const double zy = (m.yz - zx * yx) / yy;
  const double zz = std::sqrt(std::max(m.zz - zx * zx - zy * zy, pivot_min));
  auto entry = [scale](double value) { return static_cast<float>(scale * value); };
  return {entry(xx), entry(yx), entry(zx), entry(yy), entry(zy), entry(zz)};
}

}  // namespace

MetricSampler::MetricSampler(const MetricField& field, const Box& box) : field_(&field) {
  const double diagonal = norm(box.extent());
  size_min_ = 1e-10 * diagonal;
  size_max_ = 1e4 * diagonal;
}

MetricFactor MetricSampler::at(const Vec3& p, Index& hint) const {
  Sym3 m = field_->at(p, hint);
  const double largest = trace(m);
  if (!std::isfinite(largest + m.xy + m.xz + m.yz)) m = Sym3{};
  if (largest > 1 / (size_min_ * size_min_)) m = clamp_sizes(m, size_min_, size_max_);
  return factorise(m, 1 / (size_max_ * size_max_), 1 / size_factor_);
}

}  // namespace mesamis::detail::remesh
