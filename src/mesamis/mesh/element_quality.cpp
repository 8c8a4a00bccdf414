// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/element_quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mesamis::detail::mesh {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kWideAngle = 15, kGoodJacobian = 0.2;

double greatest_edge_product(const std::array<Vec3, 4>& p) {
  std::array<double, 4> squares{1, 1, 1, 1};
  for (const auto& [i, j] : kCellEdges) {
    const Vec3 edge = p[static_cast<std::size_t>(j)] - p[static_cast<std::size_t>(i)];
    const double square = dot(edge, edge);
    squares[static_cast<std::size_t>(i)] *= square;
    squares[static_cast<std::size_t>(j)] *= square;
  }
  return std::sqrt(*std::max_element(squares.begin(), squares.end()));
}

}  // namespace

ElementShape element_shape(const std::array<Vec3, 4>& p) {
  std::array<Vec3, 4> normals;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto& k = kCellFaces[f];
    normals[f] = cross(p[k[1]] - p[k[0]], p[k[2]] - p[k[0]]);
  }
  double least_cosine = 1, greatest_cosine = -1;
  for (std::size_t f = 0; f < 4; ++f) {
    for (std::size_t g = f + 1; g < 4; ++g) {
      const double cosine = -dot(normals[f], normals[g]) /
                            std::sqrt(dot(normals[f], normals[f]) * dot(normals[g], normals[g]));
      least_cosine = std::min(least_cosine, cosine);
      greatest_cosine = std::max(greatest_cosine, cosine);
    }
  }
  return {kDegrees * std::acos(std::clamp(greatest_cosine, -1.0, 1.0)),
          kDegrees * std::acos(std::clamp(least_cosine, -1.0, 1.0)),
          std::numbers::sqrt2 * six_volume(p[0], p[1], p[2], p[3]) / greatest_edge_product(p)};
}

ElementQuality element_quality(const TetMesh& mesh) {
  ElementQuality quality;
  if (mesh.cells.empty()) return quality;
  quality = {std::ssize(mesh.cells), 180, 0, 1};
  std::int64_t wide = 0, good = 0;
  for (const Cell& cell : mesh.cells) {
    const ElementShape shape = element_shape(cell_corners(mesh, cell));
    quality.least_angle = std::min(quality.least_angle, shape.least_angle);
    quality.greatest_angle = std::max(quality.greatest_angle, shape.greatest_angle);
    quality.scaled_jacobian_min = std::min(quality.scaled_jacobian_min, shape.scaled_jacobian);
    wide += shape.least_angle > kWideAngle;
    good += shape.scaled_jacobian > kGoodJacobian;
  }
  const auto count = static_cast<double>(quality.elements);
  quality.share_above_15_deg = static_cast<double>(wide) / count;
  quality.share_jacobian_above = static_cast<double>(good) / count;
  return quality;
}

}  // namespace mesamis::detail::mesh
