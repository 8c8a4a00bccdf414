// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/single_grid_system.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/parallel.h"

namespace mesamis::detail::fem {
namespace {

/// The first nodes of the four lines of nodes around a line of bricks.
struct BrickLine {
  std::size_t here, y, z, yz;
  std::size_t bricks;
};

/// A number for each of the six paths of the bricks of a line, in the order of kKuhnPaths.
using PathLines = std::array<std::vector<float>, 6>;

/// Calls body(line, paths) for every line of bricks. Layers of one parity touch disjoint nodes:
/// even ones run concurrently, then odd ones, so that sums have one order.
template <class Body>
void for_each_brick_line(const KuhnGrid& grid, Body&& body) {
  const auto stride = grid.stride();
  const std::size_t bricks = stride[1] - 1;
  for (Index parity = 0; parity < 2; ++parity) {
    const auto layers = static_cast<std::size_t>((grid.size[2] - parity) / 2);
    parallel_for_each(layers, [&](std::size_t layer) {
      PathLines paths;
      for (auto& line : paths) line.resize(bricks);
      const std::size_t k = 2 * layer + static_cast<std::size_t>(parity);
      for (std::size_t j = 0; j + 1 < static_cast<std::size_t>(grid.size[1]); ++j) {
        const std::size_t n = k * stride[2] + j * stride[1];
        body(BrickLine{n, n + stride[1], n + stride[2], n + stride[1] + stride[2], bricks}, paths);
      }
    });
  }
}

void add(const float* terms, float factor, std::size_t count, float* sums) {
  for (std::size_t i = 0; i < count; ++i) sums[i] += factor * terms[i];
}

void add(const float* a, const float* b, float factor, std::size_t count, float* sums) {
  for (std::size_t i = 0; i < count; ++i) sums[i] += factor * (a[i] + b[i]);
}

/// Adds up body(k) over the layers of nodes, in their order.
template <class Body>
double sum_of_layers(const KuhnGrid& grid, Body&& body) {
  std::vector<double> sums(static_cast<std::size_t>(grid.size[2]), 0);
  parallel_for_each(sums.size(), [&](std::size_t k) { sums[k] = body(static_cast<Index>(k)); });
  double sum = 0;
  for (const double of_layer : sums) sum += of_layer;
  return sum;
}

/// Adds up body(first node, j, k) over the lines of nodes of a layer.
template <class Body>
double sum_of_layer(const KuhnGrid& grid, Index k, Body&& body) {
  const auto stride = grid.stride();
  std::size_t n = static_cast<std::size_t>(k) * stride[2];
  double sum = 0;
  for (Index j = 0; j < grid.size[1]; ++j, n += stride[1]) sum += body(n, j, k);
  return sum;
}

/// Adds up body(first node, j, k) over all lines of nodes, layer by layer.
template <class Body>
double sum_of_lines(const KuhnGrid& grid, Body&& body) {
  return sum_of_layers(grid, [&](Index k) { return sum_of_layer(grid, k, body); });
}

/// The sum of term(i) in four parts, which do not wait for each other.
template <class Term>
double sum_of(std::size_t count, Term&& term) {
  std::array<double, 4> parts{};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    for (std::size_t n = 0; n < 4; ++n) parts[n] += static_cast<double>(term(i + n));
  }
  for (; i < count; ++i) parts[0] += static_cast<double>(term(i));
  return (parts[0] + parts[1]) + (parts[2] + parts[3]);
}

}  // namespace

SingleGridSystem::SingleGridSystem(const KuhnGrid& grid) : grid_(grid) {
  for (auto& of_axis : conductance_) of_axis.resize(grid.node_count());
  for (auto* field : {&diagonal_, &r_, &p_, &ap_}) field->resize(grid.node_count());
}

void SingleGridSystem::couple(std::span<const float> v, double scale, double offset) {
  for (auto& of_axis : conductance_) {
    parallel_for(of_axis.size(), [&](std::size_t n) { of_axis[n] = 0; });
  }
  add_cell_coefficients(v, scale, offset);
}

