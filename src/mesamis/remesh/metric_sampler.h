// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/base/types.h"
#include "mesamis/mesh/metric_field.h"

namespace mesamis::detail::remesh {

/// Lower Cholesky factor of a metric, M = L L^T: |L^T e| is the length of e. Single precision
/// is plenty for lengths and qualities, and keeps a vertex in one cache line.
struct MetricFactor {
  float xx = 0, yx = 0, zx = 0, yy = 0, zy = 0, zz = 0;
};

/// sqrt(det M)
inline double density(const MetricFactor& l) {
  return static_cast<double>(l.xx) * static_cast<double>(l.yy) * static_cast<double>(l.zz);
}

/// Evaluates a field and clamps its sizes to a range that suits the box and double precision, so
/// that no operation meets an overflow or an indefinite metric.
class MetricSampler {
 public:
  MetricSampler(const MetricField& field, const Box& box);

  /// All sizes are multiplied by it.
  double size_factor() const { return size_factor_; }
  void set_size_factor(double factor) { size_factor_ = factor; }

  MetricFactor at(const Vec3& p, Index& hint) const;

 private:
  const MetricField* field_;
  double size_min_, size_max_;
  double size_factor_ = 1;
};

}  // namespace mesamis::detail::remesh
