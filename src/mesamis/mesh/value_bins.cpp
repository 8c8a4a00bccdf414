// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/value_bins.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesamis/base/error.h"

namespace mesamis::detail::mesh {
namespace {

std::vector<double> equal_edges(double low, double high, int count) {
  std::vector<double> edges;
  edges.reserve(static_cast<std::size_t>(count) + 1);
  for (int b = 0; b < count; ++b) {
    edges.push_back(std::min(low + (high - low) * b / count, high));
  }
  edges.push_back(high);
  return edges;
}

}  // namespace

ValueBins equal_bins(std::span<const double> values, int count) {
  if (count < 1) throw InputError("bins: expected at least one, found " + std::to_string(count));
  if (values.empty()) throw InputError("bins: expected at least one value, found none");
  if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); })) {
    throw InputError("bins: expected finite values");
  }
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  ValueBins bins{equal_edges(*low, *high, count), {}};
  bins.of_value.reserve(values.size());
  for (const double value : values) {
    const auto above = std::upper_bound(bins.edges.begin() + 1, bins.edges.end() - 1, value);
    bins.of_value.push_back(static_cast<Index>(above - bins.edges.begin() - 1));
  }
  return bins;
}

}  // namespace mesamis::detail::mesh
