// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/background.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/fem/transfer.h"

namespace mesamis::detail::slabs {
namespace {

/// @param fields  u and v at the points.
std::vector<NodeValues> collected(const MetricField& metric, std::span<const Vec3> points,
                                  const std::vector<std::vector<double>>& fields) {
  const std::vector<Sym3> metrics = sample(metric, points);
  std::vector<NodeValues> values(points.size());
  for (std::size_t n = 0; n < values.size(); ++n) {
    values[n] = {fields[0][n], fields[1][n], 0, metrics[n]};
  }
  return values;
}

}  // namespace

MeshBackground::MeshBackground(Piece piece)
    : piece_(std::move(piece)),
      metric_(piece_.mesh, values_of(piece_, &NodeValues::metric), MeshExtent::kPiece) {}

std::vector<NodeValues> MeshBackground::values(std::span<const Vec3> points) const {
  const std::vector<double> u = values_of(piece_, &NodeValues::u);
  const std::vector<double> v = values_of(piece_, &NodeValues::v);
  const std::vector<std::span<const double>> fields{u, v};
  return collected(metric_, points,
                   interpolate_fields(piece_.mesh, fields, points, MeshExtent::kPiece));
}

LowBackground::LowBackground(const Background& inner, double h_max, double highest)
    : inner_(inner) {
  const double coarse = 1 / (h_max * h_max), fine = 1 / (highest * highest);
  low_ = {coarse, 0, 0, coarse, 0, std::max(coarse, fine)};
}

std::vector<NodeValues> LowBackground::values(std::span<const Vec3> points) const {
  std::vector<NodeValues> values = inner_.values(points);
  for (NodeValues& node : values) node.metric = intersect(node.metric, low_);
  return values;
}

KuhnGrid grid_of(const GridWindow& window) {
  KuhnGrid grid{.size = window.size, .spacing = {}};
  const Vec3 extent = window.box.extent();
  for (int a = 0; a < 3; ++a) {
    grid.spacing[a] = extent[a] / (window.size[static_cast<std::size_t>(a)] - 1);
  }
  return grid;
}

SliceRange slice_range(const GridWindow& window, double low, double high) {
  const double step = (window.box.hi.z - window.box.lo.z) / (window.size[2] - 1);
  // What lies on a slice but for round-off needs none beyond.
  constexpr double kRoundOff = 1e-6;
  const auto slice_at = [&](double height, double slack) {
    return std::clamp((height - window.box.lo.z) / step + slack, 0.0, window.size[2] - 1.0);
  };
  const auto first = std::min(static_cast<Index>(slice_at(low, kRoundOff)), window.size[2] - 2);
  const auto last = std::max(static_cast<Index>(std::ceil(slice_at(high, -kRoundOff))), first + 1);
  return {first, last - first + 1};
}

GridWindow frame_of(const GridWindow& window, const SliceRange& range) {
  const double step = (window.box.hi.z - window.box.lo.z) / (window.size[2] - 1);
  GridWindow some{window.box, window.size, {}, {}, {}};
  some.size[2] = range.count;
  some.box.lo.z = window.box.lo.z + range.first * step;
  some.box.hi.z = window.box.lo.z + (range.first + range.count - 1) * step;
  return some;
}

GridWindow slices_between(const GridWindow& window, double low, double high) {
  const SliceRange range = slice_range(window, low, high);
  GridWindow some = frame_of(window, range);
  const auto slice = static_cast<std::ptrdiff_t>(window.size[0]) * window.size[1];
  const auto copy = [&](const auto& from, auto& to) {
    const auto begin = from.begin() + range.first * slice;
    to.assign(begin, begin + range.count * slice);
  };
  copy(window.u, some.u);
  copy(window.v, some.v);
  copy(window.log_metrics, some.log_metrics);
  return some;
}

GridBackground::GridBackground(GridWindow window)
    : window_(std::move(window)),
      metric_(window_.box, window_.size, std::move(window_.log_metrics)) {}

std::vector<NodeValues> GridBackground::values(std::span<const Vec3> points) const {
  std::vector<Vec3> from_corner(points.begin(), points.end());
  for (Vec3& p : from_corner) p = p - window_.box.lo;
  const std::vector<std::span<const float>> fields{window_.u, window_.v};
  return collected(metric_, points, interpolate_fields(grid_of(window_), fields, from_corner));
}

Index StackedBackground::part_at(double height) const {
  return static_cast<Index>(std::upper_bound(tops_.begin(), tops_.end(), height) - tops_.begin());
}

// The hint is that of one of the parts, and whose: another one's would be the number of no cell.
Sym3 StackedBackground::at(const Vec3& p, Index& hint) const {
  const auto count = static_cast<Index>(parts_.size());
  const Index part = part_at(p.z);
  Index inner = hint % count == part ? hint / count : 0;
  const Sym3 metric = parts_[static_cast<std::size_t>(part)]->at(p, inner);
  hint = count * inner + part;
  return metric;
}

std::vector<NodeValues> StackedBackground::values(std::span<const Vec3> points) const {
  std::vector<std::vector<std::size_t>> places(parts_.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    places[static_cast<std::size_t>(part_at(points[n].z))].push_back(n);
  }
  std::vector<NodeValues> all(points.size());
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    std::vector<Vec3> some;
    some.reserve(places[part].size());
    for (const std::size_t n : places[part]) some.push_back(points[n]);
    const std::vector<NodeValues> values = parts_[part]->values(some);
    for (std::size_t at = 0; at < values.size(); ++at) all[places[part][at]] = values[at];
  }
  return all;
}

std::unique_ptr<Background> stack(std::vector<GridWindow> windows) {
  std::vector<std::unique_ptr<Background>> parts;
  std::vector<double> tops;
  for (GridWindow& window : windows) {
    if (parts.size() + 1 < windows.size()) tops.push_back(window.box.hi.z);
    parts.push_back(std::make_unique<GridBackground>(std::move(window)));
  }
  return std::make_unique<StackedBackground>(std::move(parts), std::move(tops));
}

}  // namespace mesamis::detail::slabs
