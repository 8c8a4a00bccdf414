// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/transfer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesamis/base/parallel.h"
#include "mesamis/fem/cell_quadrature.h"

namespace mesamis::detail::fem {
namespace {

/// Weights of the voxels along one axis for each node: the hat function of the node's
/// neighbourhood sampled at the voxels, normalised.
struct AxisFilter {
  struct Tap {
    Index first;
    std::vector<double> weights;
  };
  std::vector<Tap> taps;
};

AxisFilter hat_filter(Index voxels, Index nodes) {
  AxisFilter filter;
  const double step = static_cast<double>(voxels - 1) / (nodes - 1);  // voxels per node
  for (Index n = 0; n < nodes; ++n) {
    const double center = n * step;
    // Narrower towards the ends, where a hat cut off would shift linear images.
    const double reach = std::min({step, center + 1, voxels - center});
    const auto first = static_cast<Index>(std::floor(center - reach)) + 1;
    const auto last = static_cast<Index>(std::ceil(center + reach)) - 1;
    AxisFilter::Tap tap{first, {}};
    double sum = 0;
    for (Index i = first; i <= last; ++i) {
      tap.weights.push_back(1 - std::abs(i - center) / reach);
      sum += tap.weights.back();
    }
    for (double& weight : tap.weights) weight /= sum;
    filter.taps.push_back(std::move(tap));
  }
  return filter;
}

/// A cell's corners in the image's own axes, mm, in an order that makes it positive there.
std::array<Vec3, 4> corners_in_image(const VoxelGrid& image, const TetMesh& mesh,
                                     const Cell& cell) {
  std::array<Vec3, 4> corners = cell_corners(mesh, cell);
  for (Vec3& p : corners) {
    const Vec3 d = p - image.origin;
    const auto& r = image.direction.rows;  // orthonormal: the transpose turns back
    p = d.x * r[0] + d.y * r[1] + d.z * r[2];
  }
  return corners;
}

}  // namespace

ProjectedImage project_image(const SplineImage& image, const MeshSpace& space,
                             const ProjectionOptions& options) {
  const TetMesh& mesh = space.mesh();
  std::vector<std::array<double, 4>> loads(mesh.cells.size());
  parallel_blocks(mesh.cells.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      std::array<Vec3, 4> p;
      for (std::size_t i = 0; i < 4; ++i) {
        p[i] = options.point_scale * mesh.points[mesh.cells[c][i]];
      }
      const std::array<double, 4> fit = fit_image_on_cell(image, p);
      const double sum = fit[0] + fit[1] + fit[2] + fit[3];
      const double weight = cell_volume(mesh, static_cast<Index>(c)) / 20;
      for (std::size_t i = 0; i < 4; ++i) loads[c][i] = weight * (fit[i] + sum);
    }
  });
  std::vector<double> load(mesh.points.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (std::size_t i = 0; i < 4; ++i) load[mesh.cells[c][i]] += loads[c][i];
  }
  ProjectedImage projected{load, {}};
  std::vector<double>& f = projected.values;
  for (std::size_t n = 0; n < f.size(); ++n) f[n] /= space.lumped_mass()[n];
  projected.solve = solve(space.consistent_mass(), load, f, options.solver);
  return projected;
}

std::vector<float> project_image(const VolumeView& image, const KuhnGrid& grid) {
  const AxisFilter x = hat_filter(image.size[0], grid.size[0]);
  const AxisFilter y = hat_filter(image.size[1], grid.size[1]);
  const AxisFilter z = hat_filter(image.size[2], grid.size[2]);
  std::vector<float> f(grid.node_count());
  const auto stride = grid.stride();
  parallel_for_each(static_cast<std::size_t>(grid.size[2]), [&](std::size_t k) {
    for (std::size_t j = 0; j < y.taps.size(); ++j) {
      for (std::size_t i = 0; i < x.taps.size(); ++i) {
        double sum = 0;
        for (std::size_t c = 0; c < z.taps[k].weights.size(); ++c) {
          for (std::size_t b = 0; b < y.taps[j].weights.size(); ++b) {
            const double row_weight = z.taps[k].weights[c] * y.taps[j].weights[b];
            const std::size_t row =
                image.offset(x.taps[i].first, y.taps[j].first + static_cast<Index>(b),
                             z.taps[k].first + static_cast<Index>(c));
            for (std::size_t a = 0; a < x.taps[i].weights.size(); ++a) {
              sum += row_weight * x.taps[i].weights[a] * image.samples[row + a];
            }
          }
        }
        f[k * stride[2] + j * stride[1] + i] = static_cast<float>(sum);
      }
    }
  });
  return f;
}

ImageMeans average_image(const VolumeView& image, const TetMesh& mesh) {
  std::vector<std::array<double, 4>> fits(mesh.cells.size());
  const bool mirrored = determinant(image.direction) < 0;
  const SplineImage spline = interpolating_spline(copy_volume(image));
  parallel_blocks(mesh.cells.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      std::array<Vec3, 4> corners = corners_in_image(image, mesh, mesh.cells[c]);
      if (mirrored) std::swap(corners[2], corners[3]);
      fits[c] = fit_image_on_cell(spline, corners);
      if (mirrored) std::swap(fits[c][2], fits[c][3]);
    }
  });
  ImageMeans means{{}, std::vector<double>(mesh.points.size(), 0)};
  std::vector<double> weights(mesh.points.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double sum = fits[c][0] + fits[c][1] + fits[c][2] + fits[c][3];
    const double volume = cell_volume(mesh, static_cast<Index>(c));
    means.cells.push_back(sum / 4);
    for (std::size_t i = 0; i < 4; ++i) {
      means.nodes[mesh.cells[c][i]] += volume * (fits[c][i] + sum) / 5;
      weights[mesh.cells[c][i]] += volume;
    }
  }
  for (std::size_t n = 0; n < weights.size(); ++n) means.nodes[n] /= weights[n];
  return means;
}

std::vector<std::vector<double>> interpolate_fields(const TetMesh& from,
                                                    std::span<const std::span<const double>> fields,
                                                    std::span<const Vec3> points,
                                                    MeshExtent extent) {
  const auto find = extent == MeshExtent::kBox ? locate : locate_in_piece;
  const auto neighbors = cell_neighbors(from);
  std::vector<std::vector<double>> result(fields.size(), std::vector<double>(points.size()));
  parallel_blocks(points.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    Index cell = 0;
    for (std::size_t n = begin; n < end; ++n) {
      const Location where = find(from, neighbors, points[n], cell);
      cell = where.cell;
      for (std::size_t f = 0; f < fields.size(); ++f) {
        double value = 0;
        for (std::size_t i = 0; i < 4; ++i) {
          value += where.weights[i] * fields[f][from.cells[cell][i]];
        }
        result[f][n] = value;
      }
    }
  });
  return result;
}

std::vector<std::vector<double>> interpolate_fields(const KuhnGrid& from,
                                                    std::span<const std::span<const float>> fields,
                                                    std::span<const Vec3> points) {
  std::vector<std::vector<double>> result(fields.size(), std::vector<double>(points.size()));
  for (std::size_t f = 0; f < fields.size(); ++f) {
    parallel_for(points.size(), [&](std::size_t n) {
      result[f][n] = interpolate(fields[f], from.size, from.spacing, points[n]);
    });
  }
  return result;
}

}  // namespace mesamis::detail::fem
