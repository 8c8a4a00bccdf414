// SPDX-License-Identifier: Apache-2.0
#include "mesamis/body/element_moduli.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/written_number.h"
#include "mesamis/image/trilinear.h"
#include "mesamis/mesh/kuhn.h"

namespace mesamis::detail::body {

namespace {

constexpr int kLeastParts = 2;  // 32 samples: a cell within a voxel still sees the image bend
constexpr int kMostParts = 64;
constexpr std::size_t kCellBlock = 64;
constexpr double kVoxelsOutside = 1;

/// Means over one cell; shares of its volume.
struct CellMeans {
  double modulus = 0, density = 0, below = 0, above = 0, outside = 0;
};

void require_range(bool fits, const char* what, double found) {
  if (fits) return;
  throw InputError(std::string("materials: expected ") + what + ", found " + number_text(found));
}

void require_options(const ElementModuliOptions& o) {
  if (o.law.ranges.empty()) throw InputError("materials: expected a law, found one of no range");
  require_range(o.calibration.slope > 0 && std::isfinite(o.calibration.slope),
                "a calibration of positive slope", o.calibration.slope);
  require_range(o.density_min >= 0 && std::isfinite(o.density_min),
                "a least density of at least 0 g/cm^3", o.density_min);
  require_range(o.density_max > o.density_min, "a greatest density above the least", o.density_max);
  require_range(o.modulus_min > 0 && std::isfinite(o.modulus_min), "a least modulus above 0 MPa",
                o.modulus_min);
  require_range(o.parts_per_voxel > 0 && std::isfinite(o.parts_per_voxel),
                "a positive number of parts per voxel", o.parts_per_voxel);
}

void require_volume(const VolumeView& volume) {
  const auto& n = volume.size;
  if (std::min({n[0], n[1], n[2]}) < 2 || volume.samples.size() != volume.voxel_count()) {
    throw InputError("materials: expected at least 2 voxels along each axis and a sample for each" +
                     std::string(", found ") + std::to_string(n[0]) + " x " + std::to_string(n[1]) +
                     " x " + std::to_string(n[2]) + " voxels and " +
                     std::to_string(volume.samples.size()) + " samples");
  }
}

/// The points in voxels along the axes of the grid.
std::vector<Vec3> in_voxels(const TetMesh& mesh, const VoxelGrid& grid) {
  std::vector<Vec3> points(mesh.points.size());
  parallel_for(points.size(), [&](std::size_t n) {
    const Vec3 p = grid.to_grid(mesh.points[n]);
    points[n] = {p.x / grid.spacing.x, p.y / grid.spacing.y, p.z / grid.spacing.z};
  });
  return points;
}

void require_inside(const std::vector<Vec3>& points, const VoxelGrid& grid) {
  for (std::size_t n = 0; n < points.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      const double last = grid.size[static_cast<std::size_t>(axis)] - 1;
      const double x = points[n][axis];
      if (x >= -kVoxelsOutside && x <= last + kVoxelsOutside) continue;
      throw InputError("materials: point " + std::to_string(n) + " of the mesh lies outside the " +
                       "scan: expected voxels 0 to " + number_text(last) + " along axis " +
                       std::to_string(axis) + ", found " + number_text(x));
    }
  }
}

void require_cells(const TetMesh& mesh) {
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (const Index n : mesh.cells[c]) {
      if (n >= 0 && n < std::ssize(mesh.points)) continue;
      throw InputError("materials: cell " + std::to_string(c) + " names point " +
                       std::to_string(n) + ", there are " + std::to_string(mesh.points.size()));
    }
  }
}

double edge_length_max(const std::array<Vec3, 4>& p) {
  double longest = 0;
  for (const auto& [a, b] : kCellEdges) {
    longest =
        std::max(longest, norm(p[static_cast<std::size_t>(b)] - p[static_cast<std::size_t>(a)]));
  }
  return longest;
}

/// Whether the Kuhn simplex of this path in the cube at this place, x >= y >= z, lies in the large
/// simplex: where two coordinates are equal, the path walks along the earlier axis first.
bool is_in_simplex(const std::array<int, 3>& place, const std::array<int, 3>& path) {
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a + 1; b < 3; ++b) {
      const auto first = static_cast<std::size_t>(path[a]),
                 second = static_cast<std::size_t>(path[b]);
      if (first > second && place[first] == place[second]) return false;
    }
  }
  return true;
}

