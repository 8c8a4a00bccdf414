// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/remesh/body_shape.h"
#include "mesamis/surface/tri_mesh.h"

/// Shapes of bodies given by formulas, for tests of the remesher.
namespace mesamis {

/// A shape with an exact signed distance, negative inside: there is `inside`, elsewhere `outside`.
class FormulaShape : public BodyShape {
 public:
  static constexpr double kTolerance = 0.01;
  explicit FormulaShape(Material inside = 1, Material outside = kOutside)
      : inside_(inside), outside_(outside) {}
  virtual double distance(const Vec3& p) const = 0;
  Material material_at(const Vec3& p) const override {
    return distance(p) < 0 ? inside_ : outside_;
  }
  double crossing(const Vec3& a, const Vec3& b) const override {
    double low = 0, high = 1;
    const bool in_a = distance(a) < 0;
    for (int step = 0; step < 40; ++step) {
      const double middle = 0.5 * (low + high);
      ((distance(a + middle * (b - a)) < 0) == in_a ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  std::optional<double> hidden_crossing(const Vec3& a, const Vec3& b) const override {
    constexpr int kSteps = 64;
    const double sign = distance(a) < 0 ? 1 : -1;
    double deepest = kTolerance;
    std::optional<double> place;
    for (int step = 1; step < kSteps; ++step) {
      const double share = double(step) / kSteps, there = sign * distance(a + share * (b - a));
      if (there <= deepest) continue;
      deepest = there;
      place = share;
    }
    return place;
  }
  BorderPoint nearest_border(const Vec3& p) const override { return {nearest(p), kTolerance}; }
  std::optional<JunctionPoint> nearest_junction(const Vec3&, const MaterialTriple&) const override {
    return std::nullopt;  // of two materials
  }

 protected:
  virtual Vec3 nearest(const Vec3& p) const = 0;

 private:
  Material inside_, outside_;
};

/// What lies below a plane, and what above.
class PlaneShape : public FormulaShape {
 public:
  PlaneShape(const Vec3& normal, double offset, Material below, Material above)
      : FormulaShape(below, above), normal_(unit_or_zero(normal)), offset_(offset) {}
  double distance(const Vec3& p) const override { return dot(p, normal_) - offset_; }

 protected:
  Vec3 nearest(const Vec3& p) const override { return p - distance(p) * normal_; }

 private:
  Vec3 normal_;
  double offset_;
};

/// A ball.
class RoundShape : public FormulaShape {
 public:
  RoundShape(const Vec3& centre, double radius, Material inside = 1, Material outside = kOutside)
      : FormulaShape(inside, outside), centre_(centre), radius_(radius) {}
  double distance(const Vec3& p) const override { return norm(p - centre_) - radius_; }

 protected:
  Vec3 nearest(const Vec3& p) const override {
    return centre_ + radius_ * unit_or_zero(p - centre_);
  }

 private:
  Vec3 centre_;
  double radius_;
};

/// What lies between two heights.
class SlabShape : public FormulaShape {
 public:
  SlabShape(double low, double high, Material inside = 1, Material outside = kOutside)
      : FormulaShape(inside, outside), low_(low), high_(high) {}
  double distance(const Vec3& p) const override { return std::max(low_ - p.z, p.z - high_); }

 protected:
  Vec3 nearest(const Vec3& p) const override {
    return {p.x, p.y, p.z < 0.5 * (low_ + high_) ? low_ : high_};
  }

 private:
  double low_, high_;
};

/// Why the boundary of a mesh is not a closed 2-manifold; "" if it is.
inline std::string boundary_flaws(const TetMesh& mesh) {
  const auto neighbors = cell_neighbors(mesh);
  TriMesh boundary{mesh.points, {}};
  for (std::size_t c = 0; c < neighbors.size(); ++c) {
    for (std::size_t f = 0; f < 4; ++f) {
      if (neighbors[c][f] != kNoIndex) continue;
      const auto& k = kCellFaces[f];
      boundary.triangles.push_back({mesh.cells[c][k[0]], mesh.cells[c][k[1]], mesh.cells[c][k[2]]});
    }
  }
  return solid_flaws_of(check_surface(boundary));
}

}  // namespace mesamis