namespace {

/// c_K of the cells of a line of bricks.
void find_coefficients(std::span<const float> v, const BrickLine& at, float quarter, float offset,
                       PathLines& c) {
  if (v.empty()) {
    for (auto& line : c) std::fill(line.begin(), line.end(), offset);
    return;
  }
  const float *here = &v[at.here], *y = &v[at.y], *z = &v[at.z], *yz = &v[at.yz];
  const std::array<float*, 6> out{c[0].data(), c[1].data(), c[2].data(),
                                  c[3].data(), c[4].data(), c[5].data()};
  for (std::size_t i = 0; i < at.bricks; ++i) {
    const auto square = [](float x) { return x * x; };
    const float ends = square(here[i]) + square(yz[i + 1]);
    const float x_ = square(here[i + 1]), y_ = square(y[i]), z_ = square(z[i]),
                xy = square(y[i + 1]), xz = square(z[i + 1]), yz_ = square(yz[i]);
    out[0][i] = quarter * (ends + x_ + xy) + offset;
    out[1][i] = quarter * (ends + x_ + xz) + offset;
    out[2][i] = quarter * (ends + y_ + xy) + offset;
    out[3][i] = quarter * (ends + y_ + yz_) + offset;
    out[4][i] = quarter * (ends + z_ + xz) + offset;
    out[5][i] = quarter * (ends + z_ + yz_) + offset;
  }
}

/// |grad u|^2 of the cells of a line of bricks.
void find_squares(std::span<const float> u, const BrickLine& at, const std::array<float, 3>& factor,
                  PathLines& squares) {
  const float *here = &u[at.here], *y = &u[at.y], *z = &u[at.z], *yz = &u[at.yz];
  const std::array<float*, 6> out{squares[0].data(), squares[1].data(), squares[2].data(),
                                  squares[3].data(), squares[4].data(), squares[5].data()};
  const auto [fx, fy, fz] = factor;
  for (std::size_t i = 0; i < at.bricks; ++i) {
    const auto square = [](float d) { return d * d; };
    const float x_0 = fx * square(here[i + 1] - here[i]), x_y = fx * square(y[i + 1] - y[i]),
                x_z = fx * square(z[i + 1] - z[i]), x_yz = fx * square(yz[i + 1] - yz[i]);
    const float y_0 = fy * square(y[i] - here[i]), y_x = fy * square(y[i + 1] - here[i + 1]),
                y_z = fy * square(yz[i] - z[i]), y_xz = fy * square(yz[i + 1] - z[i + 1]);
    const float z_0 = fz * square(z[i] - here[i]), z_x = fz * square(z[i + 1] - here[i + 1]),
                z_y = fz * square(yz[i] - y[i]), z_xy = fz * square(yz[i + 1] - y[i + 1]);
    out[0][i] = x_0 + y_x + z_xy;
    out[1][i] = x_0 + z_x + y_xz;
    out[2][i] = y_0 + x_y + z_xy;
    out[3][i] = y_0 + z_y + x_yz;
    out[4][i] = z_0 + x_z + y_xz;
    out[5][i] = z_0 + y_z + x_yz;
  }
}

}  // namespace

void SingleGridSystem::add_cell_coefficients(std::span<const float> v, double scale,
                                             double offset) {
  std::array<float, 3> weight;
  for (int a = 0; a < 3; ++a) {
    const double h = grid_.spacing[a];
    weight[static_cast<std::size_t>(a)] = static_cast<float>(grid_.cell_volume() / (h * h));
  }
  const float wx = weight[0], wy = weight[1], wz = weight[2];
  for_each_brick_line(grid_, [&](const BrickLine& at, PathLines& paths) {
    find_coefficients(v, at, static_cast<float>(scale / 4), static_cast<float>(offset), paths);
    const std::array<const float*, 6> c{paths[0].data(), paths[1].data(), paths[2].data(),
                                        paths[3].data(), paths[4].data(), paths[5].data()};
    const std::size_t n = at.bricks;
    auto& [x, y, z] = conductance_;
    add(c[0], c[1], wx, n, &x[at.here]);
    add(c[2], wx, n, &x[at.y]);
    add(c[4], wx, n, &x[at.z]);
    add(c[3], c[5], wx, n, &x[at.yz]);
    add(c[2], c[3], wy, n, &y[at.here]);
    add(c[0], wy, n, &y[at.here + 1]);
    add(c[5], wy, n, &y[at.z]);
    add(c[1], c[4], wy, n, &y[at.z + 1]);
    add(c[4], c[5], wz, n, &z[at.here]);
    add(c[1], wz, n, &z[at.here + 1]);
    add(c[3], wz, n, &z[at.y]);
    add(c[0], c[2], wz, n, &z[at.y + 1]);
  });
}