// The four points of the rule that is exact for polynomials of degree two, each of a quarter of the
// volume: three barycentric coordinates are kNear. Here in the simplex 1 >= x >= y >= z >= 0.
constexpr double kNear = 0.1381966011250105;  // (5 - sqrt(5)) / 20
constexpr std::array<std::array<double, 3>, 4> kRule{{{3 * kNear, 2 * kNear, kNear},
                                                      {1 - kNear, 2 * kNear, kNear},
                                                      {1 - kNear, 1 - 2 * kNear, kNear},
                                                      {1 - kNear, 1 - 2 * kNear, 1 - 3 * kNear}}};

/// Visits four points in each of the n^3 equal parts of a cell.
///
/// The cell is the image of the simplex 1 >= x >= y >= z >= 0 of the unit cube. A cube of side 1/n
/// is six such simplices (Kuhn), one for each order of the axes, and those of the n^3 cubes that
/// lie in the large one fill it.
template <class Visit>
void visit_samples(const std::array<Vec3, 4>& p, int n, Visit visit) {
  const double h = 1.0 / n;
  const std::array<Vec3, 3> step{h * (p[1] - p[0]), h * (p[2] - p[1]), h * (p[3] - p[2])};
  const auto visit_part = [&](const Vec3& corner, const std::array<int, 3>& path) {
    for (const auto& f : kRule) {
      Vec3 at = corner;
      for (std::size_t i = 0; i < 3; ++i) at += f[i] * step[static_cast<std::size_t>(path[i])];
      visit(at);
    }
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      for (int k = 0; k <= j; ++k) {
        const Vec3 corner = p[0] + i * step[0] + j * step[1] + k * step[2];
        for (const auto& path : kKuhnPaths) {
          if (is_in_simplex({i, j, k}, path)) visit_part(corner, path);
        }
      }
    }
  }
}

int parts_along_edge(const std::array<Vec3, 4>& p, double parts_per_voxel) {
  const double wanted = std::ceil(edge_length_max(p) * parts_per_voxel);
  return static_cast<int>(std::clamp<double>(wanted, kLeastParts, kMostParts));
}

CellMeans cell_means(const std::array<Vec3, 4>& p, const Trilinear& image,
                     const ElementModuliOptions& options) {
  const int n = parts_along_edge(p, options.parts_per_voxel);
  const auto& valid = options.law.valid;
  CellMeans sum;
  visit_samples(p, n, [&](const Vec3& at) {
    const double found = options.calibration.at(image.at(at));
    const double rho = std::clamp(found, options.density_min, options.density_max);
    sum.density += rho;
    sum.modulus += modulus_at(options.law, rho);
    sum.below += found < options.density_min;
    sum.above += found > options.density_max;
    sum.outside += valid && (rho < (*valid)[0] || rho > (*valid)[1]);
  });
  const double share = 1.0 / (4.0 * n * n * n);
  return {share * sum.modulus, share * sum.density, share * sum.below, share * sum.above,
          share * sum.outside};
}

/// Adds up the cells in their order.
ElementModuli summed(const TetMesh& mesh, const std::vector<CellMeans>& means, double modulus_min) {
  ElementModuli result;
  double total = 0;
  for (std::size_t c = 0; c < means.size(); ++c) {
    const CellMeans& mean = means[c];
    if (!std::isfinite(mean.modulus)) {
      throw InputError("materials: the modulus of cell " + std::to_string(c) +
                       " is not finite; expected finite grey values and densities");
    }
    const double volume = std::abs(cell_volume(mesh, static_cast<Index>(c)));
    total += volume;
    result.modulus.push_back(std::max(mean.modulus, modulus_min));
    result.density.push_back(mean.density);
    result.share_below_min += volume * mean.below;
    result.share_above_max += volume * mean.above;
    result.share_outside_law += volume * mean.outside;
    result.share_of_modulus_min += mean.modulus < modulus_min ? volume : 0;
  }
  for (double* share : {&result.share_below_min, &result.share_above_max, &result.share_outside_law,
                        &result.share_of_modulus_min}) {
    *share = total > 0 ? *share / total : 0;
  }
  return result;
}

}  // namespace

ElementModuli element_moduli(const TetMesh& mesh, const VolumeView& volume,
                             const ElementModuliOptions& options) {
  require_options(options);
  require_volume(volume);
  require_cells(mesh);
  const std::vector<Vec3> points = in_voxels(mesh, volume);
  require_inside(points, volume);
  const Trilinear image(volume);
  std::vector<CellMeans> means(mesh.cells.size());
  parallel_blocks(means.size(), kCellBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const auto at = [&](int i) {
        return points[static_cast<std::size_t>(mesh.cells[c][static_cast<std::size_t>(i)])];
      };
      means[c] = cell_means({at(0), at(1), at(2), at(3)}, image, options);
    }
  });
  return summed(mesh, means, options.modulus_min);
}

}  // namespace mesamis::detail::body
