// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/background.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/fem/transfer.h"

namespace mesamis::detail {
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

KuhnGrid grid_of(const GridWindow& window) {
  KuhnGrid grid{.size = window.size, .spacing = {}};
  const Vec3 extent = window.box.extent();
  for (int a = 0; a < 3; ++a) {
    grid.spacing[a] = extent[a] / (window.size[static_cast<std::size_t>(a)] - 1);
  }
  return grid;
}

GridWindow slices_between(const GridWindow& window, double low, double high) {
  const double step = (window.box.hi.z - window.box.lo.z) / (window.size[2] - 1);
  const auto slice_at = [&](double height) {
    return std::clamp((height - window.box.lo.z) / step, 0.0, window.size[2] - 1.0);
  };
  const auto first = std::min(static_cast<Index>(slice_at(low)), window.size[2] - 2);
  const auto last = std::max(static_cast<Index>(std::ceil(slice_at(high))), first + 1);
  GridWindow some{window.box, window.size, {}, {}, {}};
  some.size[2] = last - first + 1;
  some.box.lo.z = window.box.lo.z + first * step;
  some.box.hi.z = window.box.lo.z + last * step;
  const auto slice = static_cast<std::ptrdiff_t>(window.size[0]) * window.size[1];
  const auto copy = [&](const auto& from, auto& to) {
    to.assign(from.begin() + first * slice, from.begin() + (last + 1) * slice);
  };
  copy(window.u, some.u);
  copy(window.v, some.v);
  copy(window.log_metrics, some.log_metrics);
  return some;
}

void add_window(ArchiveWriter& archive, const GridWindow& window) {
  archive.add_one(window.box);
  archive.add_one(window.size);
  archive.add(window.u);
  archive.add(window.v);
  archive.add(window.log_metrics);
}

GridWindow next_window(ArchiveReader& archive) {
  GridWindow window;
  window.box = archive.next_one<Box>();
  window.size = archive.next_one<std::array<Index, 3>>();
  window.u = archive.next<float>();
  window.v = archive.next<float>();
  window.log_metrics = archive.next<std::array<float, 6>>();
  return window;
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

// The hint is that of one of both, and whose: the other one's would be the number of no cell.
Sym3 TwoBackgrounds::at(const Vec3& p, Index& hint) const {
  const bool above = p.z >= height_;
  Index inner = (hint % 2 != 0) == above ? hint / 2 : 0;
  const Sym3 metric = (above ? *above_ : *below_).at(p, inner);
  hint = 2 * inner + (above ? 1 : 0);
  return metric;
}

std::vector<NodeValues> TwoBackgrounds::values(std::span<const Vec3> points) const {
  std::vector<NodeValues> all(points.size());
  for (const bool above : {false, true}) {
    std::vector<std::size_t> places;
    std::vector<Vec3> some;
    for (std::size_t n = 0; n < points.size(); ++n) {
      if ((points[n].z >= height_) != above) continue;
      places.push_back(n);
      some.push_back(points[n]);
    }
    const std::vector<NodeValues> values = (above ? *above_ : *below_).values(some);
    for (std::size_t n = 0; n < places.size(); ++n) all[places[n]] = values[n];
  }
  return all;
}

}  // namespace mesamis::detail