/// The diagonal of diag(d) + K(c) on a line of nodes.
void SingleGridSystem::find_diagonal(std::size_t n, Index j, Index k, std::span<float> line) const {
  const auto stride = grid_.stride();
  float* d = line.data();
  std::copy_n(&diagonal_[n], stride[1], d);
  const auto& [x, y, z] = conductance_;
  for (const auto& of_axis : conductance_) add(&of_axis[n], 1, stride[1], d);
  add(&x[n], 1, stride[1] - 1, d + 1);
  if (j > 0) add(&y[n - stride[1]], 1, stride[1], d);
  if (k > 0) add(&z[n - stride[2]], 1, stride[1], d);
}

/// Adds up body(first node, whole diagonal) over all lines of nodes, layer by layer.
template <class Body>
double SingleGridSystem::sum_with_diagonal(Body&& body) const {
  return sum_of_layers(grid_, [&](Index k) {
    std::vector<float> d(grid_.stride()[1]);
    return sum_of_layer(grid_, k, [&](std::size_t n, Index j, Index) {
      find_diagonal(n, j, k, d);
      return body(n, d.data());
    });
  });
}

/// A x into ap_; returns x'A x. Of constants the differences are zero, without round-off: where an
/// image is constant, so is what is found there.
double SingleGridSystem::apply(std::span<const float> x) {
  const auto stride = grid_.stride();
  const std::vector<float> nothing(stride[1], 0);
  return sum_of_lines(grid_, [&](std::size_t n, Index j, Index k) {
    const bool has_before_y = j > 0, has_before_z = k > 0;
    const float *d = &diagonal_[n], *cx = &conductance_[0][n], *cy = &conductance_[1][n],
                *cz = &conductance_[2][n];
    const float* cy_before = has_before_y ? cy - stride[1] : nothing.data();
    const float* cz_before = has_before_z ? cz - stride[2] : nothing.data();
    const float* here = &x[n];
    // Beyond the ends the conductance is zero, and any value does.
    const float* y_before = has_before_y ? here - stride[1] : here;
    const float* z_before = has_before_z ? here - stride[2] : here;
    const float* y_next = j + 1 < grid_.size[1] ? here + stride[1] : here;
    const float* z_next = k + 1 < grid_.size[2] ? here + stride[2] : here;
    float* result = &ap_[n];
    for (std::size_t i = 0; i < stride[1]; ++i) {
      result[i] =
          d[i] * here[i] + (cy_before[i] * (here[i] - y_before[i]) + cy[i] * (here[i] - y_next[i]));
    }
    for (std::size_t i = 0; i < stride[1]; ++i) {
      result[i] += cz_before[i] * (here[i] - z_before[i]) + cz[i] * (here[i] - z_next[i]);
    }
    for (std::size_t i = 0; i + 1 < stride[1]; ++i) {
      result[i] += cx[i] * (here[i] - here[i + 1]);
    }
    for (std::size_t i = 1; i < stride[1]; ++i) {
      result[i] += cx[i - 1] * (here[i] - here[i - 1]);
    }
    return sum_of(stride[1], [&](std::size_t i) { return here[i] * result[i]; });
  });
}

/// p = r / d; returns r'p.
double SingleGridSystem::start() {
  const std::size_t count = grid_.stride()[1];
  return sum_with_diagonal([&](std::size_t n, const float* d) {
    const float* r = &r_[n];
    float* p = &p_[n];
    for (std::size_t i = 0; i < count; ++i) p[i] = r[i] / d[i];
    return sum_of(count, [&](std::size_t i) { return r[i] * p[i]; });
  });
}

/// x += alpha p, r -= alpha A p, and r / d into ap_; returns r'r / d.
double SingleGridSystem::step(std::span<float> solution, double alpha) {
  const std::size_t count = grid_.stride()[1];
  const auto factor = static_cast<float>(alpha);
  return sum_with_diagonal([&](std::size_t n, const float* d) {
    const float* p = &p_[n];
    float *x = &solution[n], *r = &r_[n], *ap = &ap_[n];
    for (std::size_t i = 0; i < count; ++i) x[i] += factor * p[i];
    for (std::size_t i = 0; i < count; ++i) {
      r[i] -= factor * ap[i];
      ap[i] = r[i] / d[i];
    }
    return sum_of(count, [&](std::size_t i) { return r[i] * ap[i]; });
  });
}

/// p = r / d + beta p.
void SingleGridSystem::turn(double beta) {
  const auto factor = static_cast<float>(beta);
  parallel_for(p_.size(), [&](std::size_t n) { p_[n] = ap_[n] + factor * p_[n]; });
}

SolveReport SingleGridSystem::solve(std::span<float> x, const SolveOptions& options) {
  SolveReport report;
  const double scale = start();
  if (scale == 0) {
    std::fill(x.begin(), x.end(), 0.0F);
    report.converged = true;
    return report;
  }
  apply(x);
  parallel_for(r_.size(), [&](std::size_t n) { r_[n] -= ap_[n]; });
  double rz = start();
  const double goal = options.tolerance * options.tolerance * scale;
  const int most = std::min(options.jacobi_iterations, options.max_iterations);
  while (rz > goal && report.iterations < most) {
    const double curvature = apply(p_);
    if (!(curvature > 0)) break;  // the direction is exhausted to round-off
    const double before = rz;
    rz = step(x, before / curvature);
    turn(rz / before);
    ++report.iterations;
  }
  report.residual = std::sqrt(rz / scale);
  report.converged = report.residual <= 2 * options.tolerance;
  return report;
}

void find_gradient_squares(const KuhnGrid& grid, std::span<const float> u,
                           std::span<float> squares) {
  std::array<float, 3> factor;
  for (int a = 0; a < 3; ++a) {
    const double h = grid.spacing[a];
    factor[static_cast<std::size_t>(a)] = static_cast<float>(1 / (h * h));
  }
  const auto quarter = static_cast<float>(grid.cell_volume() / 4);
  parallel_for(squares.size(), [&](std::size_t n) { squares[n] = 0; });
  for_each_brick_line(grid, [&](const BrickLine& at, PathLines& paths) {
    find_squares(u, at, factor, paths);
    const std::array<const float*, 6> s{paths[0].data(), paths[1].data(), paths[2].data(),
                                        paths[3].data(), paths[4].data(), paths[5].data()};
    const std::size_t n = at.bricks;
    add(s[0], s[1], quarter, n, &squares[at.here + 1]);
    add(s[2], s[3], quarter, n, &squares[at.y]);
    add(s[4], s[5], quarter, n, &squares[at.z]);
    add(s[0], s[2], quarter, n, &squares[at.y + 1]);
    add(s[1], s[4], quarter, n, &squares[at.z + 1]);
    add(s[3], s[5], quarter, n, &squares[at.yz]);
    for (const std::size_t end : {at.here, at.yz + 1}) {
      for (std::size_t path = 0; path < 6; path += 2) {
        add(s[path], s[path + 1], quarter, n, &squares[end]);
      }
    }
  });
}

double sum_over_nodes(const KuhnGrid& grid, const GridMass& mass,
                      const std::function<double(std::size_t, double)>& term) {
  return sum_of_lines(grid, [&](std::size_t n, Index j, Index k) {
    const GridMass::Row row = mass.row(j, k);
    double sum = 0;
    for (Index i = 0; i < grid.size[0]; ++i) {
      sum += term(n + static_cast<std::size_t>(i), row.at(i));
    }
    return sum;
  });
}

}  // namespace mesamis::detail::fem
